// SPDX-License-Identifier: GPL-3.0-or-later
// The socket to the server that this page came from: requests and their answers, events, uploads.
import { Listeners, type Undo } from '../page/listeners';
import { blockOf, type Block } from '../page/page_data';
import { protocolVersion, type Events, type Requests } from './protocol';

type Name = keyof Requests;
type EventName = keyof Events;
type Fields<K extends Name> = Requests[K]['fields'];
type Answer<K extends Name> = Requests[K]['answer'];
export type Received<K extends EventName> = Events[K] & { block: Block };

/** The server refused a request; the message is a sentence for the user. */
export class Refused extends Error {}

/** "open": the server has answered hello. "lost": the connection is being tried again. "refused": another server, or a
 *  wrong token. "taken": another page is connected to the server. */
export interface LineState {
  state: 'opening' | 'open' | 'lost' | 'refused' | 'taken';
}

const tokenKey = 'hyperex-studio-token';
const retryMs = 1000;

/** Takes the token out of the address and keeps it for reloads of the page. */
export function takeToken(): string {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem(tokenKey, given);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return sessionStorage.getItem(tokenKey) ?? '';
}

interface Waiting {
  done(answer: unknown): void;
  fail(error: Error): void;
}

/** A message with arrays: the length of its text, the text, zeros up to a multiple of 8 bytes, the block. */
export function readBinary(message: ArrayBuffer): { head: Record<string, unknown>; block: Block } {
  const length = new DataView(message).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(message, 4, length));
  const start = Math.ceil((4 + length) / 8) * 8;
  return { head: JSON.parse(text) as Record<string, unknown>, block: blockOf(message, start) };
}

const noBlock = blockOf(new ArrayBuffer(0));

export class Connection {
  private socket: WebSocket | null = null;
  private next = 1;
  private readonly waiting = new Map<number, Waiting>();
  private readonly heard = new Map<string, Listeners<Received<EventName>>>();
  private readonly changed = new Listeners<LineState>();
  private retry = 0;
  /** Whether hello was answered since the last connection. */
  private inside = false;
  private line: LineState = { state: 'opening' };

  /** `greeted`: called with each answer to hello, also after a reconnection. */
  constructor(private readonly token: string, private readonly greeted: (answer: Answer<'hello'>) => void) {}

  get state(): LineState {
    return this.line;
  }

  onState(listener: (state: LineState) => void): Undo {
    return this.changed.add(listener);
  }

  on<K extends EventName>(name: K, listener: (event: Received<K>) => void): Undo {
    let listeners = this.heard.get(name);
    if (!listeners) this.heard.set(name, (listeners = new Listeners()));
    return listeners.add(listener as unknown as (event: Received<EventName>) => void);
  }

  connect(): void {
    clearTimeout(this.retry);
    this.inside = false;
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(`${scheme}//${location.host}/socket`);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => void this.greet();
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => this.take(data);
    socket.onclose = ({ code }) => this.lost(code);
  }

  /** Takes the server over from another page. */
  takeOver(): void {
    this.be({ state: 'opening' });
    this.connect();
  }

  /** Rejects with Refused where the server refuses, with another error where the connection is down. */
  request<K extends Name>(name: K, fields: Fields<K>): Promise<Answer<K>> {
    if (this.socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error('not connected'));
    const id = this.next++;
    this.socket.send(JSON.stringify({ id, do: name, ...fields }));
    return new Promise((done, fail) => this.waiting.set(id, { done: done as (answer: unknown) => void, fail }));
  }

  /** Uploads a file; returns the name that `open` takes. */
  async upload(file: File): Promise<string> {
    const answer = await fetch(`/upload/${encodeURIComponent(file.name)}`, {
      method: 'POST', body: file, headers: { Authorization: `Bearer ${this.token}` },
    });
    const text = await answer.text();
    if (!answer.ok) throw new Refused(text.trim() || `${file.name}: ${answer.status}`);
    return (JSON.parse(text) as { name: string }).name;
  }

  private async greet(): Promise<void> {
    try {
      const answer = await this.request('hello', { token: this.token, version: protocolVersion });
      this.inside = true;
      this.be({ state: 'open' });
      this.greeted(answer);
    } catch (error) {
      if (error instanceof Refused) this.be({ state: 'refused' });
    }
  }

  private be(state: LineState): void {
    this.line = state;
    this.changed.notify(state);
  }

  private lost(code: number): void {
    this.socket = null;
    for (const { fail } of this.waiting.values()) fail(new Error('the connection was lost'));
    this.waiting.clear();
    if (this.line.state === 'refused') return;
    // The token was wrong, so trying again is useless.
    const never = code === 1008 && !this.inside;
    if (never || code === 1001) {
      this.be({ state: never ? 'refused' : 'taken' });
      return;
    }
    this.be({ state: 'lost' });
    this.retry = window.setTimeout(() => this.connect(), retryMs);
  }

  private take(data: string | ArrayBuffer): void {
    const { head, block } = typeof data === 'string'
      ? { head: JSON.parse(data) as Record<string, unknown>, block: noBlock }
      : readBinary(data);
    if (typeof head.event === 'string') {
      this.heard.get(head.event)?.notify({ ...head, block } as unknown as Received<EventName>);
      return;
    }
    const id = Number(head.answer);
    const waiting = this.waiting.get(id);
    this.waiting.delete(id);
    if (typeof head.error === 'string') waiting?.fail(new Refused(head.error));
    else waiting?.done(head);
  }
}
