// SPDX-License-Identifier: GPL-3.0-or-later
// Sends changes to the server. While a slider is dragged there is one request at a time, and only the latest value
// waits; after it the change itself is sent, a step that can be undone. A change made while base is shown goes to
// another face beside it, which the first change adds.
import { briefName, isBriefName } from './brief_name';
import { Refused, type Connection } from './connection';
import type { Values } from './messages';
import { gainKey, gainsIn, type StudioState } from './studio_state';
import { words } from './words';

/** In the place of a face's number. */
const beingAdded = -1;

export class Edits {
  private target: Promise<number> | null = null;
  private underWay = false;
  private waiting: Values | null = null;
  /** Counts releases of sliders: drags before a release are obsolete. */
  private turn = 0;
  /** Changes of each face that the server has not answered yet. Events that come meanwhile know nothing of them. */
  private readonly drafts = new Map<number, Values>();
  /** Changes that were sent, or will be once their face is there. */
  private unanswered = 0;
  private wasPlaying = false;

  constructor(
    private readonly state: StudioState, private readonly connection: Connection, private readonly problem: (text: string) => void,
  ) {
    state.sceneChanged.add(() => {
      if (this.unanswered === 0) this.drafts.clear();
    });
    connection.on('motion', () => this.resume());
  }

  /** The value that a key of the edited face has, or will have. */
  value(key: string): unknown {
    const { state } = this;
    const drafts = this.drafts.get(this.draftFace) ?? {};
    if (!(key in drafts)) return state.valuesOf(state.edited)[key];
    // null: as in base, which null resets to its default.
    return drafts[key] ?? (state.edited === 0 ? state.keys.get(key)?.default : state.valuesOf(0)[key]);
  }

  /** Strengths of muscles that the edited face changes, or will change: muscles.gain. */
  get gains(): Record<string, number> {
    return gainsIn(this.value(gainKey));
  }

  /** Called while a slider is dragged. */
  live(changes: Values): void {
    this.draft(changes);
    const { playback } = this.state;
    if (playback.playing) {
      this.wasPlaying = true;
      playback.pause();
    }
    this.waiting = changes;
    if (!this.underWay) void this.sendWaiting();
  }

  /** Called when the slider is released. */
  commit(changes: Values): Promise<void> {
    return this.apply(changes, false);
  }

  /** A whole step at once: the frame shown follows first, then the motion. */
  step(changes: Values): Promise<void> {
    return this.apply(changes, true);
  }

  /** A change of the whole scene, whichever face is edited, for keys that no variant can have. */
  async ofBase(changes: Values): Promise<void> {
    this.problem('');
    await this.send(0, changes, false).catch((error: unknown) => this.drop(error));
  }

  private async apply(changes: Values, frameFirst: boolean): Promise<void> {
    this.draft(changes);
    this.waiting = null;
    ++this.turn;
    ++this.unanswered;
    this.problem('');
    try {
      const face = await this.face();
      if (frameFirst) await this.send(face, changes, true).catch(() => {}); // the change itself reports errors
      await this.send(face, changes, false, this.nameFor(face, changes));
    } catch (error) {
      this.drop(error);
    } finally {
      this.target = null;
      if (--this.unanswered === 0 && this.drafts.size > 0) this.state.sceneChanged.notify(); // the server's values count
    }
  }

  private draft(changes: Values): void {
    this.drafts.set(this.draftFace, { ...this.drafts.get(this.draftFace), ...changes });
  }

  private get draftFace(): number {
    const { edited, changeBase } = this.state;
    return edited !== 0 || changeBase ? edited : beingAdded;
  }

  private async sendWaiting(): Promise<void> {
    this.underWay = true;
    try {
      while (this.waiting) {
        const face = await this.face();
        const changes: Values | null = this.waiting;
        this.waiting = null;
        const { turn } = this;
        if (changes && turn === this.turn) await this.send(face, changes, true);
      }
    } catch (error) {
      this.drop(error);
    } finally {
      this.underWay = false;
    }
  }

  private send(face: number, changes: Values, live: boolean, name?: string): Promise<unknown> {
    return this.connection.request('set', { changes, face, live, time_s: this.state.playback.timeS, ...(name && { name }) });
  }

  /** The face's new name after these changes; undefined: unchanged, or given by the user. */
  private nameFor(face: number, changes: Values): string | undefined {
    const { state } = this;
    const own = state.scene?.faces[face];
    const base = state.valuesOf(0);
    if (face === 0 || !own || !isBriefName(own.name, own.changes, base, state.muscles)) return undefined;
    const wanted = briefName({ ...own.changes, ...changes }, base, state.muscles) || words.newVariant;
    const name = state.freeName(wanted, face);
    return name === own.name ? undefined : name;
  }

  private face(): Promise<number> {
    const { state } = this;
    if (state.edited !== 0 || state.changeBase) return Promise.resolve(state.edited);
    this.target ??= this.addFace(words.newVariant, 0);
    return this.target;
  }

  /** Makes a face and shows it beside base. */
  async addFace(wanted: string, like: number, preset?: string): Promise<number> {
    const { state } = this;
    const name = state.freeName(wanted);
    const { face } = await this.connection.request('add_variant', { name, like, ...(preset && { preset }) });
    const drafts = this.drafts.get(beingAdded);
    if (this.target && drafts) {
      this.drafts.delete(beingAdded);
      this.drafts.set(face, drafts);
    }
    if (state.source.replay.faces.length <= face) state.addLike(like, name);
    const first = state.shown.mode === 'single' ? 0 : state.shown.first;
    state.shown.set({ mode: state.shown.mode === 'wipe' ? 'wipe' : 'side-by-side', first, second: face });
    return face;
  }

  /** A change by itself, of a face that is there. */
  async change(face: number, changes: Values): Promise<void> {
    await this.send(face, changes, false);
  }

  async removeFace(face: number): Promise<void> {
    await this.connection.request('remove_variant', { face });
    if (this.state.source.replay.faces.length > (this.state.scene?.faces.length ?? 0)) this.state.without(face);
  }

  private resume(): void {
    if (!this.wasPlaying || this.underWay) return;
    this.wasPlaying = false;
    this.state.playback.play();
  }

  /** Drops all changes under way and shows a refusal. */
  private drop(error: unknown): void {
    this.waiting = null;
    this.drafts.clear();
    this.wasPlaying = false;
    if (error instanceof Refused) this.problem(error.message);
    this.state.sceneChanged.notify(); // sliders return to the valid values
  }
}
