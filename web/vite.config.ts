// SPDX-License-Identifier: GPL-3.0-or-later
// One file: report.html, or the page that HYPEREX_PAGE names, with scripts and styles inside. The
// program that writes it puts the data where the page says HYPEREX_DATA.
import { defineConfig, type Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

// The finished page may ask nothing of anyone: scripts and styles stand in it, pictures it makes itself. In the
// finished page alone: while it is developed Vite serves its parts.
// The studio's alone talks, to the server that it came from.
const page = process.env.HYPEREX_PAGE ?? 'report.html';
const talks = page === 'studio.html' ? "; connect-src 'self'" : '';
const policy = `default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:${talks}`;
const withPolicy: Plugin = {
  name: 'content-security-policy',
  apply: 'build',
  transformIndexHtml: (html) => html.replace('<meta charset="utf-8" />', (first) =>
    `${first}\n    <meta http-equiv="Content-Security-Policy" content="${policy}" />`),
};

export default defineConfig({
  plugins: [withPolicy, viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: 'es2022',
    reportCompressedSize: false,
    chunkSizeWarningLimit: 2000,
    rollupOptions: { input: page },
  },
});
