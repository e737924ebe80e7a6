// SPDX-License-Identifier: GPL-3.0-or-later
// How soon the studio answers, and whether its memory, threads and files stay as they are:
//   node bench/studio_bench.mjs build/release/bin/hyperex [SCENE.toml] [--soak MINUTES]
//   node bench/studio_bench.mjs build/release/bin/hyperex [SCENE.toml] --live RECORDING
//   node bench/studio_bench.mjs build/release/bin/hyperex [SCENE.toml] [--live RECORDING] --page
// With --page times are from moving a slider, or from the camera's frame, to having it drawn in Chromium, whose WebGL is
// drawn in software on the same cores.
// Times are from sending a request to having its event, over the loopback interface.
import { readdirSync, readFileSync } from 'node:fs';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { resolve } from 'node:path';
import { launch } from '../web/tests/browser.mjs';
import { openStudio } from '../web/tests/studio_server.mjs';
import { connect, startStudio } from '../web/tests/studio_client.mjs';

const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const [program, ...rest] = process.argv.slice(2);
const soakAt = rest.indexOf('--soak');
const soakMinutes = soakAt < 0 ? 0 : Number(rest.splice(soakAt, 2)[1]);
const liveAt = rest.indexOf('--live');
const recording = liveAt < 0 ? '' : resolve(rest.splice(liveAt, 2)[1]);
const pageAt = rest.indexOf('--page');
if (pageAt >= 0) rest.splice(pageAt, 1);
/** Whatever happens, no server and no browser are left behind. */
const ends = [];
async function leave(code) {
  for (const end of ends.splice(0).reverse()) await end().catch((error) => console.error(`studio_bench: ${error.message}`));
  process.exit(code);
}
for (const event of ['uncaughtException', 'unhandledRejection'])
  process.on(event, (error) => {
    console.error(`studio_bench: ${error.message}`);
    void leave(1);
  });
const folder = mkdtempSync(join(tmpdir(), 'hyperex-studio-'));
ends.push(async () => rmSync(folder, { recursive: true, force: true, maxRetries: 3 }));
const begun = performance.now();
const studio = await startStudio(resolve(program), [...rest.map((file) => resolve(file)), ...(recording ? ['--device', `play:${recording}`] : [])], {
  cwd: folder, env: { ...process.env, XDG_STATE_HOME: folder },
});
ends.push(() => studio.stop());
if (pageAt >= 0) {
  await inPage();
  await leave(0);
}
const client = await connect(studio.address);
const face = client.event('face');
await client.ask('open', { what: client.hello.places.started ? 'started' : 'embedded' });
const { replay } = await face;
console.log(`first motion ${((performance.now() - begun) / 1e3).toFixed(2)} s after the command, ` +
  `${replay.skin.points.count / 3} vertices, ${replay.motion.time_s.length} frames`);

const timeS = replay.motion.time_s[replay.motion.peak_frame];
async function timed(fields, event) {
  const from = performance.now();
  const came = client.event(event);
  const answer = await client.ask('set', { face: 1, time_s: timeS, ...fields });
  if (answer.error) throw new Error(answer.error);
  await came;
  return performance.now() - from;
}
async function series(what, count, fields, event) {
  const times = [];
  for (let i = 0; i < count; ++i) times.push(await timed(fields(i), event));
  console.log(`${what}: median ${quantile(times, 0.5).toFixed(0)} ms, 95 % ${quantile(times, 0.95).toFixed(0)} ms (${count})`);
}
if (recording) {
  await live();
  client.close();
  await leave(0);
}

