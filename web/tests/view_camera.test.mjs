// SPDX-License-Identifier: GPL-3.0-or-later
// Where the camera stands before a face.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { imported } from './modules.mjs';

const nothing = () => {};
const listens = { addEventListener: nothing, removeEventListener: nothing };
const canvas = { ...listens, style: {}, ownerDocument: listens };
/** What must be visible: a face of the usual size about the origin, m. */
const size = [0.15, 0.19, 0.12];
const room = { getCenter: (out) => out.set(0, 0, 0), getSize: (out) => out.set(...size) };
const mouth = { y: -0.045, z: 0.05 };

async function cameraFrom(view) {
  const { ViewCamera } = await imported('replay/face/view_camera.ts');
  const made = new ViewCamera(canvas, room, nothing);
  made.lookFrom(view);
  return made.camera;
}

test('from in front the mouth is seen almost level, so that the upper lip does not hide the teeth', async () => {
  const { position } = await cameraFrom('front');
  assert.ok(Math.abs(position.x) < 1e-9);
  const above = (Math.atan2(position.y - mouth.y, position.z - mouth.z) * 180) / Math.PI;
  assert.ok(above > 0 && above < 4, `${above} degrees from above`);
});

test('from in front the face fills the picture', async () => {
  const { position, fov } = await cameraFrom('front');
  const shown = Math.tan((fov * Math.PI) / 360) * (position.z - size[2] / 2);
  assert.ok(shown > size[1] / 2 && shown < 1.15 * (size[1] / 2), `${shown} m of ${size[1] / 2}`);
});

test('three quarters are seen from a little above', async () => {
  const { position } = await cameraFrom('three-quarter');
  assert.ok(position.x > 0.4 * position.length(), 'the subject\'s left');
  assert.ok(position.y > 0.02 * position.length() && position.y < 0.06 * position.length());
});
