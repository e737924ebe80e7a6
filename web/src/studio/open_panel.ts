// SPDX-License-Identifier: GPL-3.0-or-later
// What is open, and what to open instead: the embedded face, what the command named, files chosen or dropped.
import { button, element } from '../page/dom';
import { Refused, type Connection } from './connection';
import type { Places } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

const scans = /\.(ply|obj|stl|glb|gltf)$/i;
const scenes = /\.toml$/i;
const zips = /\.zip$/i;

export class OpenPanel {
  private places: Places | null = null;
  /** What a scene without a title is called. */
  private opened = '';
  private readonly now = element('p', '', 'open-now');
  private readonly choices = element('div', '', 'choices');
  private readonly problem = element('p', '', 'problem');
  private readonly picker = element('input');
  private readonly rescue = element('div', '', 'rescue');

  constructor(private readonly state: StudioState, private readonly connection: Connection, private readonly into: HTMLElement) {
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
    into.append(this.now, this.rescue, this.choices, this.problem, drop, this.picker);
    state.sceneChanged.add(() => (this.now.textContent = this.called()));
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

  /** What a session that ended has left goes for good. */
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
    return words.openNow(this.state.scene?.title || this.opened);
  }

  private choose(what: string): void {
    if (this.maySkip()) void this.open(what);
  }

  private maySkip(): boolean {
    return !this.state.scene?.can_undo || this.state.scene.saved || window.confirm(words.discard);
  }

  private async open(what: string, recording?: string): Promise<void> {
    this.report('');
    const before = this.opened;
    try {
      this.opened = what === 'started' ? this.places?.started ?? '' : what;
      await this.connection.request('open', { what, ...(recording && { recording }) });
    } catch (error) {
      this.opened = before; // that is still open
      if (this.state.scene) this.now.textContent = this.called();
      if (error instanceof Refused) this.report(error.message);
    }
  }

  private async take(files: File[]): Promise<void> {
    if (files.length === 0 || !this.maySkip()) return;
    const scan = files.filter(({ name }) => scans.test(name));
    const scene = files.filter(({ name }) => scenes.test(name));
    const others = files.filter((file) => !scan.includes(file) && !scene.includes(file));
    if (scene.length + scan.length > 1 && scene.length !== 1) {
      this.report(words.tooManyScans);
      return;
    }
    if (scan.length === 0 && scene.length === 0) {
      this.report(words.recordingAlone);
      return;
    }
    this.report('');
    try {
      const names = new Map<File, string>();
      for (const file of files) {
        this.now.textContent = words.uploading(file.name);
        names.set(file, await this.connection.upload(file));
      }
      const [main] = [...scene, ...scan];
      // A scene names its files itself; of a zip the server must know that it is one.
      const [other] = scene.length === 0 ? others : others.filter(({ name }) => zips.test(name));
      const recording = other && names.get(other);
      await this.open(names.get(main)!, recording);
    } catch (error) {
      this.report(error instanceof Error ? error.message : String(error));
    } finally {
      if (this.state.scene) this.now.textContent = this.called();
    }
  }

  private report(problem: string): void {
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
    if (this.places && !this.state.scene) this.now.textContent = problem ? '' : words.opening;
  }

  /** Anywhere on the page. */
  private wireDrop(): void {
    const { into } = this;
    const over = (on: boolean) => into.classList.toggle('drop-here', on);
    document.addEventListener('dragover', (event) => {
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      over(true);
    });
    document.addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) over(false);
    });
    document.addEventListener('drop', (event) => {
      over(false);
      if (!event.dataTransfer?.files.length) return;
      event.preventDefault();
      void this.take([...event.dataTransfer.files]);
    });
  }
}
