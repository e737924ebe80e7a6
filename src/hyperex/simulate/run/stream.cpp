// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/stream.hpp"

#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::simulate {
namespace {
constexpr double kBeta = (kStreamGamma + 0.5) * (kStreamGamma + 0.5) / 4;
}

Stream::Stream(fem::System system, const Boundary& boundary, double interval_s,
               std::shared_ptr<const fem::NodeOrder> order)
    : newmark_(std::move(system), boundary.prescribed(), {interval_s, kBeta, kStreamGamma},
               std::move(order)),
      boundary_(boundary),
      values_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(boundary.prescribed().size()))),
      force_(Eigen::VectorXd::Zero(3 * boundary.node_count())) {}

void Stream::refill(fem::System system, const Boundary& boundary) {
  const fem::Kinematics state = newmark_.state();
  newmark_.refill(std::move(system));
  newmark_.set_state(state.d, state.v, state.a);
  boundary_.emplace(boundary);
}

Eigen::Map<const Points> Stream::step(const Points& point_displacement) {
  boundary_->prescribe(point_displacement, boundary_->follow(point_displacement), values_, force_);
  newmark_.step(values_, force_);
  return {newmark_.displacement().data(), boundary_->node_count(), 3};
}

}  // namespace hyperex::simulate
