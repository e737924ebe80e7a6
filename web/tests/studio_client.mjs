// SPDX-License-Identifier: GPL-3.0-or-later
// A studio and a client of its socket without a page: for measurements and tests of the server.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';

const { ws: WebSocket } = createRequire(import.meta.url)('playwright-core/lib/utilsBundle');

/** Starts `program studio --no-browser ...args` and waits for its address. */
export async function startStudio(program, args = [], options = {}) {
  const server = spawn(program, ['studio', '--no-browser', ...args], { stdio: ['ignore', 'pipe', 'ignore'], ...options });
  const address = await new Promise((resolve, reject) => {
    server.stdout.once('data', (bytes) => resolve(String(bytes).trim()));
    server.once('exit', (code) => reject(new Error(`the studio ended with ${code}`)));
  });
  return {
    address, server,
    stop: () => new Promise((resolve) => {
      server.once('exit', resolve);
      server.kill('SIGINT');
    }),
  };
}

/** A client that is let in: `ask` answers' promises, `event` the next event of a name, `on` each from now on. */
export async function connect(address) {
  const url = new URL(address);
  const socket = new WebSocket(`ws://${url.host}/socket`, { origin: url.origin });
  await new Promise((resolve, reject) => {
    socket.once('open', resolve);
    socket.once('error', reject);
  });
  let id = 0;
  const answers = new Map();
  const listeners = new Map();
  const every = new Map();
  socket.on('message', (data, binary) => {
    const message = JSON.parse(binary ? data.subarray(4, 4 + data.readUInt32LE(0)) : data);
    if ('answer' in message) {
      answers.get(message.answer)?.(message);
      answers.delete(message.answer);
    } else {
      for (const resolve of listeners.get(message.event) ?? []) resolve(message);
      listeners.delete(message.event);
      every.get(message.event)?.(message);
    }
  });
  const client = {
    ask: (name, fields = {}) => new Promise((resolve) => {
      answers.set(++id, resolve);
      socket.send(JSON.stringify({ id, do: name, ...fields }));
    }),
    event: (name) => new Promise((resolve) => {
      listeners.set(name, [...(listeners.get(name) ?? []), resolve]);
    }),
    on: (name, listener) => every.set(name, listener),
    close: () => socket.close(),
  };
  client.hello = await client.ask('hello', { token: url.hash.slice(1), version: 1 });
  return client;
}
