// SPDX-License-Identifier: GPL-3.0-or-later
// The eyes turn as the recording's gaze does, about their own centres.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { imported } from './modules.mjs';

/** A quaternion x y z w of a turn about y, which is to the subject's left above 0. */
const aside = (rad) => [0, Math.sin(rad / 2), 0, Math.cos(rad / 2)];

const light = new Uint8Array(3).fill(255);
const eyeballs = [-0.03, 0.03].map((x) => ({ centre: [x, 0.03, 0.05], gaze: [0, 0, 1], radiusM: 0.012, light }));
const eyeModel = { points: new Float32Array([0, 0, 1, 1, 0, 0, 0, 1, 0]), triangles: new Uint32Array([0, 1, 2]), colours: new Uint8Array(9) };

/** How far to the subject's left each eye looks, radians. */
const asideOf = (eyes) =>
  eyes.objects.map((ball) => {
    ball.updateMatrix();
    const [x, , z] = ball.matrix.elements.slice(8, 11);
    return Math.atan2(x, z);
  });
const near = (found, wanted) => found.forEach((one, i) => assert.ok(Math.abs(one - wanted[i]) < 1e-6, `${found} for ${wanted}`));

test('each eye looks where it looked in the frame, and between frames in between', async () => {
  const { Eyes } = await imported('replay/face/eyes.ts');
  const eyes = new Eyes({ eyeballs, eyeModel });
  const gaze = new Float32Array([...aside(0), ...aside(0), ...aside(0.2), ...aside(0.4)]);
  eyes.turn(gaze, 0);
  near(asideOf(eyes), [0, 0]);
  eyes.turn(gaze, 0.5);
  near(asideOf(eyes), [0.1, 0.2]);
  eyes.turn(gaze, 1);
  near(asideOf(eyes), [0.2, 0.4]);
  assert.deepEqual(eyes.objects.map(({ position }) => position.toArray()), eyeballs.map(({ centre }) => centre));
  eyes.turn(null, 1);
  near(asideOf(eyes), [0, 0]);
});

test('an eye turns from where it looks at rest', async () => {
  const { Eyes } = await imported('replay/face/eyes.ts');
  const gaze = [Math.sin(0.3), 0, Math.cos(0.3)];
  const eyes = new Eyes({ eyeballs: eyeballs.map((eye) => ({ ...eye, gaze })), eyeModel });
  eyes.turn(null, 0);
  near(asideOf(eyes), [0.3, 0.3]);
  eyes.turn(new Float32Array([...aside(0.1), ...aside(-0.1)]), 0);
  near(asideOf(eyes), [0.4, 0.2]);
});

/** Rings of `sectors` points about +z, as the program's model has them. */
function ball(angles, sectors) {
  const points = angles.flatMap((angle) =>
    Array.from({ length: sectors }, (_, k) => {
      const around = (2 * Math.PI * k) / sectors;
      return [Math.sin(angle) * Math.cos(around), Math.sin(angle) * Math.sin(around), Math.cos(angle)];
    }).flat());
  return new Float32Array(points);
}

test('the shadow of the lids stays where it is while the eye turns', async () => {
  const { Eyes } = await imported('replay/face/eyes.ts');
  const points = ball([0, 0.2, 0.4, 0.6, 0.8, 1, 1.3, 1.6, 2, 2.5, Math.PI], 32);
  const count = points.length / 3;
  // Bright above, dark below.
  const shade = Uint8Array.from({ length: count }, (_, v) => (points[3 * v + 1] > 0.001 ? 255 : 0));
  const white = { points, triangles: new Uint32Array([0, 1, 2]), colours: new Uint8Array(3 * count).fill(255) };
  const eyes = new Eyes({ eyeballs: [{ ...eyeballs[0], light: shade }], eyeModel: white });
  const up = (rad) => [-Math.sin(rad / 2), 0, 0, Math.cos(rad / 2)];
  const pupil = () => eyes.objects[0].children[0].geometry.getAttribute('color').array[0];
  const gaze = new Float32Array([...up(0), ...up(0), ...up(0.5), ...up(0), ...up(-0.5), ...up(0)]);
  eyes.turn(gaze, 0);
  assert.equal(pupil(), 0);
  eyes.turn(gaze, 1);
  assert.ok(pupil() > 0.95, `looks up into the light: ${pupil()}`);
  eyes.turn(gaze, 2);
  assert.ok(pupil() < 0.05, `looks down into the dark: ${pupil()}`);
});
