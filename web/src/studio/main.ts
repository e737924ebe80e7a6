// SPDX-License-Identifier: GPL-3.0-or-later
// The studio: a face that responds while its parameters are changed. Connects the server's messages with state and
// views.
import '../page/style.css';
import './studio.css';
import { at, button, element, startPage } from '../page/dom';
import { defineColours, type Palette } from '../page/face_colour';
import type { Undo } from '../page/listeners';
import { movingOf, replayOf, type MovingManifest } from '../replay/data';
import { useSideWords } from '../page/side_words';
import { frameAt } from '../replay/face/deform';
import { Stage } from '../replay/face/stage';
import { wireKeys, type Key } from '../replay/keys';
import type { Manifest } from '../replay/manifest';
import { transportKeys, wireTransport } from '../replay/transport';
import { Answer } from './answer';
import { bonesOf } from './bone_moves';
import { BonesPanel } from './bones_panel';
import { Certainty } from './certainty';
import { Connection, takeToken, type LineState } from './connection';
import { CtPanel } from './ct_panel';
import { Drawer } from './drawer';
import { Edits } from './edits';
import { FiguresPanel } from './figures_panel';
import { LandmarksPanel } from './landmarks_panel';
import { isRecord, type Activations, type BudgetFigure, type LandmarkInfo, type MuscleInfo, type Places, type Preset, type Region, type SceneKey, type SceneNow, type StifferTissue } from './messages';
import { LivePanel } from './live';
import { MessagesPanel } from './messages_panel';
import { MusclesPanel } from './muscles_panel';
import { OpenPanel } from './open_panel';
import { PaintPanel } from './paint_panel';
import { Panels } from './panels';
import { Progress } from './progress';
import { Question } from './question';
import { RemarkPlaces } from './remark_places';
import { remarksOf } from './remarks';
import { SaveMenu } from './save_menu';
import { ScenePanel } from './scene_panel';
import { nested, StudioState } from './studio_state';
import { Tabs } from './tabs';
import { TissuePanel } from './tissue_panel';
import { ViewVideo } from './video';
import { WhatIf } from './what_if';
import { fillWords, words } from './words';

class Studio {
  private readonly state = new StudioState();
  private readonly connection = new Connection(takeToken(), (answer) => this.greeted(answer as unknown as Greeting));
  private readonly edits = new Edits(this.state, this.connection, (text) => this.problem(text));
  private readonly muscles = new MusclesPanel(this.state, this.edits, (names) => this.stage?.face?.lightMuscles(names));
  private readonly tissue = new TissuePanel(this.state, this.edits);
  private readonly paint = new PaintPanel(this.state, this.edits, this.connection);
  private readonly bones = new BonesPanel(this.state, this.edits, this.connection, () => this.stage?.face ?? null);
  private readonly scene = new ScenePanel(this.state, this.edits);
  private readonly answer = new Answer(this.state, at('answer-body'), () => this.panels.show('figures'));
  private readonly figures = new FiguresPanel(this.state, at('figures-body'), this.answer);
  private readonly certainty = new Certainty(this.state, this.connection, at('certainty'), (text) => this.problem(text));
  private readonly drawer = new Drawer();
  private readonly whatIf = new WhatIf(this.state, this.edits, (gain) => this.muscles.reveal(gain), () => this.panels.show('bones'), (region) => {
    this.tissue.choosePart(region);
    this.panels.show('tissue');
  });
  private readonly opening = new OpenPanel(this.state, this.connection, at('open-panel'), () => this.drawer.openFiles());
  private readonly landmarks = new LandmarksPanel(this.state, this.connection, at('landmarks-panel'), () => this.stage?.face ?? null, (on) => this.bones.pause(on));
  private readonly live = new LivePanel(this.state, this.connection, at('live-panel'), () => this.stage?.face ?? null, (face, shape) => this.figures.showLive(face, shape));
  private readonly messages = new MessagesPanel(at('messages-panel'), at('open-messages'), at('message-news'));
  private readonly progress = new Progress(at('progress'));
  private readonly saving = new SaveMenu(this.state, this.connection, (text) => this.messages.add('note', text));
  private readonly remarks: RemarkPlaces;
  private readonly panels: Panels;
  private stage: Stage | null = null;
  /** The scene that the motion shown is of. */
  private movedText: string | null = null;
  private unwireKeys: Undo = () => {};
  private readonly showTransport = wireTransport(this.state.source, this.state.playback, this.state.shown);

