// SPDX-License-Identifier: GPL-3.0-or-later
// The stage: the face in 3D and the controls around it.
import { drawColourBar } from './colour_bar';
import { colouringsOf, type Colouring, type Painting, type Scale } from './colouring';
import type { Face, Replay } from '../data';
import { at, element } from '../../page/dom';
import { Undoing } from '../../page/listeners';
import { wireSheet } from '../../page/menu';
import { changeMode, chooseFace, wireFaces } from './face_chooser';
import { faceHue } from '../../page/face_colour';
import { faceWords } from '../../page/format';
import type { Key } from '../keys';
import { cornerFigures } from '../corners';
import { headCaption, headUncertainty } from '../head_pose';
import { drawPicture, pngOf, type PictureParts } from './picture';
import { printedStage } from './printed_stage';
import type { Playback } from '../playback';
import { fileName, save, subject } from '../../page/save';
import type { Shown } from '../shown';
import { theme } from '../../page/theme';
import { Readout } from './readout';
import { changesOf } from '../variants';
import { showSideMarks } from './side_marks';
import type { View } from './view_camera';
import { FaceViewer } from './viewer';
import { WipeHandle } from './wipe_handle';

const pictureScale = 2;
/** Scale of the picture on paper, where a stage is some 9 cm wide. */
const paperScale = 1.5;

/** Actions of the pointer. They are in the list of keys, since the page has no other such list. */
const byPointer = { when: () => false, act: () => {} };

export class Stage {
  private viewer: FaceViewer | null = null;
  private wipe: WipeHandle | null = null;
  private readout: Readout | null = null;
  private colourings: Colouring[];
  private colouring: Colouring;
  /** A colouring in addition to the replay's own, and the one chosen before it. */
  private lent: { colouring: Colouring; before: string } | null = null;
  private painting: Painting;
  private sayOfFaces: (note: (face: Face) => string) => void;
  private timeS = 0;
  /** Subscriptions until the stage is removed, and until the next motion. */
  private readonly undoing = new Undoing();
  private facesUndoing = new Undoing();

  constructor(private readonly replay: Replay, private readonly shown: Shown) {
    this.colourings = colouringsOf(replay);
    this.colouring = this.colourings[0];
    this.painting = this.colouring.of(shown.visible);
    this.sayOfFaces = wireFaces(replay, shown, this.facesUndoing);
    try {
      this.viewer = new FaceViewer(at<HTMLCanvasElement>('face'), at('canvas-host'), replay, shown, this.painting);
    } catch {
      this.goWithout();
      return;
    }
    this.wireViews();
    this.fillColourings();
    this.fillOverlays();
    this.wireWipe();
    this.wireReadout();
    let announced = shown.visible.join();
    this.undoing.add(showSideMarks(this.viewer, at('canvas-host')), shown.onChange(() => {
      this.paint();
      // Listeners are also called after a new motion of the same faces. That is no choice, and so it is not announced.
      if (shown.visible.join() !== announced) this.announce();
      announced = shown.visible.join();
    }));
    at('save-picture').addEventListener('click', () => void this.savePicture(), { signal: this.undoing.signal });
  }

  /** The face in 3D; null where the browser has no WebGL. */
  get face(): FaceViewer | null {
    return this.viewer;
  }

  /** The colour scale of the quantity shown. Null if the face is drawn in its own colours. */
  get colours(): Scale | null {
    return this.painting.scale;
  }

  /** Whether the page may begin to play by itself. What the processor draws is coarse while it moves, and a reader may
   *  want no motion. */
  get playsByItself(): boolean {
    return !window.matchMedia('(prefers-reduced-motion: reduce)').matches && !this.viewer?.pace.software;
  }

  /** Call it after a new motion or new variants: makes colours and their ranges, names and overlays again. The choices
   *  and the camera are kept. */
  refresh(): void {
    this.facesUndoing.undo();
    this.facesUndoing = new Undoing();
    this.sayOfFaces = wireFaces(this.replay, this.shown, this.facesUndoing);
    this.colourings = colouringsOf(this.replay);
    this.colouring = this.choices.find(({ key }) => key === this.colouring.key) ?? this.colourings[0];
    if (!this.viewer) return;
    this.viewer.refresh();
    this.fillColourings();
    this.fillOverlays();
  }

  /** Adds a colouring to the replay's own and chooses it; null: removes it and restores the previous choice. */
  lend(colouring: Colouring | null): void {
    if (!this.viewer) return;
    const chosen = this.lent && this.colouring === this.lent.colouring ? this.lent.before : this.colouring.key;
    this.lent = colouring && { colouring, before: chosen };
    this.colouring = colouring ?? this.colourings.find(({ key }) => key === chosen) ?? this.colourings[0];
    this.fillColourings();
  }

