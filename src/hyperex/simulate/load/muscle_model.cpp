// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "hyperex/muscles/fold_pull.hpp"

namespace hyperex::simulate {
namespace {

/// Sum of the nodes' forces, N.
double total(const Eigen::Ref<const Eigen::VectorXd>& force) {
  return Eigen::Map<const Points>(force.data(), force.size() / 3, 3).rowwise().norm().sum();
}

}  // namespace

MuscleModel::MuscleModel(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                         const fem::SparseMatrix& stiffness,
                         const std::vector<muscles::TemplateMuscle>& muscles,
                         const MuscleModelOptions& options,
                         std::shared_ptr<const fem::NodeOrder> order,
                         const std::function<void()>& between)
    : lines_(muscles::muscle_lines(muscles, mesh, landmarks)),
      boundary_(mesh, landmarks, options.support),
      stiffness_(stiffness),
      mesh_(mesh) {
  boundary_.add_springs(stiffness_);
  factor_.emplace(stiffness_, boundary_.prescribed(), "muscles", std::move(order));
  const Eigen::Index unknowns = 3 * mesh.volume.nodes.rows();
  const auto count = static_cast<Eigen::Index>(lines_.size());
  const auto forces = [&](double widening, Eigen::MatrixXd& force) {
    force.resize(unknowns, count);
    tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index m) {
      muscles::TemplateMuscle muscle = muscles[lines_[m].row];
      if (muscle.kind == muscles::MuscleKind::pull)
        muscle.band = widening * (muscle.band > 0 ? muscle.band : options.shape.band);
      force.col(m) = muscles::muscle_force(lines_[m], muscle, mesh, landmarks, options.shape);
    });
  };
  forces(1, force_);
  scale_to_unit(options.unit_m, between, force_, response_);
  const Points fold[2] = {muscles::nasolabial_fold(mesh, landmarks, false),
                          muscles::nasolabial_fold(mesh, landmarks, true)};
  fold_force_.resize(unknowns, count);
  tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index m) {
    const muscles::TemplateMuscle& muscle = muscles[lines_[m].row];
    fold_force_.col(m) =
        muscles::fold_pull(lines_[m], muscle, fold[lines_[m].left], mesh, options.fold);
    const double sum = total(fold_force_.col(m));
    if (sum > 0) fold_force_.col(m) *= muscle.fold_strength * total(force_.col(m)) / sum;
  });
  if (options.widening != 1) {
    forces(options.widening, wide_force_);
    scale_to_unit(options.unit_m, between, wide_force_, wide_response_);
  }
  jaw_force_.resize(unknowns, 12);
  for (int k = 0; k < 12; ++k) {
    Boundary::JawMotion unit;
    (k < 9 ? unit.turn.data()[k] : unit.slide[k - 9]) = 1;
    jaw_force_.col(k) = boundary_.forces_of_jaw(unit);
  }
  jaw_response_ = solve(jaw_force_, between);
}

void MuscleModel::scale_to_unit(double unit_m, const std::function<void()>& between,
                                Eigen::MatrixXd& force, Eigen::MatrixXd& response) {
  response = solve(force, between);
  const Eigen::Index skin = mesh_.volume.surface_nodes();
  for (Eigen::Index m = 0; m < force.cols(); ++m) {
    const double most =
        Eigen::Map<const Points>(response.col(m).data(), skin, 3).rowwise().norm().maxCoeff();
    const double scale = most > 0 ? unit_m / most : 0;
    force.col(m) *= scale;
    response.col(m) *= scale;
  }
}

Eigen::MatrixXd MuscleModel::solve(const Eigen::MatrixXd& force,
                                   const std::function<void()>& between) {
  Eigen::MatrixXd free = force(factor_->free(), Eigen::all);
  factor_->solve(free, between);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(force.rows(), force.cols());
  all(factor_->free(), Eigen::all) = free;
  return all;
}

}  // namespace hyperex::simulate
