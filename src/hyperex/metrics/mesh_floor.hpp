// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// Floors of symmetry measures due to the mesh. They are derived from the mirrored twin of a run:
/// the same mesh, driven by the mirror image of the motion, in mirrored tissue. On a uniform mesh
/// of a symmetric face, each side of the twin moves as the other side of the run. Any difference is
/// due to the mesh and the shape of the face (docs/symmetry.md). Below, a prime (') denotes the
/// twin. Both motions have the same names and times, and no head pose.

/// Differences of positions below this value (m) are never classed as decided in a run, whatever
/// the floors are. Driven points reach their prescribed positions to within this distance.
inline constexpr double kResolution_m = 1e-4;

/// Per sample, the differences q_k,L - q'_k,R of the four distances of S(t), then q_k,R - q'_k,L,
/// with q_k,side = r_k / r_k0 - 1 (stretches_of). Throws std::invalid_argument if the numbers of
/// samples differ.
std::vector<Stretches> twin_remainders(const motion::Motion& run, const motion::Motion& twin);

/// Per sample, an upper bound of |xi_L - xi_R| for a symmetric motion:
///   1/2 sum_k (|q_k,L - q'_k,R| + |q_k,R - q'_k,L|) + the effect of kResolution_m.
/// A symmetric motion is its own twin, so that the first term becomes sum_k |q_k,L - q_k,R|, which
/// |xi_L - xi_R| cannot exceed. Absolute values are summed because the errors of two distances may
/// cancel by chance.
std::vector<double> xi_mesh_floor(const motion::Motion& run, const motion::Motion& twin,
                                  const std::vector<Stretches>& remainders);

/// The floor of excursion_L - excursion_R of a pair (mm): the greatest value over time of |e_L -
/// e'_R| and |e_R - e'_L|, with e(t) the distance from rest, plus kResolution_m.
/// `lowpass_hz`: as Excursions has it.
double excursion_mesh_floor_mm(const motion::Motion& run, const motion::Motion& twin, int left,
                               int right, double lowpass_hz = 0);

/// Adds the mesh floors to the curve and to all pairs, and updates which values are undecided.
void add_mesh_floor(SymmetryCurve& curve, Excursions& excursions, const motion::Motion& run,
                    const motion::Motion& twin);

/// The same for the pairs only, and the twin's tracks of the corners of the mouth.
void add_mesh_floor(Excursions& excursions, const motion::Motion& run, const motion::Motion& twin);

/// The floor of the change of xi_L - xi_R between base and variant: the maximum over time of sum
/// |p|, with p the twin remainders of the variant minus those of the base. This is twice the bound
/// for a symmetric motion in symmetric tissue, because the change may reach that bound. NaN if
/// either run has no twin.
double added_mesh_floor(const SymmetryCurve& variant, const SymmetryCurve& base);

enum class Side { left, right };

/// The change of one side's excursion between two runs of the same recording.
struct ExcursionChange {
  double from_mm = 0, to_mm = 0;
  /// Uncertainty of the change (mm). It combines two contributions as the root of the sum of
  /// squares and adds kResolution_m. That of the mesh is |(to - from) - (to' - from')|, from the
  /// mirrored twins (one sample). That of the recording's jitter is |to / from - 1| times one
  /// side's part of the jitter floor (95 %); this form applies because both runs share the jitter,
  /// which a changed face scales. NaN without twins, and where the jitter is not known. Errors of
  /// tissue or muscles are not included.
  double band_mm = 0;
  /// The same without the jitter's part where the jitter is not known; NaN without twins.
  double known_band_mm = 0;
  double change_mm() const { return to_mm - from_mm; }
  /// 0 if the change is not larger than what is known of its band, 1 if it is larger than all of
  /// it; NaN if it is larger than the former and the rest is not known, and without twins.
  double decided() const {
    if (std::abs(change_mm()) <= known_band_mm) return 0;
    return std::isnan(band_mm) ? band_mm : 1;
  }
};
/// The change for one pair of points in two runs. add_mesh_floor() must have been applied to both.
ExcursionChange change_of(const PairExcursion& from, const PairExcursion& to, Side side);

/// A change of one side from `from_mm` to `to_mm`, with its band. `twin_change_mm`: the same change
/// of the twins, to' - from'. `from`, `to`: the pair of points in both runs, for the jitter.
ExcursionChange banded_change(double from_mm, double to_mm, double twin_change_mm,
                              const PairExcursion& from, const PairExcursion& to);

}  // namespace hyperex::metrics