/** What the user of a page waits for. */
async function inPage() {
  const browser = await launch();
  ends.push(() => browser.close());
  const { page } = await openStudio(browser, studio.address);
  console.log(`page ready ${((performance.now() - begun) / 1e3).toFixed(2)} s after the command, ` +
    `${await page.evaluate(() => document.getElementById('face').width)} x ${await page.evaluate(() => document.getElementById('face').height)} pixels of face`);
  if (recording) {
    await page.click('#live-panel .choices button');
    await page.waitForSelector('#live-panel[data-live=ended]', { timeout: 120_000 });
    console.log((await page.locator('.live-figures').innerText()).replaceAll('\n', ' '));
  } else {
    await page.click('#to-peak');
    // Where points drive, the first change of a muscle is another drive, not a slider's step.
    const muscles = await page.evaluate(() => /^(driven by muscles|muscles drive)/i.test(document.querySelector('#panels .drive').textContent));
    for (const [what, tab, selector] of [['strength of a muscle', 'muscles', '[data-gain=zygomatic_R]'], ['tissue', 'tissue', '[data-key="tissue.young_kpa"] input[type=range]']]) {
      if (tab === 'muscles' && !muscles) continue;
      await page.click(`#tab-${tab}`);
      const times = await page.evaluate(async (which) => {
        const slider = document.querySelector(which);
        const gl = document.getElementById('face').getContext('webgl2');
        const shapes = () => Number(document.documentElement.dataset.shapes ?? 0);
        const out = [];
        slider.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true })); // held, as by a hand
        for (let i = 0; i < 42; ++i) {
          const before = shapes();
          const from = performance.now();
          slider.value = String(300 + 7 * i);
          slider.dispatchEvent(new Event('input', { bubbles: true }));
          await new Promise((done, fail) => requestAnimationFrame(function look() {
            if (shapes() > before) setTimeout(done);
            else if (performance.now() > from + 60_000) fail(new Error(`no shape came in a minute: ${document.getElementById('edit-problem').textContent}`));
            else requestAnimationFrame(look);
          }));
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // browsers only flush at finish()
          out.push(performance.now() - from);
        }
        slider.dispatchEvent(new PointerEvent('pointerup', { bubbles: true }));
        return out;
      }, selector);
      const [first] = times.splice(0, 2); // the first makes the face that is changed
      await page.waitForFunction(() => document.documentElement.dataset.current === 'true');
      console.log(`${what}, slider to pixels: median ${quantile(times, 0.5).toFixed(0)} ms, 95 % ${quantile(times, 0.95).toFixed(0)} ms (${times.length}); ` +
        `first ${first.toFixed(0)} ms, drawing alone ${await page.evaluate(() => document.getElementById('face').dataset.drawMs)} ms`);
    }
  }
}

/** A recording at its own pace: what reaches a client that draws nothing, tracker included. */
async function live() {
  const times = [];
  client.on('live_shape', ({ frame }) => {
    times.push(performance.now());
    void client.ask('live_drawn', { frame });
  });
  const ended = new Promise((done) => client.on('live', (told) => {
    last = told.delay_ms === null ? last : told;
    if (told.state === 'ended') done();
  }));
  let last = null;
  const { error } = await client.ask('live_start', { what: 'device', face: 0 });
  if (error) throw new Error(error);
  await ended;
  // The first ones come late, when the face has been learnt.
  const steady = times.slice(15);
  const rate = (steady.length - 1) / ((steady.at(-1) - steady[0]) / 1e3);
  console.log(`live: ${rate.toFixed(1)} frames a second, delay ${last.delay_ms.toFixed(0)} ms in the median, 95 % within ${last.delay_95_ms.toFixed(0)} ms ` +
    `(alignment and step ${last.step_ms.toFixed(0)} ms); ${last.frames} tracked, ${last.dropped} dropped, ${last.not_drawn} not sent`);
}
const motion = client.event('motion');
await client.ask('add_variant', { name: 'other', like: 0, preset: 'palsy_complete_R' });
await motion;
const gain = (i) => ({ changes: { 'muscles.gain': { side_R: 0.2 + 0.01 * (i % 60) } } });
const young = (i) => ({ changes: { 'tissue.young_kpa': 100 + (i % 60) } });
await series('strength of a muscle, one frame', 40, (i) => ({ ...gain(i), live: true }), 'shape');
await series('tissue, one frame', 40, (i) => ({ ...young(i), live: true }), 'shape');
await series('strength of a muscle, whole motion', 10, (i) => ({ ...gain(i), live: false }), 'motion');
await series('tissue, whole motion', 10, (i) => ({ ...young(i), live: false }), 'motion');

/** Of the server's process. */
function state() {
  const of = (name) => Number(new RegExp(`${name}:\\s+(\\d+)`).exec(readFileSync(`/proc/${studio.server.pid}/status`, 'utf8'))[1]);
  return { mb: of('VmRSS') / 1024, threads: of('Threads'), files: readdirSync(`/proc/${studio.server.pid}/fd`).length };
}
if (soakMinutes > 0) {
  const until = performance.now() + 6e4 * soakMinutes;
  let told = 0;
  for (let i = 0; performance.now() < until; ++i) {
    for (let k = 0; k < 5; ++k) await timed({ ...(i % 2 ? gain(5 * i + k) : young(5 * i + k)), live: true }, 'shape');
    await timed({ ...(i % 2 ? gain(i) : young(i)), live: false }, 'motion');
    if (i % 5 === 0) {
      const undone = client.event('motion');
      await client.ask('undo');
      await undone;
    }
    if (i % 20 === 0) {
      const more = client.event('motion');
      await client.ask('add_variant', { name: `v${i}`, like: 1 });
      await more;
      const fewer = client.event('motion');
      await client.ask('remove_variant', { face: 2 });
      await fewer;
    }
    if (performance.now() > told + 3e4) {
      told = performance.now();
      const { mb, threads, files } = state();
      console.log(`${((told - begun) / 6e4).toFixed(1)} min, cycle ${i}: ${mb.toFixed(0)} MB, ${threads} threads, ${files} files`);
    }
  }
}
client.close();
await leave(0);