  /** After the values of a colouring have changed. */
  repaint(): void {
    if (this.viewer) this.paint();
  }

  /** Removes the stage; its elements can then be used by another one. */
  dispose(): void {
    this.facesUndoing.undo();
    this.undoing.undo();
    this.readout?.dispose();
    this.viewer?.dispose();
    // A canvas belongs to its first context.
    const canvas = at('face');
    canvas.replaceWith(canvas.cloneNode());
  }

  moveTo(frame: number, { timeS, playing }: Playback): void {
    this.timeS = timeS;
    this.viewer?.moveTo(frame, playing);
  }

  /** Keyboard shortcuts of the stage. */
  keys(): Key[] {
    const { replay, shown, viewer } = this;
    if (!viewer) return [];
    const keys: Key[] = [];
    if (replay.faces.length > 1) {
      const digit = (event: KeyboardEvent) => Number(/^(?:Digit|Numpad)([1-9])$/.exec(event.code)?.[1] ?? 0);
      const either = (mode: 'side-by-side' | 'wipe') => () => changeMode(shown, shown.mode === mode ? 'single' : mode);
      keys.push(
        {
          shown: '1 to 9', does: 'face; of two faces the right one, with Shift the left one',
          when: (event) => digit(event) > 0,
          act(event) {
            if (event.shiftKey) shown.set({ first: digit(event) - 1 });
            else chooseFace(shown, digit(event) - 1);
          },
        },
        { shown: 's', does: 'two faces side by side, and back', when: ['s'], act: either('side-by-side') },
        { shown: 'w', does: 'wipe between two faces, and back', when: ['w'], act: either('wipe') },
        { shown: 'x', does: 'left and right face change places', when: ['x'], act: () => at('swap').click() },
      );
    }
    const turn = (key: string, yaw: number, pitch: number): [string, () => void] => [key, () => viewer.view.turn(yaw, pitch)];
    const turns = new Map([
      turn('ArrowLeft', -10, 0), turn('ArrowRight', 10, 0), turn('ArrowUp', 0, 10), turn('ArrowDown', 0, -10),
    ]);
    keys.push(
      { shown: 'm', does: 'next colouring', when: ['m'], act: () => this.nextColouring() },
      {
        shown: 'Shift and arrows', does: 'turn the face',
        when: (event) => event.shiftKey && turns.has(event.key), act: (event) => turns.get(event.key)!(),
      },
      { shown: 'Drag', does: 'turn the face', ...byPointer },
      { shown: 'Right-drag', does: 'move the picture; on a touch screen with two fingers', ...byPointer },
      { shown: 'Wheel', does: 'nearer, farther where the pointer is; of faces side by side in their middle', ...byPointer },
      { shown: '+ or -', does: 'nearer, farther', when: ['+', '=', '-'], act: ({ key }) => viewer.view.zoom(key === '-' ? 1 / 1.15 : 1.15) },
      { shown: 'f', does: 'from the front', when: ['f'], act: () => at('views').querySelector('button')!.click() },
      {
        shown: 'Escape', does: 'clear the figures at a place; a click on the face shows them',
        when: ({ key }) => key === 'Escape' && this.readout!.visible, act: () => this.readout!.clear(),
      },
      { shown: 'e', does: 'save the picture', when: ['e'], act: () => void this.savePicture() },
    );
    return keys;
  }

  private goWithout(): void {
    at('no-webgl').hidden = false;
    // The studio's page has no list of faces here.
    for (const id of ['face', 'view-tools', 'faces', 'first-label', 'second-label', 'save-picture', 'colour-key']) document.getElementById(id)?.toggleAttribute('hidden', true);
  }

  private wireViews(): void {
    const buttons = [...at('views').querySelectorAll('button')];
    for (const button of buttons)
      button.addEventListener('click', () => {
        for (const other of buttons) other.setAttribute('aria-pressed', String(other === button));
        this.viewer!.view.lookFrom(button.dataset.view as View);
      }, { signal: this.undoing.signal });
    wireSheet(at('show-overlays'), at('overlays-sheet'), () => {}, this.undoing.signal);
  }

  private get choices(): Colouring[] {
    return this.lent ? [...this.colourings, this.lent.colouring] : this.colourings;
  }

  private fillColourings(): void {
    at('colouring').replaceChildren();
    for (const colouring of this.choices) {
      const button = document.createElement('button');
      button.type = 'button';
      button.dataset.colouring = colouring.key;
      button.textContent = colouring.label;
      button.addEventListener('click', () => this.setColouring(colouring));
      at('colouring').append(button);
    }
    this.setColouring(this.colouring);
  }

  private setColouring(colouring: Colouring): void {
    this.colouring = colouring;
    for (const button of at('colouring').querySelectorAll('button'))
      button.setAttribute('aria-pressed', String(button.dataset.colouring === colouring.key));
    this.paint();
  }

