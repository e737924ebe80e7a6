// SPDX-License-Identifier: GPL-3.0-or-later
// One file: report.html, or the page that HYPEREX_PAGE names, with scripts and styles inside. The
// program that writes it puts the data where the page says HYPEREX_DATA.
import { readFileSync } from 'node:fs';
import { defineConfig, type Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

// The finished page loads nothing: it contains its scripts and styles and draws its pictures. The policy is set in the
// finished page alone, since Vite serves the parts during development. Only the studio's page may connect, to the
// server that it came from.
const page = process.env.HYPEREX_PAGE ?? 'report.html';
const talks = page === 'studio.html' ? "; connect-src 'self'" : '';
const policy = `default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:${talks}`;
const withPolicy: Plugin = {
  name: 'content-security-policy',
  apply: 'build',
  transformIndexHtml: (html) => html.replace('<meta charset="utf-8" />', (first) =>
    `${first}\n    <meta http-equiv="Content-Security-Policy" content="${policy}" />`),
};

// The MIT licence of the packages in a page (three.js, uPlot) requires its text in every copy.
const packageOf = (module: string) => /.*\/node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(module)?.[1];
const notices = (packages: string[]) => packages.map((name) => {
  const folder = new URL(`node_modules/${name}/`, import.meta.url);
  const { version, license } = JSON.parse(readFileSync(new URL('package.json', folder), 'utf8'));
  return `${name} ${version} (${license})\n\n${readFileSync(new URL('LICENSE', folder), 'utf8').trim()}\n`;
}).join('\n');
const withNotices: Plugin = {
  name: 'third-party-notices',
  apply: 'build',
  transformIndexHtml: {
    order: 'post',
    handler: (html, { bundle }) => {
      const modules = Object.values(bundle ?? {}).flatMap((part) => part.type === 'chunk' ? part.moduleIds : []);
      const packages = [...new Set(modules.map(packageOf).filter((name) => name !== undefined))].sort();
      if (packages.length === 0) return html;
      const text = `This page is part of Hyperex (GPL-3.0-or-later) and carries these packages:\n\n${notices(packages)}`;
      return html.replace('</body>', () => `  <!--\n${text.replaceAll('--', '- -')}-->\n  </body>`);
    },
  },
};

export default defineConfig({
  plugins: [withPolicy, withNotices, viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: 'es2022',
    reportCompressedSize: false,
    chunkSizeWarningLimit: 2000,
    rollupOptions: { input: page },
  },
});
