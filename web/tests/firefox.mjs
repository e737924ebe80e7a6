// SPDX-License-Identifier: GPL-3.0-or-later
// Firefox by WebDriver BiDi (https://w3c.github.io/webdriver-bidi/), which Playwright does not support with a Firefox as
// distributions ship it. It runs on a display of its own (Xvfb), as headless it has no WebGL, which Mesa then draws in
// software.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

const { ws: WebSocket } = createRequire(import.meta.url)('playwright-core/lib/utilsBundle');

/** FIREFOX, or where Debian has it; null: none. */
export function firefoxProgram() {
  const places = process.env.FIREFOX ? [process.env.FIREFOX] : ['/usr/bin/firefox-esr', '/usr/bin/firefox'];
  return places.find(existsSync) ?? null;
}

const xvfb = '/usr/bin/Xvfb';

/** Why there is no Firefox to test with; empty where there is. */
export const noFirefox = () => (!firefoxProgram() ? 'Firefox is not installed' : !existsSync(xvfb) ? 'Xvfb is not installed' : '');

/** A display that nobody sees. */
async function startDisplay() {
  const child = spawn(xvfb, ['-displayfd', '1', '-screen', '0', '1400x1000x24', '-nolisten', 'tcp'], { stdio: ['ignore', 'pipe', 'ignore'] });
  const name = await new Promise((done, fail) => {
    createInterface({ input: child.stdout }).once('line', done);
    child.once('close', (code) => fail(new Error(`Xvfb ended with ${code}`)));
  });
  return { name: `:${name}`, stop: () => child.kill() };
}

const prefs = {
  'webgl.force-enabled': true,
  'webgl.disabled': false,
  'gfx.webrender.software': true,
  'ui.prefersReducedMotion': 1,
  'browser.shell.checkDefaultBrowser': false,
  'browser.startup.page': 0,
  'datareporting.policy.dataSubmissionEnabled': false,
  'app.update.enabled': false,
  'network.captive-portal-service.enabled': false,
  'network.connectivity-service.enabled': false,
};

/** Commands and events of WebDriver BiDi over one socket. */
async function connect(address) {
  const socket = new WebSocket(address);
  await new Promise((done, fail) => socket.once('open', done).once('error', fail));
  let id = 0;
  const waiting = new Map();
  const heard = [];
  socket.on('message', (text) => {
    const message = JSON.parse(text);
    if (message.id === undefined) {
      for (const listener of heard) listener(message);
      return;
    }
    const { done, fail } = waiting.get(message.id);
    waiting.delete(message.id);
    if (message.type === 'error') fail(new Error(`${message.error}: ${message.message}`));
    else done(message.result);
  });
  const send = (method, params = {}) => new Promise((done, fail) => {
    waiting.set(++id, { done, fail });
    socket.send(JSON.stringify({ id, method, params }));
  });
  return { socket, send, heard };
}

export async function launchFirefox(own = {}) {
  const profile = await mkdtemp(join(tmpdir(), 'hyperex-firefox-'));
  const lines = Object.entries({ ...prefs, ...own }).map(([key, value]) => `user_pref(${JSON.stringify(key)}, ${JSON.stringify(value)});\n`);
  await writeFile(join(profile, 'user.js'), lines.join(''));
  const display = await startDisplay();
  const child = spawn(firefoxProgram(), ['--no-remote', '--profile', profile, '--remote-debugging-port', '0', '--width', '1280', '--height', '800', 'about:blank'], {
    stdio: ['ignore', 'ignore', 'pipe'], env: { ...process.env, HOME: profile, DISPLAY: display.name, LIBGL_ALWAYS_SOFTWARE: '1' },
  });
  const ended = new Promise((done) => child.on('close', done));
  const address = await new Promise((done, fail) => {
    createInterface({ input: child.stderr }).on('line', (line) => {
      const found = /WebDriver BiDi listening on (ws:\S+)/.exec(line);
      if (found) done(found[1]);
    });
    void ended.then((code) => fail(new Error(`Firefox ended with ${code}`)));
  });
  const { socket, send, heard } = await connect(`${address}/session`);
  await send('session.new', { capabilities: {} });
  return {
    /** A page that remembers what the console complains of. */
    async open(url) {
      const { contexts: [{ context }] } = await send('browsingContext.getTree');
      const complaints = [];
      heard.push(({ method, params }) => {
        if (method === 'log.entryAdded' && ['error', 'warn'].includes(params.level)) complaints.push(params.text);
      });
      await send('session.subscribe', { events: ['log.entryAdded'] });
      await send('browsingContext.setViewport', { context, viewport: { width: 1280, height: 720 } });
      await send('browsingContext.navigate', { context, url, wait: 'complete' });
      return new FirefoxPage(send, context, complaints);
    },
    async close() {
      await send('browser.close').catch(() => {});
      socket.close();
      const late = setTimeout(() => child.kill('SIGKILL'), 5000);
      await ended;
      clearTimeout(late);
      display.stop();
      await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    },
  };
}

class FirefoxPage {
  constructor(send, context, complaints) {
    Object.assign(this, { send, context, complaints });
  }

  /** Runs a function in the page. Its arguments and its result are passed as JSON. */
  async evaluate(run, ...args) {
    const expression = `JSON.stringify((${run})(...${JSON.stringify(args)}) ?? null)`;
    const answer = await this.send('script.evaluate', { expression, target: { context: this.context }, awaitPromise: true });
    if (answer.type === 'exception') throw new Error(answer.exceptionDetails.text);
    return JSON.parse(answer.result.value);
  }

  async until(run, ...args) {
    const end = Date.now() + 120_000;
    while (Date.now() < end) {
      const value = await this.evaluate(run, ...args);
      if (value) return value;
      await new Promise((done) => setTimeout(done, 100));
    }
    throw new Error(`never: ${run}`);
  }

  text(selector) {
    return this.evaluate((s) => document.querySelector(s)?.textContent ?? '', selector);
  }

  async press(...points) {
    const move = ([x, y]) => ({ type: 'pointerMove', x: Math.round(x), y: Math.round(y), duration: 20 });
    const [first, ...rest] = points;
    const actions = [move(first), { type: 'pointerDown', button: 0 }, ...rest.map(move), { type: 'pointerUp', button: 0 }];
    await this.send('input.performActions', { context: this.context, actions: [{ type: 'pointer', id: 'mouse', actions }] });
  }

  /** The middle of an element, scrolled to. */
  async click(selector, nth = 0) {
    const place = await this.until((s, n) => {
      const found = document.querySelectorAll(s)[n];
      found?.scrollIntoView({ block: 'nearest' });
      const box = found?.getBoundingClientRect();
      return box?.width && !found.disabled && [box.x + box.width / 2, box.y + box.height / 2];
    }, selector, nth);
    await this.press(place);
  }

  async type(text) {
    const actions = [...text].flatMap((value) => [{ type: 'keyDown', value }, { type: 'keyUp', value }]);
    await this.send('input.performActions', { context: this.context, actions: [{ type: 'key', id: 'keys', actions }] });
  }

  /** Over what stands in the field. */
  async fill(selector, text) {
    await this.click(selector);
    await this.evaluate((s) => void document.querySelector(s).select(), selector);
    await this.type(text);
  }

  async screenshot() {
    const { data } = await this.send('browsingContext.captureScreenshot', { context: this.context });
    return Buffer.from(data, 'base64');
  }
}
