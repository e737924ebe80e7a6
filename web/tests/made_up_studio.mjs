// SPDX-License-Identifier: GPL-3.0-or-later
// The studio's page with a made-up face and a server of a few lines: neither the program nor a build is needed.
import { readFile } from 'node:fs/promises';
import { fewPixels } from './browser.mjs';
import { script, styles } from './modules.mjs';

const address = 'http://127.0.0.1:8123/';
const side = 9;

/** Collects arrays as a binary message has them. */
class Block {
  parts = [];
  length = 0;
  add(type, values) {
    const bytes = Buffer.from(values.buffer, values.byteOffset, values.byteLength);
    const at = { type, offset: this.length, count: values.length };
    const padded = Buffer.alloc(Math.ceil(bytes.length / 8) * 8);
    bytes.copy(padded);
    this.parts.push(padded);
    this.length += padded.length;
    return at;
  }
}

function binary(head, block) {
  const text = Buffer.from(JSON.stringify(head));
  const out = Buffer.alloc(Math.ceil((4 + text.length) / 8) * 8);
  out.writeUInt32LE(text.length);
  text.copy(out, 4);
  return Buffer.concat([out, ...block.parts]);
}

/** A dome of 16 cm, each vertex with its mirror image. */
function skin() {
  const points = new Float32Array(3 * side * side);
  const mirror = new Int32Array(3 * side * side).fill(-1);
  const triangles = [];
  for (let j = 0; j < side; ++j)
    for (let i = 0; i < side; ++i) {
      const [v, x, y] = [side * j + i, (i / (side - 1) - 0.5) * 0.16, (j / (side - 1) - 0.5) * 0.16];
      points.set([x, y, 0.08 - 5 * (x * x + y * y)], 3 * v);
      mirror[3 * v] = side * j + side - 1 - i;
      if (i + 1 < side && j + 1 < side) triangles.push(v, v + 1, v + side, v + 1, v + side + 1, v + side);
    }
  return { points, triangles: new Int32Array(triangles), mirror };
}

/** The motion of base or of a variant, which is the same. */
function motionOf(block, { points }) {
  const values = new Int16Array(points.length);
  for (let v = 0; v < points.length; v += 3) values[v + 1] = 1000;
  const modes = [{ step_m: 1e-6, values: block.add('int16', values) }];
  return { modes, weights: block.add('float32', new Float32Array([0, 1, 2])) };
}

/** A face in the table of the variants: nine tenths of what is added show. */
function rowOf({ name, values }) {
  const added = values['tissue.region'].reduce((sum, { volume_ml: ml = 0 }) => sum + ml, 0);
  return { name, ...(added !== 0 && { surgery: { landmarks: [], added_volume_ml: added, skin_volume_change_ml: 0.9 * added, greatest_at_rest_mm: 0.7 } }) };
}

function replayOf(block, { faces, remarks }) {
  const { points, triangles, mirror } = skin();
  const names = ['cheilion_L', 'cheilion_R', 'endocanthion_L', 'endocanthion_R'];
  const at = [[0.02, -0.03, 0.07], [-0.02, -0.03, 0.07], [0.02, 0.03, 0.07], [-0.02, 0.03, 0.07]];
  // The corners of the mouth rise by so much in each step.
  const landmarks = (stepM) => block.add('float32', new Float32Array([0, 1, 2].flatMap((f) =>
    at.flatMap(([x, y, z], i) => [x, y + (i < 2 ? f * stepM : 0), z]))));
  const { modes, weights } = motionOf(block, { points });
  return {
    version: 1, title: 'Made up', notes: [], summary: { remarks, warnings: remarks.map(({ text }) => text), variants: { table: faces.map(rowOf) }, peak_time_s: 1, head_shift_uncertainty_mm: 2.6, head_turn_uncertainty_deg: 1.3 },
    palette: { light: ['#147', '#a40'], dark: ['#8bf', '#fb8'], left: 0, right: 1, faces: [0, 1] },
    scan_vertices: side * side,
    skin: { points: block.add('float32', points), triangles: block.add('int32', triangles), light: block.add('uint8', new Uint8Array(points.length / 3).fill(255)), fade: block.add('uint8', new Uint8Array(points.length / 3).fill(255)) },
    motion: { time_s: [0, 0.5, 1], peak_frame: 2, modes, weights, max_error_mm: 0, max_displacement_mm: 2 },
    landmarks: { names, time_s: [0, 0.5, 1], positions: landmarks(0.004) },
    driven: { names: ['cheilion_L'], points: [at[0]] }, held: [at[2]], lip_cut: [], symmetry: null,
    mirror: { normal: [1, 0, 0], vertices: block.add('int32', mirror), weights: block.add('uint8', new Uint8Array(mirror.length).fill(255)) },
    point_words: {}, openings: [], eyeballs: [{ centre: [0.03, 0.03, 0.05], gaze: [0, 0, 1], radius_m: 0.012, light: block.add('uint8', new Uint8Array(3).fill(255)) }],
    // An eye of one triangle.
    eye_model: { middle: [0, 0, 0], points: { step_m: 1, values: block.add('int16', new Int16Array([0, 0, 1, 1, 0, 0, 0, 1, 0])) }, triangles: block.add('int16', new Int16Array([0, 1, 2])), colours: block.add('uint8', new Uint8Array(9).fill(90)) },
    variants: faces.slice(1).map(({ name }) => ({
      name, changes: [], difference: { ...motionOf(block, { points }), max_error_mm: 0 },
      max_displacement_mm: 2, max_difference_mm: 1, max_difference_frame: 2, symmetry: null, landmarks: landmarks(0.0025), tissue: [],
    })),
  };
}

