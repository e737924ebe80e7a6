// SPDX-License-Identifier: GPL-3.0-or-later
// All that the studio's page says by itself. Another language is another object of this shape in `languages`.

const en = {
  // The frame of the page.
  title: 'Hyperex studio',
  unsaved: 'not saved',
  undo: 'Undo',
  undoHint: 'The scene as it was before the last change (Ctrl Z)',
  redo: 'Redo',
  redoHint: 'What undo took back (Ctrl Shift Z)',
  save: 'Save…',
  saveHint: 'Scene, report, all results or landmarks, as files (Ctrl S)',
  keys: 'Keys',
  useKeys: 'Use these keys',
  close: 'Close',
  noDevice: 'Hyperex is a research tool and no medical device.',
  leftSide: 'Files and messages',
  rightSide: 'What can be changed, and what comes of it',

  // Faces.
  facesRow: 'Faces',
  facesGroup: 'Face',
  base: 'Base',
  whatIf: 'What if…',
  whatIfHint: 'Another face beside this one: weaker muscles, other tissue (n)',
  swap: 'Swap',
  swapHint: 'Left and right face change places',
  modesGroup: 'How many faces',
  modeSingle: 'One',
  modeSideBySide: 'Side by side',
  modeWipe: 'Wipe',
  faceMenu: (name: string) => `More for ${name}`,
  rename: 'Rename',
  renameTo: 'New name',
  duplicate: 'Duplicate',
  remove: 'Delete',
  copyOf: (name: string) => `${name}, copy`,
  weakerTitle: 'A weaker side',
  weakerSide: 'Side',
  weakerBy: 'Weaker by',
  weakerAdd: 'Show it',
  weakerName: (side: string, percent: number) => `${side} side ${percent} % weaker`,
  sideNames: { R: 'Right', L: 'Left' } as Record<'L' | 'R', string>,
  presetsTitle: 'From a preset',
  presetAdd: 'Add',
  presetSource: (source: string, assumed: string) => `Source: ${source}. Assumed: ${assumed}.`,
  emptyTitle: 'Something else',
  emptyAdd: 'A copy of the face shown, to change',
  newVariant: 'What if',

  // The stage.
  stage: 'The face in motion',
  canvas: '3D view of the face; drag to turn, wheel to zoom, click for figures at a place; with the keyboard Shift and arrows, plus and minus',
  wipe: 'Line between the faces',
  savePicture: 'Save picture',
  savePictureHint: 'The view with names, time and colour bar, as a PNG file',
  noWebgl: 'This browser offers no WebGL, which the 3D view needs. Figures and panels still work.',
  frame: 'Frame',
  speed: 'Speed',
  loop: 'Loop',
  peak: 'Peak',
  peakHint: 'Where the driven points moved most',
  colouring: 'Colour the face by',
  views: 'View from',
  front: 'Front',
  threeQuarter: 'Three-quarter',
  left: 'Left',
  leftHint: 'The subject’s own left',
  right: 'Right',
  rightHint: 'The subject’s own right',
  overlays: 'Show',

  // Panels.
  panels: 'What to change',
  editing: 'Change the face',
  muscles: 'Muscles',
  tissue: 'Tissue',
  scene: 'Scene',
  whose: (name: string) => `Changes ${name}.`,
  whoseBase: 'The first change makes a “What if” beside the base, moved by the same muscle forces.',
  whoseBaseItself: 'Changes the base itself: its forces are found anew, so that it meets the recording again.',
  changeBase: 'Change the base itself',
  reset: (name: string) => `Reset ${name}`,
  inBase: (value: string) => `base ${value}`,
  number: (name: string, unit: string) => (unit ? `${name}, ${unit}` : name),
  regionTitle: 'In one part of the face',
  regionChoose: 'Part',
  regionBoth: (name: string) => `${name}, both sides`,
  regionStiffness: 'Stiffness there',
  regionHint: 'Multiplies Young’s modulus there (tissue.region); 1: as all other tissue',
  thicknessWhy: 'One mesh serves all faces: thickness belongs to the base.',
  thicknessAuto: 'From published depths',
  thicknessTakes: 'Takes a new mesh, some seconds.',
  keyNames: {
    'tissue.young_kpa': 'Stiffness (modulus E)',
    'tissue.viscosity_pa_s': 'Viscosity η',
    'tissue.poisson': 'Poisson’s ratio ν',
    'tissue.density_kg_m3': 'Density',
    'mesh.thickness_mm': 'Thickness',
    'motion.gain': 'Whole motion',
  } as Record<string, string>,
  strengths: 'Strength of the muscles',
  wholeSide: 'Whole side',
  branches: 'Branches of the facial nerve',
  branchNames: {
    temporal: 'Temporal', zygomatic: 'Zygomatic', buccal: 'Buccal', mandibular: 'Marginal mandibular', cervical: 'Cervical',
  } as Record<string, string>,
  palsy: 'Palsy',
  palsyShort: 'palsy',
  mute: 'M',
  solo: 'S',
  muteHint: (name: string) => `Mute ${name}: it does not pull`,
  soloHint: (name: string) => `Solo ${name}: no other muscle pulls`,
  ofSide: (name: string, side: string) => `${name}, ${side.toLowerCase()}`,
  resetMuscles: 'All muscles to 100 %',
  noMuscles: 'Recorded points carry this face. The first change of a muscle lets muscles drive it.',
  drivenBy: { muscles: 'Muscles drive', displacement: 'Recorded points drive', reactions: 'Forces drive' } as Record<string, string>,
  sceneText: 'The scene file as it would be saved',
  copy: 'Copy',
  copied: 'Copied.',

  // Figures.
  figures: 'Figures',
  cornersTitle: 'Corners of the mouth, farthest from rest',
  face: 'Face',
  nowIs: (value: string) => `now ${value}`,
  againstBase: (value: string) => `${value} to base`,
  asBase: 'as base',
  noBand: 'Without error bands while you edit: a change below 0.5 mm may be none. A saved report tells.',
  most: 'Differs most',
  mostHint: 'Greatest distance from base, of all places and times',
  nearPoint: (point: string) => `near ${point}`,
  noCorners: 'This scan has no points at the corners of the mouth.',
  undecided: (floor: string) => `Left and right differ by less than ${floor}, which jitter and mesh make: undecided.`,
  symmetry: 'Symmetry of motion, S(t)',
  corners: 'Corners of the mouth',

  // Open.
  open: 'Open',
  openNow: (title: string) => title || 'Untitled',
  embedded: 'Face that comes with Hyperex',
  startedWith: (name: string) => `Again ${name}`,
  chooseFiles: 'Choose files…',
  drop: 'or drop here: a scan (PLY, OBJ, STL, GLB), a recording (CSV, TRC, video, ARKit, OpenFace), a scene (TOML)',
  uploading: (name: string) => `Reading ${name}`,
  opening: 'Opening',
  autosave: 'Unsaved work of a session that ended is still here.',
  autosaveOpen: 'Open it',
  autosaveLeave: 'Leave it',
  tooManyScans: 'One scan at a time: expected a scan, a recording, or both, or a scene.',
  recordingAlone: 'A recording needs the scan that it moves: choose both files together.',
  discard: 'What is not saved is lost. Open anyway?',

  // Landmarks.
  landmarks: 'Landmarks',
  landmarksCorrect: 'Correct them',
  landmarksCorrectHint: 'Shows the points on the face at rest; drag them over the skin',
  landmarksDone: 'Use them',
  landmarksDoneHint: 'Makes the face anew with the points as they lie',
  landmarksLeave: 'Leave',
  landmarksSay: 'Drag a point over the skin; or choose it here, then press the arrow keys in the picture.',
  landmarkChosen: 'Point',
  landmarkReset: 'As found',
  landmarkCount: (count: number) => `${count} points lie on the scan.`,

  // Save.
  saveName: 'Name',
  saveInto: (folder: string) => `Into ${folder}`,
  saveScene: 'Scene',
  saveSceneHint: 'The scene file, for hyperex run',
  saveReport: 'Report',
  saveReportHint: 'One HTML file that replays all of this',
  saveRun: 'All results',
  saveRunHint: 'All that hyperex run writes, in a folder',
  saveLandmarks: 'Landmarks',
  saveLandmarksHint: 'For 3D Slicer',
  saved: (path: string) => `Saved: ${path}`,
  saving: 'Saving…',

  // Messages.
  messages: 'Messages',
  noMessages: 'None.',
  lost: 'The studio’s server does not answer. Trying again … Nothing that it kept is lost: start hyperex studio again where it ended.',
  refused: 'The server does not let this page in: open the address that hyperex studio printed, with all that stands behind #.',
  taken: 'The studio is open in another window.',
  takeOver: 'Go on here',
  working: 'Working',
  secondsTaken: (seconds: string) => `computed in ${seconds} s`,

  // Keys.
  keyUndo: 'undo',
  keyRedo: 'redo',
  keySave: 'save',
  keyWhatIf: 'what if …',
};

export type Words = typeof en;

const languages: Record<string, Words> = { en };

/** In the reader's language where there is one. */
export const words: Words = languages[navigator.language.slice(0, 2)] ?? en;

/** Fills what the page's elements say: data-word their text, data-name what is read aloud, data-hint the tooltip. */
export function fillWords(root: ParentNode): void {
  const texts = words as unknown as Record<string, string>;
  for (const element of root.querySelectorAll<HTMLElement>('[data-word], [data-name], [data-hint]')) {
    const { word, name, hint } = element.dataset;
    if (word) element.textContent = texts[word];
    if (name) element.setAttribute('aria-label', texts[name]);
    if (hint) element.title = texts[hint];
  }
}
