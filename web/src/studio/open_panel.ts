// SPDX-License-Identifier: GPL-3.0-or-later
// The open scene, and others to open: the embedded face, the file of the command line, files chosen or dropped.
import { at, button, element } from '../page/dom';
import { CompareRecordings } from './compare_recordings';
import { Refused, type Connection } from './connection';
import { isZip, kindOf } from './file_kinds';
import type { Places } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

export class OpenPanel {
  private places: Places | null = null;
  /** The server has opened the requested scene: later messages refer to it. */
  private answered = false;
  private readonly now = element('p', '', 'open-now');
  private readonly choices = element('div', '', 'choices');
  private readonly problem = element('p', '', 'problem');
  private readonly picker = element('input');
  private readonly rescue = element('div', '', 'rescue');

  /** `show`: brings the panel into view, for a problem. */
  constructor(private readonly state: StudioState, private readonly connection: Connection, into: HTMLElement, private readonly show: () => void) {
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    this.rescue.hidden = true;
    Object.assign(this.picker, { type: 'file', multiple: true, hidden: true, id: 'file-picker' });
    this.picker.setAttribute('aria-label', words.chooseFiles);
    this.picker.addEventListener('change', () => {
      void this.take([...(this.picker.files ?? [])]);
      this.picker.value = '';
    });
    const drop = element('p', words.drop, 'drop');
    into.append(this.now, this.choices, this.problem);
    new CompareRecordings(state, connection, into);
    into.append(drop, this.picker);
    at('banner').after(this.rescue);
    state.sceneChanged.add(() => (this.now.textContent = this.called()));
    // Called for the next face, or for the same one opened again.
    state.source.onChange(() => {
      if (this.answered) this.showOpening(null);
    });
    connection.on('log', ({ level, text }) => {
      if (level === 'error' && this.answered && !at('opening').hidden) at('opening').textContent = text;
    });
    this.wireDrop();
  }

  greet(places: Places): void {
    this.places = places;
    const choices = [button(words.embedded, 'quiet', () => this.choose('embedded'))];
    const { started } = places;
    if (started) choices.unshift(button(words.startedWith(started), 'quiet', () => this.choose('started')));
    choices.push(button(words.chooseFiles, 'quiet', () => this.picker.click()));
    this.choices.replaceChildren(...choices);
    this.rescue.hidden = !places.autosave;
    const leave = button(words.autosaveLeave, 'quiet', () => (this.rescue.hidden = true));
    const open = button(words.autosaveOpen, 'quiet', () => {
      this.rescue.hidden = true;
      this.choose('autosave');
    });
    this.rescue.replaceChildren(element('p', places.autosave ? words.autosave(places.autosave.title, new Date(Date.now() - 1e3 * places.autosave.seconds_ago)) : ''), open, leave, button(words.autosaveDelete, 'quiet', () => void this.discard()));
    if (!places.open) void this.open(started ? 'started' : 'embedded');
  }

  /** Deletes the work that an ended session has left. */
  private async discard(): Promise<void> {
    if (!window.confirm(words.autosaveDeleteSure)) return;
    try {
      await this.connection.request('discard_autosave', {});
      this.rescue.hidden = true;
    } catch (error) {
      if (error instanceof Refused) this.report(error.message);
    }
  }

  private called(): string {
    return words.openNow(this.state.called);
  }

  private choose(what: string): void {
    if (this.maySkip()) void this.open(what);
  }

  private maySkip(): boolean {
    return !this.state.scene?.can_undo || this.state.scene.saved || window.confirm(words.discard);
  }

  /** `called`: name of what is opened, to show. */
  private async open(what: string, recording?: string, called = ''): Promise<void> {
    this.report('');
    const another = what !== 'current';
    if (another) this.showOpening(called || (what === 'started' ? this.places?.started ?? what : what === 'embedded' ? words.embedded : what));
    try {
      await this.connection.request('open', { what, ...(recording && { recording }) });
      this.answered = true;
      if (what === 'autosave') this.rescue.hidden = true; // no longer lost
    } catch (error) {
      this.showOpening(null); // the previous face is still open
      if (this.state.scene) this.now.textContent = this.called();
      if (error instanceof Refused) this.report(error.message);
    }
  }

