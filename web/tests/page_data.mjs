// SPDX-License-Identifier: GPL-3.0-or-later
// The data as they stand in a page's file, read and changed by other code than the page's.
import { readFile } from 'node:fs/promises';

const element = (id) => new RegExp(`(<script id="${id}"[^>]*>)([\\s\\S]*?)(</script>)`);

const scriptSafe = (data) => JSON.stringify(data).replaceAll('<', '\\u003c');

export async function readPage(file) {
  const html = await readFile(file, 'utf8');
  const data = JSON.parse(element('hyperex-manifest').exec(html)[2]);
  const bytes = Buffer.from(element('hyperex-binary').exec(html)[2], 'base64');
  const floats = ({ offset, count }) => Array.from({ length: count }, (_, i) => bytes.readFloatLE(offset + 4 * i));
  return { html, data, floats, bytes };
}

/** A page that has no data yet, with some. */
export const withFirstData = (html, data) =>
  html.replace('<!--HYPEREX_DATA-->', () =>
    `<script id="hyperex-manifest" type="application/json">${scriptSafe(data)}</script>\n` +
    '<script id="hyperex-binary" type="application/octet-stream;base64"></script>\n');

/** The page with other data about the same arrays. */
export const withData = (html, data) =>
  html.replace(element('hyperex-manifest'), (_all, open, _old, close) =>
    open + scriptSafe(data) + close);
