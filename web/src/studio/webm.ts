// SPDX-License-Identifier: GPL-3.0-or-later
// Encoded pictures in a WebM file (Matroska, RFC 9559; its tags are those of EBML, RFC 8794): one track, whole in memory,
// with an index, so that players find any time. No DOM here.

export interface EncodedPicture {
  timeMs: number;
  key: boolean;
  bytes: Uint8Array;
}

export interface WebmVideo {
  codec: 'V_VP8' | 'V_VP9';
  width: number;
  height: number;
  /** In their order, the first a key picture at 0. */
  pictures: EncodedPicture[];
  durationMs: number;
}

type Part = Uint8Array | Part[];

const lengthOf = (part: Part): number => (part instanceof Uint8Array ? part.length : part.reduce((sum, one) => sum + lengthOf(one), 0));

function flat(part: Part, into: Uint8Array[] = []): Uint8Array[] {
  if (part instanceof Uint8Array) into.push(part);
  else for (const one of part) flat(one, into);
  return into;
}

/** Big-endian, in `length` bytes. */
function whole(value: number, length: number): Uint8Array {
  const bytes = new Uint8Array(length);
  for (let i = length - 1, rest = value; i >= 0; --i, rest = Math.floor(rest / 256)) bytes[i] = rest % 256;
  return bytes;
}

const text = (value: string): Uint8Array => new TextEncoder().encode(value);

function double(value: number): Uint8Array {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return bytes;
}

/** Lengths in eight bytes: the same for every size, so that places in the file are known before it is written. */
function tag(id: number, content: Part): Part {
  const length = whole(lengthOf(content), 8);
  length[0] |= 0x01;
  return [whole(id, Math.ceil(Math.log2(id + 1) / 8)), length, content];
}

const number = (id: number, value: number): Part => tag(id, whole(value, Math.max(1, Math.ceil(Math.log2(value + 1) / 8))));

const [mainTrack, videoKind] = [1, 1];
/** Of a picture's time in its cluster, ms: 16 bits with a sign. */
const longestClusterMs = 30_000;

function clustersOf(pictures: EncodedPicture[]): EncodedPicture[][] {
  const clusters: EncodedPicture[][] = [];
  for (const picture of pictures) {
    const now = clusters.at(-1);
    if (!now || picture.key || picture.timeMs - now[0].timeMs > longestClusterMs) clusters.push([picture]);
    else now.push(picture);
  }
  return clusters;
}

function clusterTag(pictures: EncodedPicture[]): Part {
  const startMs = Math.round(pictures[0].timeMs);
  return tag(0x1f43b675, [
    number(0xe7, startMs),
    ...pictures.map(({ timeMs, key, bytes }) =>
      tag(0xa3, [whole(0x80 + mainTrack, 1), whole(Math.round(timeMs) - startMs, 2), whole(key ? 0x80 : 0, 1), bytes])),
  ]);
}

export function webmOf({ codec, width, height, pictures, durationMs }: WebmVideo): Blob {
  const head = tag(0x1a45dfa3, [
    number(0x4286, 1), number(0x42f7, 1), number(0x42f2, 4), number(0x42f3, 8), tag(0x4282, text('webm')), number(0x4287, 4), number(0x4285, 2),
  ]);
  const info = tag(0x1549a966, [
    number(0x2ad7b1, 1e6), tag(0x4489, double(durationMs)), tag(0x4d80, text('Hyperex')), tag(0x5741, text('Hyperex')),
  ]);
  const tracks = tag(0x1654ae6b, tag(0xae, [
    number(0xd7, mainTrack), number(0x73c5, mainTrack), number(0x9c, 0), number(0x83, videoKind), tag(0x86, text(codec)),
    tag(0xe0, [number(0xb0, width), number(0xba, height)]),
  ]));
  const groups = clustersOf(pictures);
  const clusters = groups.map(clusterTag);
  let at = lengthOf([info, tracks]);
  const cues = groups.map((group, i) => {
    const point = tag(0xbb, [number(0xb3, Math.round(group[0].timeMs)), tag(0xb7, [number(0xf7, mainTrack), number(0xf1, at)])]);
    at += lengthOf(clusters[i]);
    return point;
  });
  const segment = tag(0x18538067, [info, tracks, clusters, tag(0x1c53bb6b, cues)]);
  return new Blob(flat([head, segment]) as BlobPart[], { type: 'video/webm' });
}
