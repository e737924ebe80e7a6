// SPDX-License-Identifier: GPL-3.0-or-later
// The kind of a chosen or dropped file, by its extension and first bytes. Only clear mistakes are refused here; the
// server checks the rest. No DOM here.

export type FileKind = 'scan' | 'ct' | 'scene' | 'recording' | 'empty' | 'picture' | 'json' | 'torn video' | 'unknown';

const endings: [FileKind, RegExp][] = [
  ['scan', /\.(ply|obj|stl|glb|gltf)$/i],
  ['ct', /\.(nii|nii\.gz|nrrd)$/i],
  ['scene', /\.toml$/i],
  ['picture', /\.(jpe?g|png|gif|bmp|tiff?|webp|heic|avif|svg)$/i],
  ['json', /\.json$/i],
  ['recording', /\.(csv|trc|zip|oni|mp4|m4v|mov|avi|mkv|webm|mpe?g)$/i],
];

export const isZip = (name: string): boolean => /\.zip$/i.test(name);

/** Kinds of files with fixed first bytes: where these are. */
const beginnings: [RegExp, at: number, text: string[]][] = [
  [/\.(mp4|m4v|mov)$/i, 4, ['ftyp', 'moov', 'mdat', 'wide', 'free', 'skip']],
  [/\.avi$/i, 0, ['RIFF']],
  [/\.(mkv|webm)$/i, 0, ['\x1a\x45\xdf\xa3']],
];

/** A recording of pictures has a list of them; any other zip is taken for a CT's slices. The names of all files are at
 *  the end of a zip. */
async function isRecordingZip(file: Pick<File, 'size' | 'slice'>): Promise<boolean> {
  const most = 4 << 20;
  return new TextDecoder('latin1').decode(await file.slice(Math.max(0, file.size - most)).arrayBuffer()).includes('rgb.txt');
}

/** `file`: its name, its size, and some of its bytes on demand. */
export async function kindOf(file: Pick<File, 'name' | 'size' | 'slice'>): Promise<FileKind> {
  const { name, size } = file;
  const kind = endings.find(([, ending]) => ending.test(name))?.[0] ?? 'unknown';
  if (size === 0) return 'empty';
  if (isZip(name)) return (await isRecordingZip(file)) ? 'recording' : 'ct';
  const begins = beginnings.find(([ending]) => ending.test(name));
  if (!begins) return kind;
  const [, at, texts] = begins;
  const first = new Uint8Array(await file.slice(at, at + 4).arrayBuffer());
  return texts.includes(String.fromCharCode(...first)) ? kind : 'torn video';
}