  constructor() {
    this.panels = new Panels([
      { key: 'muscles', title: words.muscles, element: this.muscles.element },
      { key: 'tissue', title: words.tissue, element: this.tissue.element },
      { key: 'paint', title: words.paint, element: this.paint.element, seen: (now) => this.paint.seen(now) },
      { key: 'bones', title: words.bones, element: this.bones.element, seen: (now) => this.bones.seen(now) },
      { key: 'figures', title: words.figures, element: at('figures-holder') },
      { key: 'scene', title: words.scene, element: this.scene.element },
    ]);
    new CtPanel(this.connection, at('ct-panel'));
    new Tabs(this.state, this.connection, this.edits);
    new Question(this.state, this.edits, this.whatIf, at('question-body'), (key) => this.panels.show(key));
    this.remarks = new RemarkPlaces([this.muscles, this.tissue, this.bones, this.scene], () => (this.state.edited === 0 ? '' : this.state.nameOf(this.state.edited)));
    this.wireBar();
    this.wireServer();
    this.wireWork();
    const { source, playback } = this.state;
    source.onChange((change) => {
      if (change === 'face') this.showFace();
      else this.showMotion();
    });
    playback.onChange(() => this.showTime());
    this.state.shown.onChange(() => {
      this.remarks.update();
      if (source.open) this.showTransport();
    });
    new ViewVideo(this.state, at<HTMLButtonElement>('save-video'), () => this.stage?.face ?? null,
      () => this.stage?.colours ?? null, () => this.live.live);
    const loop = at<HTMLInputElement>('loop');
    loop.addEventListener('change', () => (playback.loop = loop.checked));
    this.connection.onState((line) => this.showLine(line));
    this.connection.connect();
  }

  private wireServer(): void {
    const { connection, state } = this;
    connection.on('scene', (scene) => {
      state.setScene(scene as unknown as SceneNow);
      const { can_undo, can_redo, saved } = state.scene!;
      const title = state.called;
      at('scene-title').textContent = title;
      // Pictures and files are of the scene, not of the program.
      document.documentElement.dataset.subject = title || words.title;
      document.title = title ? `${title} – ${words.title}` : words.title;
      at<HTMLButtonElement>('undo').disabled = !can_undo;
      at<HTMLButtonElement>('redo').disabled = !can_redo;
      at<HTMLButtonElement>('save-menu').disabled = false;
      at('unsaved').hidden = saved;
      this.compareTexts();
    });
    connection.on('face', ({ replay, muscles, landmarks, bones, activations, block }) => {
      const manifest = replay as Manifest & { palette?: Palette };
      if (manifest.palette) defineColours(manifest.palette);
      this.withOptions(manifest.summary);
      state.muscles = isRecord(muscles) ? (muscles.muscles as MuscleInfo[]) : [];
      this.muscles.curves.take(activations as Activations | null, block);
      // Messages on the previous face do not apply to this one.
      if (document.documentElement.hasAttribute('data-opening')) this.messages.clear();
      this.bones.take(bonesOf(bones, block));
      state.source.setFace(replayOf(manifest, block));
      this.showRemarks(manifest.summary);
      this.landmarks.build(landmarks as LandmarkInfo[]);
      this.movedText = state.scene?.text ?? null;
      this.compareTexts();
    });
    connection.on('motion', ({ replay, activations, block, seconds, bands }) => {
      if (!state.source.open) return;
      const manifest = replay as MovingManifest;
      this.withOptions(manifest.summary);
      this.muscles.curves.take(activations as Activations | null, block);
      this.withBudget(manifest.summary);
      state.source.setMotion(movingOf(manifest, block));
      this.showRemarks(manifest.summary);
      this.movedText = state.scene?.text ?? null;
      this.compareTexts();
      document.documentElement.dataset.bands = String(bands);
      if (bands) return;
      document.documentElement.dataset.computedS = seconds.toFixed(3);
      document.documentElement.dataset.motions = String(Number(document.documentElement.dataset.motions ?? 0) + 1);
    });
    connection.on('shape', ({ face, time_s, step_m, values, block, seconds }) => {
      if (!state.source.open || Math.abs(time_s - state.playback.timeS) > 1e-6 || state.playback.playing || this.live.live) return;
      const displacement = new Float32Array(block.int16(values));
      for (let i = 0; i < displacement.length; ++i) displacement[i] *= step_m;
      if (displacement.length !== state.source.replay.points.length) return;
      this.stage?.face?.showLive({ face, displacement });
      this.figures.showLive(face, displacement);
      document.documentElement.dataset.shapeS = seconds.toFixed(3);
      document.documentElement.dataset.shapes = String(Number(document.documentElement.dataset.shapes ?? 0) + 1);
    });
  }