const muscles = [['zyg_major', 'zygomatic'], ['frontal_med', 'temporal']].map(([name, branch]) => ({ name, latin: name, group: branch, branch }));
const key = (name, unit, low, high, value) => ({ name, kind: 'number', unit, low, high, choices: [], default: value, description: name });
const column = (name, unit, low, high, more) => ({ name, kind: 'number', unit, low, high, above_low: false, choices: [], description: name, ...more });
const table = (name, columns) => ({ name, kind: 'rows', unit: '', choices: [], default: [], description: name, columns });
/** Bounds are other ones than the program's: the page has none of its own. */
const keys = [
  key('tissue.young_kpa', 'kPa', 0, 1e4, 150), key('tissue.viscosity_pa_s', 'Pa s', 0, 1e4, 100), key('tissue.poisson', '', 0, 0.5, 0.45),
  key('tissue.density_kg_m3', 'kg/m^3', 0, 1e4, 1000), key('mesh.thickness_mm', 'mm', 1, 40, 0), key('motion.gain', '', 0, 5, 1),
  { ...key('muscles.gain', '', 0, 4, {}), kind: 'factors' },
  table('tissue.region', [
    column('young_factor', '', 0, 500, { above_low: true }), column('viscosity_factor', '', 0, 500), column('volume_ml', 'ml', -20, 8),
  ]),
  table('mesh.thickness_region', [column('thickness_mm', 'mm', 2, 30)]),
  table('surgery.bone', [column('move_mm', 'mm', -25, 25), column('turn_deg', 'deg', -12, 12), column('cut_shift_mm', 'mm', -9, 9)]),
];
const defaults = { ...Object.fromEntries(keys.map(({ name, default: value }) => [name, value])), 'motion.file': 'own.csv', 'motion.rigid_points': ['band_1', 'band_2', 'band_3'] };

const segment = (part, cut, turns_about, plane_at, plane_normal) => ({ part, cut, turns_about, plane_at, plane_normal, half_width_m: 0, ends_at: null });
/** Without the person's own bones. */
const bones = {
  axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], middle: [0, 0, 0], skull: null, mandible: null,
  segments: [
    segment('skull', 'whole', [0, 0, 0], [0, 0, 0], [0, 0, 0]), segment('maxilla', 'le_fort_1', [0, 0.01, 0.07], [0, 0.02, 0.07], [0, -1, 0]),
    segment('mandible', 'bsso', [0, -0.02, 0.07], [0, -0.02, 0.03], [0, 0, 1]), segment('chin', 'genioplasty', [0, -0.05, 0.06], [0, -0.04, 0.06], [0, -1, 0]),
  ],
};

