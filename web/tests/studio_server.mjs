// SPDX-License-Identifier: GPL-3.0-or-later
// A studio of one's own: the program's server in an empty folder, and a page of it in a browser.
import { spawn } from 'node:child_process';
import { existsSync, readdirSync, statSync } from 'node:fs';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { fewPixels } from './browser.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

/** HYPEREX, or the newest build's; null where none is built. */
export function program() {
  if (process.env.HYPEREX) return existsSync(process.env.HYPEREX) ? process.env.HYPEREX : null;
  const build = join(root, 'build');
  const found = existsSync(build)
    ? readdirSync(build).map((preset) => join(build, preset, 'bin', 'hyperex')).filter(existsSync)
    : [];
  return found.sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs)[0] ?? null;
}

/** Runs the program to its end; its standard output. */
export async function run(args, { cwd, env = {} }) {
  const child = spawn(program(), args, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'] });
  let [out, err] = ['', ''];
  child.stdout.on('data', (text) => (out += text));
  child.stderr.on('data', (text) => (err += text));
  const code = await new Promise((done) => child.on('close', done));
  if (code !== 0) throw new Error(`hyperex ${args.join(' ')}: ${code}\n${err}`);
  return out;
}

/** Starts `hyperex studio` with these arguments. What it keeps lies in its folder. Error bands, which keep the
 *  processors busy beside the browser, are computed only for tests that look at them. */
export async function startStudio(args = [], { port, folder: given, bands = false } = {}) {
  const folder = given ?? (await mkdtemp(join(tmpdir(), 'hyperex-studio-')));
  const env = { XDG_STATE_HOME: join(folder, 'state'), XDG_CACHE_HOME: join(folder, 'cache') };
  const child = spawn(program(), ['studio', '--no-browser', ...(bands ? [] : ['--no-bands']), ...(port ? ['--port', String(port)] : []), ...args], {
    cwd: folder, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'],
  });
  let err = '';
  child.stderr.on('data', (text) => (err += text));
  const ended = new Promise((done) => child.on('close', done));
  const address = await new Promise((done, fail) => {
    createInterface({ input: child.stdout }).on('line', (line) => {
      const found = /http:\/\/\S+/.exec(line);
      if (found) done(found[0]);
    });
    void ended.then((code) => fail(new Error(`hyperex studio ended with ${code}: ${err}`)));
  });
  const end = async (signal) => {
    child.kill(signal);
    await ended;
  };
  return {
    address, folder, env, port: Number(new URL(address).port),
    /** What it has printed to standard error. */
    said: () => err,
    kill: () => end('SIGKILL'),
    stop: async () => {
      await end('SIGTERM');
      await rm(folder, { recursive: true, force: true });
    },
  };
}

/** A place of the embedded face, so many heights of the picture right of its middle and below its top: the face is as
 *  high as the picture. */
export async function placeOnFace(page, right, below) {
  const { x, y, width, height } = await page.locator('#canvas-host').boundingBox();
  return [x + width / 2 + right * height, y + below * height];
}

/** Another face beside base: what is typed after "What if …", "right side 70", and Enter. */
export async function askWhatIf(page, typed) {
  await page.click('#what-if');
  await page.fill('.sheet:popover-open .chooser-find', typed);
  await page.keyboard.press('Enter');
}

/** A page of the studio that remembers everything that should not happen; ready once the face is drawn. */
export async function openStudio(browser, address, { ready = true, ...options } = {}) {
  const context = await browser.newContext({
    viewport: { width: 1280, height: 720 }, reducedMotion: 'reduce', acceptDownloads: true, ...options,
  });
  await fewPixels(context);
  const page = await context.newPage();
  page.setDefaultTimeout(120_000); // a video is drawn frame by frame, and this machine may have other work
  const complaints = [];
  page.on('console', (message) => {
    if (/GPU stall due to ReadPixels|readback operations using getImageData/.test(message.text())) return;
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  const { origin } = new URL(address);
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(`${origin}/`) && !/^(data|blob):/.test(url)) complaints.push(`request to ${url}`);
  });
  await page.goto(address);
  if (ready) await page.waitForSelector('html[data-ready]');
  return { page, complaints, close: () => context.close() };
}
