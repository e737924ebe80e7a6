// SPDX-License-Identifier: GPL-3.0-or-later
// The curves of symmetry, in the words of docs/symmetry.md: S(t) of all faces, the stretch of either side of
// those that are shown, and what each variant adds to the difference of the sides.
import type { Chart, Curve } from '../../charts/chart_options';
import type { Replay } from '../data';
import { faceHue, leftHue, rightHue } from '../../page/face_colour';
import { faceWords, signed } from '../../page/format';
import type { SymmetryCurve } from '../manifest';
import type { Shown } from '../shown';
import { disagreement, plainFigures, whatSCompares } from './symmetry_words';

type Part = Omit<Chart, 'title'>;

/** "10⁻⁶", "2.5 · 10⁻³" */
function power(value: number): string {
  const [digits, exponent] = value.toExponential().split('e');
  const raised = [...exponent.replace('+', '')].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)])).join('');
  return `${digits === '1' ? '' : `${digits} · `}10${raised}`;
}

/** The faces whose curve is known at the same times as the scene's own. */
const facesWithCurve = (replay: Replay): { i: number; curve: SymmetryCurve }[] =>
  replay.faces.flatMap(({ symmetry }, i) =>
    symmetry && symmetry.time_s.length === replay.symmetry?.time_s.length ? [{ i, curve: symmetry }] : []);

/** The contributions to the noise floor. */
function floorWords({ jitter_mm = 0, mesh_noise = [] }: SymmetryCurve): string {
  const jitter = 'which a symmetric motion seen with the jitter of the points stays under in 95 of 100 samples';
  const mesh = 'which is what the mesh makes of a symmetric motion';
  if (mesh_noise.length === 0) return jitter;
  return jitter_mm > 0 ? `the larger of that ${jitter} and that ${mesh}` : mesh;
}

/** The noise floor if the jitter is known, otherwise the lower limit of S. */
function floorOf(curve: SymmetryCurve): { curve: Curve; caption: string } {
  const { noise = [], floor } = curve;
  if (noise.length === curve.time_s.length)
    return {
      curve: {
        label: 'noise floor', column: 'noise floor of S (ln)', dashed: true, under: 'undecided',
        values: noise.map((n) => (n === null || !(n > 0) ? null : Math.log(Math.max(n, floor)))),
      },
      caption:
        `Hatched, undecided: under the noise floor, ${floorWords(curve)}; values there are not told apart.`,
    };
  const least = Math.log(floor);
  return {
    curve: {
      label: 'floor', column: 'floor of S (ln)', dashed: true, under: 'undecided', values: curve.time_s.map(() => least),
    },
    caption: `Hatched, undecided: S stops at the floor, ln ${power(floor)} = ${signed(least.toFixed(2))}; values there are not told apart.`,
  };
}

/** Where jitter is known, S is compared with its noise floor; samples at its lower limit, as at rest, do not count. */
function rangeOf(own: SymmetryCurve, curves: (number | null)[][]): [number, number] | undefined {
  if ((own.noise ?? []).length === 0) return undefined;
  const least = Math.log(own.floor) + 1e-6;
  const all = curves.flat().filter((v) => v !== null && v > least) as number[];
  if (all.length < 2) return undefined;
  const [low, high] = all.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  return [low - 0.2 * (high - low), high + 0.06 * (high - low)];
}

/** Empty where the run has no such curves. */
export function symmetryCurves(replay: Replay, shown: Shown): Part[] {
  const own = replay.symmetry;
  if (!own || own.time_s.length < 2) return [];
  const several = replay.faces.length > 1;
  const floor = floorOf(replay.faces[shown.first].symmetry ?? own);
  const faces = facesWithCurve(replay);
  return [{
    caption: [
      plainFigures(replay, shown), disagreement(replay, shown),
      `S = ln |ξL − ξR|: smaller where both sides stretch more alike, negative where ξL and ξR differ by less than 1. ${whatSCompares} ${floor.caption}`,
    ].filter(Boolean).join(' '),
    unit: '', digits: 2, timeS: own.time_s, yLabel: 'S (natural logarithm)', heightPx: several ? 250 : 200,
    range: rangeOf(own, [floor.curve.values, ...faces.map(({ curve }) => curve.s)]),
    curves: [
      floor.curve,
      ...faces.map(({ i, curve }) => ({
        label: several ? faceWords(replay.faces, i) : 'S',
        column: several ? `${replay.faces[i].name}: S (ln)` : 'S (ln)',
        values: curve.s, hue: faceHue(i), strong: several && shown.visible.includes(i),
      })),
    ],
  }];
}

export function stretchCurves(replay: Replay, shown: Shown): Part[] {
  const own = replay.symmetry;
  if (!own || own.time_s.length < 2) return [];
  const faces = facesWithCurve(replay).filter(({ i }) => shown.visible.includes(i));
  const several = replay.faces.length > 1;
  const one = faces.length < 2;
  return [{
    caption:
      'Relative change of the distances from the mouth corner to eye, lid, nose and lip, summed. ' +
      `The subject’s own right and left${one ? (several ? `, of ${faceWords(replay.faces, shown.first)}` : '') : `; solid: ${faceWords(replay.faces, shown.first)}, dashed: ${faceWords(replay.faces, shown.second)}`}.`,
    unit: '', digits: 4, timeS: own.time_s, yLabel: 'ξ (relative change)', heightPx: 200,
    curves: faces.flatMap(({ i, curve }) => {
      const broken = !one && i !== shown.first;
      const whose = one ? '' : `${faceWords(replay.faces, i)}: `;
      const file = several ? `${replay.faces[i].name}: ` : '';
      return [
        { label: `${whose}ξR`, column: `${file}ξR (1)`, values: curve.xi_right, hue: rightHue(), broken },
        { label: `${whose}ξL`, column: `${file}ξL (1)`, values: curve.xi_left, hue: leftHue(), broken },
      ];
    }),
  }];
}

/** ξL - ξR less that of base: the effect of the variant. Empty where there are no variants. */
export function addedCurves(replay: Replay, shown: Shown): Part[] {
  const own = replay.symmetry;
  const faces = facesWithCurve(replay);
  if (!own || own.time_s.length < 2 || faces.length < 2) return [];
  const apart = ({ xi_left, xi_right }: SymmetryCurve) =>
    xi_left.map((left, f) => (left === null || xi_right[f] === null ? null : left - xi_right[f]!));
  const itself = apart(own);
  return [{
    caption:
      'ξL − ξR of each face less that of base, the line at 0; above it the left side stretches more than there. ' +
      'This is what tissue changes; S(t) of a simulated face also holds what its mesh makes uneven (docs/symmetry.md).',
    unit: '', digits: 4, timeS: own.time_s, yLabel: 'Δ (relative change)', heightPx: 210,
    curves: faces.map(({ i, curve }) => ({
      label: faceWords(replay.faces, i), column: `${replay.faces[i].name}: Delta(xi_L - xi_R) (1)`,
      values: apart(curve).map((d, f) => (d === null || itself[f] === null ? null : d - itself[f]!)),
      hue: faceHue(i), strong: i > 0 && shown.visible.includes(i),
    })),
  }];
}