/** What a session does with requests, as far as the page needs it. `remarksOf(faces)`: those on its motion. */
class Session {
  faces = [{ name: 'base', values: defaults }];
  requests = [];
  title = 'Made up';
  earlier = '';
  /** Requests that wait while this is an array. */
  held = null;
  constructor(socket, remarksOf) {
    Object.assign(this, { socket, remarksOf });
    socket.onMessage((text) => (this.held ? this.held.push(text) : this.answer(JSON.parse(text))));
  }
  /** Answers what waits. */
  release() {
    const waiting = this.held;
    this.held = null;
    for (const text of waiting) this.answer(JSON.parse(text));
  }
  send(message) {
    this.socket.send(JSON.stringify(message));
  }
  scene() {
    this.send({
      event: 'scene', title: this.title, values: this.faces.map(({ values }) => values), faces: this.faces.map(({ name, values }, i) => ({ name, changes: i === 0 ? {} : Object.fromEntries(Object.entries(values).filter(([k, v]) => v !== defaults[k])) })),
      points: ['band_1', 'band_2', 'band_3', 'band_4', 'cheilion_L'], drive: 'muscles', drive_why: 'the scene says so', earlier: this.earlier, can_undo: false, can_redo: false, saved: true, text: JSON.stringify(this.faces),
    });
  }
  moved(event) {
    const block = new Block();
    const replay = replayOf(block, { faces: this.faces, remarks: this.remarksOf(this.faces) });
    const head = event === 'face'
      ? { landmarks: [], muscles: { muscles, names: [] }, bones, thickness: block.add('float32', new Float32Array(side * side).fill(8)) }
      : { table: [], seconds: 0.1, bands: false };
    this.socket.send(binary({ event, replay, activations: null, ...head }, block));
  }
  /** Sends the error budget of base and of the first variant. */
  budget() {
    const figure = (of, side, value_mm, half_width_95_mm, more) => ({ figure: of, ...(side ? { side } : {}), value_mm, half_width_95_mm, known_half_width_95_mm: half_width_95_mm, largest_part: 'mesh', ...more });
    // What a figure has where the recording's jitter is not known.
    const unknown = { half_width_95_mm: null, largest_part: '' };
    const figures = [
      figure('excursion', 'R', 8, 1), figure('excursion', 'L', 8.04, 1), figure('difference', '', 0.04, 1.5, { decided: false }),
      ...this.faces.slice(1, 2).flatMap(({ name: variant }) => [figure('change', 'R', -2.94, 1, { variant, shown_mm: -3, decided: null, ...unknown }), figure('change', 'L', -0.01, 0.2, { variant, shown_mm: 0, decided: false })]),
    ];
    this.send({ event: 'budget', figures, missing: [], jitter_known: false, text: JSON.stringify(this.faces) });
  }
  answer({ id, do: name, ...fields }) {
    this.requests.push({ name, ...fields });
    const answers = {
      hello: () => ({ program: 'made up', keys, presets: [], tissues: [], regions: [{ name: 'cheek', meaning: 'the cheek' }], places: { folder: '/', open: true } }),
      add_variant: () => ({ face: this.faces.push({ name: fields.name, values: this.faces[fields.like].values }) - 1 }),
      set: () => {
        const face = this.faces[fields.face];
        const before = fields.face === 0 ? defaults : this.faces[0].values; // null goes back to it
        const changes = Object.fromEntries(Object.entries(fields.changes).map(([k, v]) => [k, v ?? before[k]]));
        if (!fields.live) Object.assign(face, { values: { ...face.values, ...changes }, name: fields.name ?? face.name });
        return { superseded: false };
      },
      free_name: () => ({ name: fields.name }),
      compare_visits: () => ({ path: `/mine/${fields.name}.html`, sentences: [`${fields.expression}: 4.6 mm less`] }),
      paint: () => ({ file: `painted-${this.requests.length}.csv` }),
    };
    const found = answers[name]?.();
    // The order of the program: the scene comes before the answer, but after the answer to hello.
    if (!['hello', 'region_shares', 'error_budget'].includes(name) && !fields.live) this.scene();
    this.send({ answer: id, ...found });
    if (name === 'error_budget') this.budget();
    if (name === 'hello') this.scene();
    if (name === 'hello' || (name === 'set' && !fields.live)) this.moved(name === 'hello' ? 'face' : 'motion');
  }
}

/** Opens the page; ready once the face is drawn. */
export async function openMadeUp(browser, remarksOf, { init, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: 'reduce', ...options });
  await fewPixels(context);
  if (init) await context.addInitScript(init);
  const page = await context.newPage();
  page.setDefaultTimeout(90_000);
  const complaints = [];
  page.on('console', (message) => {
    if (/GPU stall due to ReadPixels|readback operations/.test(message.text())) return;
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error.stack)));
  const html = await readFile(new URL('../studio.html', import.meta.url), 'utf8');
  const [code, css] = [await script('studio/main.ts', 'studio'), await styles('studio/main.ts')];
  await page.route(address, (route) => route.fulfill({
    contentType: 'text/html', body: html.replace(/<script.*<\/script>/, `<style>${css}</style><script src="code.js"></script>`),
  }));
  await page.route(`${address}code.js`, (route) => route.fulfill({ contentType: 'text/javascript', body: code }));
  let session = null;
  await page.routeWebSocket(/socket/, (socket) => (session = new Session(socket, remarksOf)));
  await page.goto(`${address}#token`);
  await page.waitForSelector('html[data-ready]').catch((error) => {
    throw new Error([error.message, ...complaints].join('\n'));
  });
  return { page, complaints, session: () => session, close: () => context.close() };
}
