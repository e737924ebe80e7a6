// SPDX-License-Identifier: GPL-3.0-or-later
// The tracking as the other parts use it: curves of plain numbers and their properties.
import { readPageData } from '../page/page_data';
import type { Manifest } from './manifest';

export type Group = Manifest['channels'][number]['group'];

export interface Channel {
  group: Group;
  name: string;
  facs: string;
  values: (number | null)[];
  /** Range of all values that are not null; 0 where there is none. */
  least: number;
  most: number;
  /** Their frames. */
  leastAt: number;
  mostAt: number;
  any: boolean;
}

export interface Tracking extends Omit<Manifest, 'channels' | 'index' | 'time_s'> {
  timeS: number[];
  index: Int32Array;
  channels: Channel[];
}

const none = -32768;

function channelOf(from: Manifest['channels'][number], raw: Int16Array): Channel {
  const per = Math.round(1 / from.step) || 1 / from.step;
  const values = Array.from(raw, (step) => (step === none ? null : step / per));
  const channel: Channel = {
    group: from.group, name: from.name, facs: from.facs, values, any: false,
    least: Infinity, most: -Infinity, leastAt: 0, mostAt: 0,
  };
  values.forEach((value, frame) => {
    if (value === null) return;
    channel.any = true;
    if (value < channel.least) [channel.least, channel.leastAt] = [value, frame];
    if (value > channel.most) [channel.most, channel.mostAt] = [value, frame];
  });
  if (!channel.any) channel.least = channel.most = 0;
  return channel;
}

export function readTracking(): Tracking {
  const { manifest, block } = readPageData<Manifest>();
  const { channels, index, time_s, ...facts } = manifest;
  return {
    ...facts,
    timeS: time_s,
    index: block.int32(index),
    channels: channels.map((channel) => channelOf(channel, block.int16(channel.values))),
  };
}

/** The stretches of time around frames that are not valid, each reaching halfway to its neighbours. */
export function faultSpans({ timeS, faults }: Tracking): [number, number][] {
  const last = timeS.length - 1;
  const between = (a: number, b: number) => (timeS[a] + timeS[b]) / 2;
  return faults.map((f) => [
    f.first > 0 ? between(f.first - 1, f.first) : timeS[0],
    f.last < last ? between(f.last, f.last + 1) : timeS[last],
  ]);
}

export const faultAt = (tracking: Tracking, frame: number): string | null =>
  tracking.faults.find((f) => f.first <= frame && frame <= f.last)?.fault ?? null;
