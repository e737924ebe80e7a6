// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace hyperex::estimate {

/// Where each unknown stands in the vector of all: first those that all recordings share, then
/// those of each recording.
struct Unknowns {
  Eigen::Index ratios = 0, gains = 0, muscles = 0, recordings = 0;
  Eigen::Index absolute = 0;  ///< 1 where known loads determine the stiffness itself

  Eigen::Index asked() const { return ratios + gains + absolute; }
  Eigen::Index ratio(Eigen::Index i) const { return i; }  ///< logarithms
  Eigen::Index gain(Eigen::Index i) const { return ratios + i; }
  bool is_gain(Eigen::Index i) const { return ratios <= i && i < ratios + gains; }
  /// Logarithm of Young's modulus of the whole tissue over the scene's.
  Eigen::Index young() const { return ratios + gains; }
  /// Logarithm of the same, relative to the support on the bones.
  Eigen::Index tissue() const { return asked(); }
  /// Displacements of the muscles' lines in one direction (0: outwards, 1: up), m.
  Eigen::Index lines(int way) const { return asked() + 1 + way * muscles; }
  Eigen::Index shared() const { return asked() + 1 + 2 * muscles; }

  Eigen::Index each() const { return muscles + 6 + 6 + 6; }
  Eigen::Index activations(Eigen::Index recording) const { return shared() + recording * each(); }
  Eigen::Index jaw(Eigen::Index recording) const { return activations(recording) + muscles; }
  /// An error of the head's pose: a rotation (rad) about the middle of the points, and a shift (m).
  Eigen::Index head(Eigen::Index recording) const { return jaw(recording) + 6; }
  /// Errors of a known load's direction: its rotation while it acts and its rotation before, rad.
  Eigen::Index load_turn(Eigen::Index recording) const { return head(recording) + 6; }
  Eigen::Index all() const { return shared() + recordings * each(); }

  /// Logarithms of the ratios and of the whole tissue, as FaceResponses takes them.
  Eigen::VectorXd stiffness(const Eigen::VectorXd& x) const {
    Eigen::VectorXd out(ratios + 1);
    out << x.head(ratios), x[tissue()];
    return out;
  }
};

}  // namespace hyperex::estimate
