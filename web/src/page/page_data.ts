// SPDX-License-Identifier: GPL-3.0-or-later
// Where the data come from: the two script elements of the page, as src/hyperex/report/page_data.cpp
// writes them. No other file refers to them.

import { defineColours, type Palette } from './face_colour';

/** A stretch of the binary block: `count` little-endian numbers from byte `offset` on. */
export interface Stretch {
  type: 'float32' | 'int32' | 'int16' | 'int8' | 'uint8';
  offset: number;
  count: number;
}

/** The arrays of the binary block. */
export interface Block {
  float32: (at: Stretch) => Float32Array<ArrayBuffer>;
  int32: (at: Stretch) => Int32Array<ArrayBuffer>;
  int16: (at: Stretch) => Int16Array<ArrayBuffer>;
  int8: (at: Stretch) => Int8Array<ArrayBuffer>;
  uint8: (at: Stretch) => Uint8Array<ArrayBuffer>;
}

function bytesOf(base64: string): ArrayBuffer {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

/** `binary` from `start` on, a multiple of 8. */
export const blockOf = (binary: ArrayBuffer, start = 0): Block => ({
  float32: (s) => new Float32Array(binary, start + s.offset, s.count),
  int32: (s) => new Int32Array(binary, start + s.offset, s.count),
  int16: (s) => new Int16Array(binary, start + s.offset, s.count),
  int8: (s) => new Int8Array(binary, start + s.offset, s.count),
  uint8: (s) => new Uint8Array(binary, start + s.offset, s.count),
});

function textOf(id: string): string {
  const text = document.getElementById(id)?.textContent ?? null;
  if (text === null) throw new Error(`This page holds no data (${id} is missing): it is only a template.`);
  return text;
}

/** Reads the page's data and sets its palette; throws where there are none or their version is not 1. */
export function readPageData<M extends { version: number }>(): { manifest: M; block: Block } {
  const manifest = JSON.parse(textOf('hyperex-manifest')) as M & { palette: Palette };
  if (manifest.version !== 1) throw new Error(`Unknown version of the data: ${manifest.version}`);
  defineColours(manifest.palette);
  return { manifest, block: blockOf(bytesOf(textOf('hyperex-binary').trim())) };
}