  /** What longer work reports. */
  private wireWork(): void {
    const { connection, state } = this;
    connection.on('budget', ({ figures, missing, jitter_known, text }) => {
      this.certainty.take({ figures: figures as BudgetFigure[], missing: missing as string[], jitterKnown: jitter_known, text });
      if (state.source.open && this.withBudget(state.source.replay.summary)) this.figures.refresh();
      document.documentElement.dataset.budget = 'true';
    });
    connection.on('progress', ({ stage, share }) => this.progress.show(stage, share));
    connection.on('log', ({ level, text }) => {
      this.messages.add(level, text);
      if (level === 'error' && this.certainty.waiting) this.certainty.take(null);
    });
  }

  private showRemarks(summary: Record<string, unknown>): void {
    const remarks = remarksOf(summary);
    this.messages.addRemarks(remarks);
    this.remarks.set(remarks);
  }

  /** Whether the motion shown is that of the present scene; until then figures are those of the scene before. */
  private compareTexts(): void {
    const current = this.movedText === (this.state.scene?.text ?? null);
    document.documentElement.dataset.current = String(current);
    for (const id of ['figures', 'answer']) at(id).classList.toggle('stale', !current);
  }

  /** The error budget of the present scene, as a run's summary has it. False: none is known. */
  private withBudget(summary: Record<string, unknown>): boolean {
    const figures = this.certainty.figuresOf(this.state.scene?.text ?? null);
    if (figures) summary.error_budget = { corners_of_the_mouth: figures };
    return figures !== null;
  }

  /** Base's part of a report's summary, from which the variants differ. */
  private withOptions(summary: Record<string, unknown>): void {
    summary.options = nested(this.state.valuesOf(0));
  }

  private greeted({ program, keys, presets, tissues, regions, places }: Greeting): void {
    this.state.regions = regions;
    this.state.keys = new Map(keys.map((key) => [key.name, key]));
    this.whatIf.presets = presets;
    this.saving.folder = places.folder;
    at('title').title = program;
    this.tissue.build();
    this.paint.build(presets, tissues);
    this.bones.build();
    if (this.state.muscles.length > 0) this.muscles.build();
    at<HTMLButtonElement>('what-if').disabled = false;
    this.live.greet(places);
    this.opening.greet(places);
  }

