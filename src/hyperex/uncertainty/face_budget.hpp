// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How certain the excursions of a run are. The face is run again with whatever may be wrong with
// it: docs/uncertainty.md.
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/held_against.hpp"
#include "hyperex/metrics/error_budget.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/session/face_session.hpp"

namespace hyperex::uncertainty {

/// Relative error (1 sigma) of a change where forces drive. For changed muscles: with seven points,
/// twins whose face is known exactly still have errors of 9 to 16 % (docs/twins.md). For changed
/// tissue or support: the effect of a stiff cheek is found too small by a fifth
/// (docs/uncertainty.md).
inline constexpr double kInversion = 0.15, kInversionOfTissue = 0.2;

/// Whether the face is also run by the other law. Finite strain takes as long as all else.
enum class Laws { own, both };

enum class FigureKind {
  excursion,   ///< of one side
  difference,  ///< left less right
  change       ///< of one side's excursion, from base to a variant
};

/// A figure with its error, mm.
struct BudgetedFigure {
  FigureKind kind = FigureKind::excursion;
  std::string variant;  ///< of a change; else empty
  std::string point;    ///< of the pair, as PairExcursion::name
  char side = 0;        ///< 'R', 'L', or 0 for a difference
  double value_mm = 0;
  metrics::ErrorBudget errors;  ///< without the jitter's part where that is not known
  bool jitter_known = true;     ///< 0 may be known
  /// Of a change, the excursions in base and in the variant; of a difference, those of the right
  /// and of the left side. Else NaN.
  double from_mm = std::numeric_limits<double>::quiet_NaN();
  double to_mm = std::numeric_limits<double>::quiet_NaN();

  /// The value as it is printed: a change or a difference agrees with both printed excursions.
  double shown_mm() const {
    if (std::isnan(from_mm) || std::isnan(to_mm)) return printed_mm(value_mm);
    return kind == FigureKind::change ? printed_change_mm(from_mm, to_mm)
                                      : printed_mm(to_mm) - printed_mm(from_mm);
  }
  /// NaN where the jitter is not known: the interval is wider than what is known makes it.
  double half_width_95_mm() const {
    return jitter_known ? known_half_width_95_mm() : std::numeric_limits<double>::quiet_NaN();
  }
  /// Of the parts that are known.
  double known_half_width_95_mm() const { return errors.half_width_95(); }
  /// Whether the 95 % interval of a difference or a change excludes 0, by more than a run resolves.
  /// Nothing where the known parts exclude it and the jitter is not known.
  std::optional<bool> decided() const {
    const double least_mm = known_half_width_95_mm() + 1e3 * metrics::kResolution_m;
    if (!(std::abs(value_mm) > least_mm)) return false;
    return jitter_known ? std::optional<bool>(true) : std::nullopt;
  }
};

struct FaceBudget {
  std::vector<BudgetedFigure> figures;  ///< base, then the variants in the scene's order
  /// What was assumed to be wrong: "elements of 3.8 mm instead of 3.3".
  std::vector<std::string> assumed;
  /// Faces that could not be simulated, with the reason: their part is missing in the intervals.
  std::vector<std::string> missing;
  std::string corners;        ///< name of the pair of the mouth's corners; empty: not measured
  bool jitter_known = false;  ///< of the recording, as each figure has it
};

/// Runs the face again with one assumption changed at a time, each by one standard deviation. The
/// variance of a part is the mean square of the changes of the figure in its runs; parts are taken
/// as independent. The variance of the mesh is that among five meshes: the face's own, its mirror
/// image (the twin) and three other sizes of the elements. Jitter and the head's pose are those of
/// the recording. Base and variant share them, so a change has them in proportion to its size.
/// `session`: up to date, its certainty known. Runs the face twelve times, eight where
/// displacements drive. Throws simulate::Cancelled after callbacks.cancelled returned true.
FaceBudget face_budget(const session::FaceSession& session,
                       const simulate::RunCallbacks& callbacks = {}, Laws laws = Laws::both);

}  // namespace hyperex::uncertainty
