// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex::estimate {

/// Assumptions about a face and its recordings before any is seen. All are prior standard
/// deviations (1 sigma) but misfit_share and misfit_length_m.
struct Assumptions {
  /// Prior 1 sigma: of ln(stiffness ratio), mean 0; of a gain, mean 1.
  double log_ratio = 1.6, gain = 1;
  /// The same of ln(Young's modulus over the scene's), mean 0, where known loads determine it.
  double log_young = 1.6;
  /// Error of a known load's direction, while it acts and before: rotation about each axis.
  double load_turn_rad = 0.1;
  /// The same of ln(the whole tissue's stiffness relative to its support on the bones), mean 0.
  double log_tissue = 0.5;
  /// Position of a muscle: distance along the skin from where the template has it, m.
  double line_m = 0.002;
  /// A person tries the same on both sides: relative standard deviation of the difference from the
  /// mean of both, common to all muscles of a recording, and of each muscle.
  double side = 0.05, muscle = 0.05;
  double least_difference = 0.005;  ///< of an activation, whatever its size
  /// Errors of the model at a point: misfit_m + misfit_share x the length of its displacement, with
  /// a correlation length of misfit_length_m. They are enlarged where the recordings show more.
  double misfit_m = 0.00015, misfit_share = 0.04, misfit_length_m = 0.015;
};

}  // namespace hyperex::estimate
