// SPDX-License-Identifier: GPL-3.0-or-later
// Single modules of the pages for tests, without the rest of the page.
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const source = join(dirname(fileURLToPath(import.meta.url)), '..', 'src');

async function bundled(module, options, ending = '.js') {
  const { outputFiles } = await build({ entryPoints: [join(source, module)], bundle: true, write: false, outdir: '/', target: 'es2022', ...options });
  return outputFiles.find(({ path }) => path.endsWith(ending)).text;
}

/** A module that needs no browser: "studio/remarks.ts". */
export const imported = async (module) =>
  import(`data:text/javascript,${encodeURIComponent(await bundled(module, { format: 'esm' }))}`);

/** The style sheets that a module and what it needs bring along, in one. */
export const styles = (module) => bundled(module, { format: 'iife' }, '.css');

/** A script that puts what a module exports into the global `name`. */
export const script = (module, name) => bundled(module, { format: 'iife', globalName: name });
