#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maxwell branches of living skin, fitted to its relaxation at a held stretch.

  bench/skin_relaxation.py ../shared/data/real/skin_relaxation.csv

The table (time_s, displacement_mm, force_N) is of skin of the upper arm between two pads that are moved apart at 1 mm/s,
held for a minute, and moved back, four times (Lavigne et al., arXiv:2412.07374). Fitted is the first hold, as the first
ramp leads to it; a time longer than the hold cannot be told from it and is not tried. The strip between the pads is taken
as incompressible, 30 mm long (the table does not tell) and free at its sides, its law as Yeoh's with the default c20;
the force before the ramp is the model's zero. Branches are those of docs/mechanics.md, by the same update.
"""
import itertools
import sys

import numpy as np

LENGTH_MM, C20 = 30, 0.47


def force_of(along, across, stretch):
    """From second Piola-Kirchhoff stress; over area at rest."""
    return stretch * along - across / stretch**2


def law_stress(stretch):
    """Deviatoric, over the shear modulus."""
    x = stretch**2 + 2 / stretch - 3
    w1 = (1 + 2 * C20 * x) / 2
    return 2 * w1 * (1 - (x + 3) / 3 / stretch**2), 2 * w1 * (1 - (x + 3) / 3 * stretch)


def branch(stress, dt_s, time_s):
    """Stress of a Maxwell branch of ratio 1."""
    fade = np.exp(-dt_s / time_s)
    q = np.zeros_like(stress)
    for k in range(1, len(q)):
        q[k] = fade * q[k - 1] + (1 - fade) * time_s / dt_s * (stress[k] - stress[k - 1])
    return q


table = np.genfromtxt(sys.argv[1], delimiter=',', names=True)
time, moved, force = table['time_s'], table['displacement_mm'], table['force_N']
start = np.argmax(moved > 0) - 1
held = np.argmax(moved > moved.max() - 0.05)
end = held + np.argmax(moved[held:] < moved.max() - 0.05)
zero = force[:start].mean()
hold_s = time[end - 1] - time[held]
print(f'at rest {zero:.4f} N; ramp from {time[start]:.1f} s, held from {time[held]:.1f} s for {hold_s:.1f} s '
      f'at {moved[held]:.2f} mm')

stretch = 1 + moved[start:end] / LENGTH_MM
dt = (time[end - 1] - time[start]) / (end - 1 - start)
along, across = law_stress(stretch)
hold = slice(held - start, None)
elastic = force_of(along, across, stretch)[hold]
measured = force[held:end] - zero
times = np.geomspace(0.2, hold_s, 80)
faded = {t: force_of(branch(along, dt, t), branch(across, dt, t), stretch)[hold] for t in times}


def fitted(chosen):
    """Stiffness (shear modulus x area, N), ratios, residual in the hold (N)."""
    basis = np.column_stack([elastic] + [faded[t] for t in chosen])
    weights = np.linalg.lstsq(basis, measured, rcond=None)[0]
    return weights[0], weights[1:] / weights[0], basis @ weights - measured


for count in (1, 2):
    sound = [(c, fitted(c)) for c in itertools.combinations(times, count)]
    chosen, (stiffness, ratios, off) = min(
        ((c, f) for c, f in sound if f[0] > 0 and (f[1] > 0).all()), key=lambda it: it[1][2] @ it[1][2])
    print(f'{count} branch(es): stiffness {stiffness:.4f} N, rms {1e3 * np.sqrt(np.mean(off**2)):.1f} mN; ' +
          ', '.join(f'ratio {g:.4f}, relaxation_s {t:.3f}' for g, t in zip(ratios, chosen)))
    for t in (20, 30, 75):
        k = np.argmin(abs(time - t))
        print(f'  at {t} s: {force[k]:.3f} N (mean of 2 s {force[k - 10:k + 11].mean():.3f}), '
              f'fitted {off[k - held] + force[k]:.3f}')
# Breathing, pulse and sensor: what no smooth curve of a minute follows.
slow = np.convolve(measured, np.ones(21) / 21, 'valid')
print(f'apart from its mean of 2 s the force is {1e3 * np.std(measured[10:-10] - slow):.1f} mN (rms)')