  /** Colourings may depend on the faces shown. */
  private paint(): void {
    const painting = this.colouring.of(this.shown.visible);
    this.painting = painting;
    this.viewer!.paintAs(painting);
    drawColourBar(at('colour-bar'), painting.scale);
    const caution = at('colour-caution');
    caution.textContent = painting.caution ?? '';
    caution.hidden = !painting.caution;
    this.sayOfFaces((face) => painting.note(face));
  }

  private nextColouring(): void {
    const colourings = this.choices;
    this.setColouring(colourings[(colourings.indexOf(this.colouring) + 1) % colourings.length]);
    this.announce();
  }

  /** Announces a choice by key to screen readers. */
  private announce(): void {
    const { replay, shown, colouring, painting } = this;
    const faces = shown.visible.map((i) => faceWords(replay.faces, i));
    const named = replay.faces.length > 1 ? `${faces.join(', right ')}; ` : '';
    at('announcement').textContent = `${faces.length > 1 ? 'left ' : ''}${named}${painting.scale?.title ?? colouring.label}`;
  }

  private fillOverlays(): void {
    const chosen = new Set([...at('overlays').querySelectorAll('input')].filter((box) => box.checked).map((box) => box.dataset.overlay));
    at('overlays').replaceChildren();
    at('show-overlays').hidden = this.viewer!.overlays.length === 0;
    for (const overlay of this.viewer!.overlays) {
      const label = document.createElement('label');
      const box = document.createElement('input');
      box.type = 'checkbox';
      box.dataset.overlay = overlay.name;
      box.checked = chosen.has(overlay.name);
      if (box.checked) this.viewer!.showOverlay(overlay.name, true);
      box.addEventListener('change', () => this.viewer!.showOverlay(overlay.name, box.checked));
      const swatch = document.createElement('i');
      swatch.style.background = overlay.colour;
      const said = element('span', overlay.label);
      if (overlay.legend) said.append(element('small', overlay.legend));
      label.append(box, swatch, said);
      at('overlays').append(label);
    }
  }

  private wireWipe(): void {
    const { shown, replay, viewer } = this;
    const names = (): [string, string] =>
      [faceWords(replay.faces, shown.first), faceWords(replay.faces, shown.second)];
    const wipe = new WipeHandle(at('wipe'), at('canvas-host'), names, (share) => viewer!.setWipe(share), this.undoing.signal);
    const show = () => wipe.show(shown.mode === 'wipe');
    this.undoing.add(shown.onChange(show));
    show();
    this.wipe = wipe;
  }

  private wireReadout(): void {
    const { replay, shown, viewer } = this;
    this.readout = new Readout(
      at('canvas-host'), at('face'), viewer!, replay, shown,
      () => ({ colouring: this.colouring, painting: this.painting }),
      (text) => (at('announcement').textContent = text),
    );
  }

  /** The stage as it stands, for paper, which WebGL leaves blank; null without WebGL. The faces are taken now, and the
   *  returned function draws them in the colours of its time. */
  forPaper(): (() => HTMLElement) | null {
    if (!this.viewer) return null;
    const [stage, marks] = [this.viewer.snapshot(paperScale), this.viewer.sideMarks];
    return () => printedStage({ ...this.parts, stage, marks, scale: paperScale });
  }

  /** The parts of a picture in the page's present colours. */
  private get parts(): Omit<PictureParts, 'stage' | 'marks' | 'scale'> {
    const { replay, shown, timeS, wipe } = this;
    const { palette } = theme();
    const named = replay.faces.length > 1 ? shown.visible : [];
    const pose = headUncertainty(replay);
    return {
      title: subject(),
      time: `${timeS.toFixed(3)} s`,
      faces: named.map((i) => ({
        name: faceWords(replay.faces, i),
        changes: [...cornerFigures(replay, i, timeS), changesOf(replay, i).join(', ')].filter((text) => text),
        colour: palette[faceHue(i)],
      })),
      divided: shown.mode === 'single' ? null : shown.mode === 'wipe' ? wipe!.at : 0.5,
      colours: this.painting.scale,
      cautions: [...(pose ? [headCaption(pose)] : []), ...(this.painting.caution ? [this.painting.caution] : [])],
    };
  }

  private async savePicture(): Promise<void> {
    const { replay, shown, timeS } = this;
    const named = replay.faces.length > 1 ? shown.visible : [];
    const picture = drawPicture({
      ...this.parts, stage: this.viewer!.snapshot(pictureScale), marks: this.viewer!.sideMarks, scale: pictureScale,
    });
    const faces = named.map((i) => replay.faces[i].name);
    save(await pngOf(picture), fileName(subject(), ...faces, `${timeS.toFixed(3)} s`, 'png'));
  }
}
