// SPDX-License-Identifier: GPL-3.0-or-later
// The charts other than those of units: the curves and the text of each.
import type { Chart, Curve } from '../charts/chart_options';
import { signed, upper } from '../page/format';
import type { Channel, Group, Tracking } from './data';

export interface Section {
  title: string;
  caption: string;
  charts: Chart[];
}

const left = { hue: 0 };
const right = { hue: 1, broken: true };

/** "Most: 28.3 mm at 1.33 s." or, of two sides, "Least: left ..., right ...". */
function extremeText(tracking: Tracking, which: 'least' | 'most', channels: Channel[], labels: string[], unit: string): string {
  const extremes = channels.map((c, i) => {
    const frame = which === 'least' ? c.leastAt : c.mostAt;
    const label = labels.length > 1 ? `${labels[i]} ` : '';
    return `${label}${signed(c[which].toFixed(1))} ${unit} at ${tracking.timeS[frame].toFixed(2)} s`;
  });
  return `${upper(which)}: ${extremes.join(', ')}.`;
}

function rangeOf(channels: Channel[], span: number, fromZero: boolean): [number, number] {
  const most = Math.max(...channels.map((c) => c.most));
  if (fromZero) return [0, Math.max(1.05 * most, span)];
  const least = Math.min(...channels.map((c) => c.least));
  const half = Math.max(0.55 * (most - least), span / 2);
  const middle = (least + most) / 2;
  return [middle - half, middle + half];
}

class Maker {
  constructor(private readonly tracking: Tracking) {}

  find(group: Group, names: string[]): Channel[] {
    return names.flatMap((name) => this.tracking.channels.filter((c) => c.group === group && c.name === name && c.any));
  }

  /** Nothing where the tracking has none of the curves. `styles` and `labels` are those of `names`. */
  chart(group: Group, names: string[], made: {
    title: string; caption: string; yLabel: string; unit: string; digits: number;
    styles: Partial<Curve>[]; labels: string[]; extremes?: ('least' | 'most')[];
    /** Least range shown, so that noise does not look like motion. */
    span: number; fromZero?: boolean; range?: [number, number];
  }): Chart[] {
    const curves: Curve[] = [];
    const used: Channel[] = [];
    names.forEach((name, i) => {
      const [channel] = this.find(group, [name]);
      if (!channel) return;
      used.push(channel);
      curves.push({ ...made.styles[i], label: made.labels[i], values: channel.values });
    });
    if (curves.length === 0) return [];
    const labels = curves.map((c) => c.label);
    const extremes = (made.extremes ?? []).map((which) => extremeText(this.tracking, which, used, labels, made.unit));
    const { title, yLabel, digits } = made;
    const range = made.range ?? rangeOf(used, made.span, made.fromZero ?? false);
    return [{
      title, yLabel, digits, curves, range, unit: made.unit === '°' ? '°' : ` ${made.unit}`, timeS: this.tracking.timeS,
      caption: [made.caption, ...extremes].join(' '),
    }];
  }
}

function headSection(tracking: Tracking, make: Maker): Section {
  const styles = [{ hue: 2 }, { hue: 3, broken: true }, { hue: 4 }];
  return {
    title: 'Head',
    caption: tracking.reference < 0 ? '' : `Relative to the first valid frame (frame ${tracking.index[tracking.reference]}).`,
    charts: [
      ...make.chart('turn', ['yaw', 'pitch', 'roll'], {
        title: 'Turn', yLabel: 'turn (°)', unit: '°', digits: 2, span: 4, styles, labels: ['yaw', 'pitch', 'roll'],
        caption: 'Yaw: positive to the person’s own left; pitch: up; roll: towards the left shoulder.',
      }),
      ...make.chart('shift', ['left', 'up', 'forward'], {
        title: 'Shift', yLabel: 'shift (mm)', unit: 'mm', digits: 2, span: 6, styles, labels: ['left', 'up', 'forward'],
        caption: 'Of the model’s origin, inside the head, along that frame’s axes of the head.',
      }),
    ],
  };
}

function distanceSection(make: Maker): Section {
  const mm = { unit: 'mm', digits: 2, span: 6 };
  const most: ('least' | 'most')[] = ['most'];
  const sides = { styles: [left, right], labels: ['left', 'right'] };
  const one = { styles: [{ hue: 2 }] };
  return {
    title: 'Distances on the face',
    caption: 'In space, the head’s own movement taken out. Left and right are the person’s own.',
    charts: [
      ...make.chart('distance', ['mouth opening'], {
        ...mm, ...one, title: 'Mouth opening', yLabel: 'opening (mm)', fromZero: true, labels: ['opening'], extremes: most,
        caption: 'Between the middles of the lips’ inner borders (iBUG points 62 and 66).',
      }),
      ...make.chart('distance', ['mouth width'], {
        ...mm, ...one, title: 'Mouth width', yLabel: 'width (mm)', labels: ['width'],
        extremes: ['least', 'most'], caption: 'Cheilion to cheilion.',
      }),
      ...make.chart('distance', ['mouth corner\'s travel L', 'mouth corner\'s travel R'], {
        ...mm, ...sides, title: 'Mouth corners’ travel', yLabel: 'travel (mm)', fromZero: true, extremes: most,
        caption: 'How far each cheilion is from where it is in the face at rest.',
      }),
      ...make.chart('distance', ['eye opening L', 'eye opening R'], {
        ...mm, ...sides, title: 'Eye opening', yLabel: 'opening (mm)', fromZero: true, extremes: ['least'],
        caption: 'Between the lids, mean of two pairs of points (iBUG 37 to 41, 38 to 40; 43 to 47, 44 to 46).',
      }),
    ],
  };
}

function residualSection(tracking: Tracking, make: Maker): Section {
  const depth = tracking.channels.some((c) => c.name === 'depth seen' && c.most > 0);
  return {
    title: 'How well each frame was met',
    caption: 'Root mean square of what is left between the fitted model and what was seen. Shaded: frames that are not valid.',
    charts: [
      ...make.chart('residual', ['network'], {
        title: 'Landmark network', yLabel: 'residual (px)', unit: 'px', digits: 2, span: 1, fromZero: true,
        styles: [{ hue: 3 }], labels: ['residual'], caption: 'The model’s vertices against the network’s points in the picture.',
      }),
      ...make.chart('residual', ['depth'], {
        title: 'Depth', yLabel: 'residual (mm)', unit: 'mm', digits: 2, span: 1, fromZero: true,
        styles: [{ hue: 3 }], labels: ['residual'], caption: 'The model’s vertices against the measured surface, along its normals.',
      }),
      ...make.chart('residual', depth ? ['skin matched', 'depth seen'] : ['skin matched'], {
        title: 'What was seen', yLabel: 'share (%)', unit: '%', digits: 1, span: 100, range: [0, 102],
        styles: [{ hue: 6, broken: true }, { hue: 5 }], labels: ['skin', 'depth'],
        caption:
          'Skin: pixels that look as in the first frames.' +
          (depth ? ' Depth: vertices facing the camera that have it.' : ''),
      }),
    ],
  };
}

export function headAndDistances(tracking: Tracking): Section[] {
  const make = new Maker(tracking);
  return [headSection(tracking, make), distanceSection(make)];
}

export function residuals(tracking: Tracking): Section {
  return residualSection(tracking, new Maker(tracking));
}
