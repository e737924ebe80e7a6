// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// The mesh's own floor of figures of symmetry, from a run's mirrored twin: the same mesh driven by
/// the mirror image of the motion, in mirrored tissue. On an even mesh of a symmetric face each
/// side of the twin moves as the other side of the run does; where it does not, mesh and shape of
/// the face are the reason (docs/symmetry.md). Marked with ' below: of the twin. Both motions have
/// the same names and times, head pose out.

/// Differences of places below this are never called decided in a run (m), whatever the floors:
/// driven points end within it of where they are driven.
inline constexpr double kResolution_m = 1e-4;

/// Per sample, with q_k,side = r_k / r_k0 - 1 (stretches_of):  q_k,L - q'_k,R  of the four
/// distances of S(t), then  q_k,R - q'_k,L. Throws std::invalid_argument where the samples differ
/// in number.
std::vector<Stretches> twin_remainders(const motion::Motion& run, const motion::Motion& twin);

/// Per sample, what |xi_L - xi_R| stays under in a symmetric motion:
///   1/2 sum_k (|q_k,L - q'_k,R| + |q_k,R - q'_k,L|) + what kResolution_m makes.
/// For a symmetric motion, whose twin is itself, the first term is sum_k |q_k,L - q_k,R|, which
/// |xi_L - xi_R| cannot exceed; the distances are not summed with their signs, as the errors of
/// two of them may cancel by chance.
std::vector<double> xi_mesh_floor(const motion::Motion& run, const motion::Motion& twin,
                                  const std::vector<Stretches>& remainders);

/// Excursion_L - excursion_R of a pair (mm): with e(t) the distance from rest, the greatest over
/// time of |e_L - e'_R| and |e_R - e'_L|, and kResolution_m.
double excursion_mesh_floor_mm(const motion::Motion& run, const motion::Motion& twin, int left,
                               int right);

/// Floors of the curve and of every pair, and with them what is undecided.
void add_mesh_floor(SymmetryCurve& curve, Excursions& excursions, const motion::Motion& run,
                    const motion::Motion& twin);

/// The part of the pairs alone.
void add_mesh_floor(Excursions& excursions, const motion::Motion& run, const motion::Motion& twin);

/// The floor of what a variant adds to xi_L - xi_R: with p the remainders of the variant less those
/// of the base, the greatest over time of sum |p|: twice the bound for a symmetric motion in
/// symmetric tissue, as there the difference may equal the bound. NaN where either has no twin.
double added_mesh_floor(const SymmetryCurve& variant, const SymmetryCurve& base);

enum class Side { left, right };

/// The change of a side's excursion between two runs with the same recording.
struct ExcursionChange {
  double from_mm = 0, to_mm = 0;
  /// Uncertainty of the change: that of the mesh, from the mirrored twins (one sample), and that of
  /// the recording's jitter (95 %): |(to - from) - (to' - from')| of the twins, and 1.96 sqrt(2)
  /// jitter |to / from - 1|, as a changed face scales the jitter that both runs share; root of the
  /// sum of squares, and kResolution_m. NaN without twins. Neither wrong tissue nor wrong muscles
  /// are in it.
  double band_mm = 0;
  double change_mm() const { return to_mm - from_mm; }
  /// 1 where the change is larger than its band, else 0; NaN where no band is known.
  double decided() const {
    return std::isnan(band_mm) ? band_mm : double(std::abs(change_mm()) > band_mm);
  }
};
/// The change for one pair of points in both runs, to which add_mesh_floor() has added its twin.
ExcursionChange change_of(const PairExcursion& from, const PairExcursion& to, Side side,
                          double jitter_m);

}  // namespace hyperex::metrics