  /** A new skin: makes all views again. */
  private showFace(): void {
    const { source, shown, playback } = this.state;
    const { replay } = source;
    // Views of the previous face must not receive data of the new one.
    this.paint.attach(null);
    this.stage?.dispose();
    this.stage = null;
    this.figures.clear();
    this.setRange();
    shown.setCount(replay.faces.length);
    this.stage = new Stage(replay, shown);
    this.paint.attach(this.stage);
    this.bones.attach();
    this.muscles.build();
    this.figures.build();
    this.rewireKeys();
    const still = !this.stage.playsByItself;
    if (still) playback.seek(replay.timeS[replay.peakFrame] ?? 0);
    this.showTime();
    document.documentElement.dataset.ready = 'true';
    if (!still) playback.play();
  }

  /** A new motion of the same skin, or other variants. */
  private showMotion(): void {
    const { source, shown } = this.state;
    this.setRange();
    shown.setCount(source.replay.faces.length);
    this.stage?.refresh();
    this.paint.refresh();
    this.muscles.curves.draw();
    this.figures.refresh();
    this.rewireKeys();
    this.showTime();
  }

  private setRange(): void {
    const { source, playback } = this.state;
    const { timeS } = source.replay;
    playback.setRange(timeS[0] ?? 0, timeS[timeS.length - 1] ?? 0);
  }

  private showTime(): void {
    const { source, playback } = this.state;
    if (!source.open) return;
    this.stage?.moveTo(frameAt(source.replay.timeS, playback.timeS), playback);
    this.figures.mark();
    this.muscles.curves.mark(playback.timeS);
    this.showTransport();
  }

  private rewireKeys(): void {
    this.unwireKeys();
    const never = { when: () => false, act: () => {} };
    const keys: Key[] = [
      ...transportKeys(this.state.source, this.state.playback, this.state.shown), ...(this.stage?.keys() ?? []),
      { shown: 'n', does: words.keyWhatIf, when: ['n'], act: () => this.whatIf.menu.open() },
      { shown: 'Ctrl+Z', does: words.keyUndo, ...never },
      { shown: 'Ctrl+Shift+Z', does: words.keyRedo, ...never },
      { shown: 'Ctrl+S', does: words.keySave, ...never },
    ];
    this.unwireKeys = wireKeys(keys, at<HTMLDialogElement>('help'), at<HTMLButtonElement>('open-help'), at<HTMLInputElement>('keys-on'));
  }

  private wireBar(): void {
    const step = (which: 'undo' | 'redo') => {
      this.connection.request(which, {}).catch((error: unknown) => this.problem(String(error)));
    };
    at('undo').addEventListener('click', () => step('undo'));
    at('redo').addEventListener('click', () => step('redo'));
    document.addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const inText = event.target instanceof HTMLInputElement && ['text', 'number'].includes(event.target.type);
      const key = event.key.toLowerCase();
      if (key === 's') this.saving.menu.open();
      else if (inText) return;
      else if (key === 'z') step(event.shiftKey ? 'redo' : 'undo');
      else if (key === 'y') step('redo');
      else return;
      event.preventDefault();
    });
  }

  private showLine({ state }: LineState): void {
    const banner = at('banner');
    banner.hidden = state === 'open' || state === 'opening';
    document.documentElement.dataset.line = state;
    if (banner.hidden) return;
    this.progress.show('', 0);
    const text = { lost: words.lost, refused: words.refused, taken: words.taken, open: '', opening: '' }[state];
    banner.replaceChildren(element('p', text));
    if (state === 'taken') banner.append(button(words.takeOver, 'quiet', () => this.connection.takeOver()));
  }

  /** Next to the panels that caused it. */
  private problem(text: string): void {
    const line = at('edit-problem');
    line.textContent = text;
    line.hidden = text === '';
  }
}

interface Greeting {
  program: string;
  keys: SceneKey[];
  presets: Preset[];
  tissues: StifferTissue[];
  regions: Region[];
  places: Places;
}

startPage(() => {
  fillWords(document);
  useSideWords({ letters: words.sideLetters, hints: { R: words.rightHint, L: words.leftHint } });
  new Studio();
});
