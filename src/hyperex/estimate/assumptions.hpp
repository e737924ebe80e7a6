// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex::estimate {

/// What is assumed about a face and its recordings before any is seen, as standard deviations.
struct Assumptions {
  /// Of what is asked: of the logarithm of a ratio of stiffness about 0, and of a gain about 1.
  double log_ratio = 1.6, gain = 1;
  /// Of the logarithm of Young's modulus over the scene's, where known loads determine it.
  double log_young = 1.6;
  double load_turn_rad = 0.1;  ///< of the direction of a known load, before and after
  /// Of the logarithm of the whole tissue's stiffness, relative to its support on the bones.
  double log_tissue = 0.5;
  /// Of a muscle's place: distance along the skin from where the template has it, m.
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
