// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "hyperex/fem/time/newmark.hpp"
#include "hyperex/simulate/drive/boundary.hpp"

namespace hyperex::simulate {

/// A face that follows points as they come in, one sample after the other, by Newmark's method with
/// the numerical damping kStreamGamma (simulator.hpp). It begins at rest.
class Stream {
 public:
  /// `interval_s`: between samples, > 0. Throws NumericalError where the system cannot be factored.
  Stream(fem::System system, const Boundary& boundary, double interval_s,
         std::shared_ptr<const fem::NodeOrder> order);

  /// Other values and springs on the same unknowns; the motion goes on.
  void refill(fem::System system, const Boundary& boundary);
  /// Takes one more sample, the displacements of all the motion's points (P x 3, m). Returns the
  /// displacement of all nodes (|nodes| x 3, m), valid until the next sample.
  Eigen::Map<const Points> step(const Points& point_displacement);

  const std::shared_ptr<const fem::NodeOrder>& order() const { return newmark_.order(); }

 private:
  fem::Newmark newmark_;
  std::optional<Boundary> boundary_;  // always there; following the jaw begins at its last position
  Eigen::VectorXd values_, force_;
};

}  // namespace hyperex::simulate
