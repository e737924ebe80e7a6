// SPDX-License-Identifier: GPL-3.0-or-later
// One file: report.html, or the page that HYPEREX_PAGE names, with scripts and styles inside. The
// program that writes it puts the data where the page says HYPEREX_DATA.
import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: 'es2022',
    reportCompressedSize: false,
    chunkSizeWarningLimit: 2000,
    rollupOptions: { input: process.env.HYPEREX_PAGE ?? 'report.html' },
  },
});