  /** Marks the page as opening, so that the previous face is not taken for the next; null: none is being opened. */
  private showOpening(what: string | null): void {
    this.answered = false;
    document.documentElement.toggleAttribute('data-opening', what !== null);
    for (const id of ['figures', 'answer']) at(id).setAttribute('aria-busy', String(what !== null));
    at('opening').textContent = what === null ? '' : words.openingNow(what);
    at('opening').hidden = what === null;
  }

  private async take(files: File[]): Promise<void> {
    if (files.length === 0) return;
    const kinds = new Map<File, Awaited<ReturnType<typeof kindOf>>>();
    for (const file of files) kinds.set(file, await kindOf(file));
    const of = (...wanted: string[]) => files.filter((file) => wanted.includes(kinds.get(file)!));
    const names = (some: File[]) => some.map(({ name }) => name).join(', ');
    const [scan, scene] = [of('scan', 'ct'), of('scene')];
    if (scene.length > 0 && of('ct').length > 0) return this.report(words.sceneWithCt(names(of('ct'))));
    if (scene.length + scan.length > 1 && scene.length !== 1) return this.report(words.tooManyScans(names([...scene, ...scan])));
    // A scene may name files of any kind.
    for (const file of scene.length === 0 ? files : of('empty')) {
      const kind = kinds.get(file)!;
      if (kind === 'scan' || kind === 'ct' || kind === 'scene' || kind === 'recording') continue;
      return this.report(words.fileProblems[kind](file.name, words.expectedFiles));
    }
    const recordings = of('recording');
    if (scene.length === 0 && recordings.length > 1) return this.report(words.tooManyRecordings(names(recordings)));
    const alone = scan.length + scene.length === 0;
    if (alone && !this.state.scene) return this.report(words.recordingAlone(recordings[0].name));
    if (!alone && !this.maySkip()) return;
    await this.send(files, [...scene, ...scan][0] ?? null, scene.length === 0 ? recordings[0] : recordings.find(({ name }) => isZip(name)));
  }

  /** Uploads the files and opens them; a recording without a scan or a scene moves the open face. */
  private async send(files: File[], main: File | null, recording: File | undefined): Promise<void> {
    this.report('');
    try {
      const names = new Map<File, string>();
      for (const file of files) {
        this.now.textContent = words.uploading(file.name);
        names.set(file, await this.connection.upload(file));
      }
      await this.open(main ? names.get(main)! : 'current', recording && names.get(recording), main?.name);
    } catch (error) {
      this.report(error instanceof Error ? error.message : String(error));
    } finally {
      if (this.state.scene) this.now.textContent = this.called();
    }
  }

  private report(problem: string): void {
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
    if (problem) this.show();
    if (this.places && !this.state.scene) this.now.textContent = problem ? '' : words.opening;
  }

  /** Anywhere on the page; what may be dropped, and where it goes, stands over the window meanwhile. */
  private wireDrop(): void {
    const over = at('drop-over');
    const ends = () => {
      over.hidden = true;
      over.textContent = '';
    };
    document.addEventListener('dragover', (event) => {
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      if (!over.hidden) return;
      over.hidden = false;
      over.textContent = words.dropOver;
    });
    document.addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) ends();
    });
    document.addEventListener('dragend', ends);
    // When Escape ends the drag, a browser sends only this event, or the next movement.
    document.addEventListener('keydown', ({ key }) => {
      if (key === 'Escape') ends();
    });
    document.addEventListener('pointermove', () => {
      if (!over.hidden) ends();
    });
    document.addEventListener('drop', (event) => {
      ends();
      if (!event.dataTransfer?.files.length) return;
      event.preventDefault();
      void this.take([...event.dataTransfer.files]);
    });
  }
}
