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
      muscles::ForceShape shape = options.shape;
      if (muscle.ends_in_fold()) shape.tangential = 1;  // it draws the skin in at the fold alone
      force.col(m) = muscles::muscle_force(lines_[m], muscle, mesh, landmarks, shape);
    });
  };
  forces(1, force_);
  scale_to_unit(options.unit_m, between, force_, response_);
  if (options.widening != 1) {
    forces(options.widening, wide_force_);
    scale_to_unit(options.unit_m, between, wide_force_, wide_response_);
  }
  add_fold(muscles, landmarks, options.fold, between);
  jaw_force_ = boundary_.unit_forces_of_jaw();
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

/// The fold's part is added to a muscle of unit response: its own response depends on the mesh,
/// whose edges are hardly shorter than the fold is wide.
void MuscleModel::add_fold(const std::vector<muscles::TemplateMuscle>& muscles,
                           const io::Landmarks& landmarks, const muscles::FoldShape& shape,
                           const std::function<void()>& between) {
  std::vector<Eigen::Index> with_fold;
  for (std::size_t m = 0; m < lines_.size(); ++m)
    if (muscles[lines_[m].row].ends_in_fold()) with_fold.push_back(Eigen::Index(m));
  if (with_fold.empty()) return;
  const Points fold[2] = {muscles::nasolabial_fold(mesh_, landmarks, false, shape.from_rest),
                          muscles::nasolabial_fold(mesh_, landmarks, true, shape.from_rest)};
  Eigen::MatrixXd pull(force_.rows(), Eigen::Index(with_fold.size()));
  tbb::parallel_for(Eigen::Index(0), pull.cols(), [&](Eigen::Index k) {
    const Eigen::Index m = with_fold[std::size_t(k)];
    const muscles::TemplateMuscle& muscle = muscles[lines_[std::size_t(m)].row];
    pull.col(k) = muscles::fold_pull(lines_[std::size_t(m)], muscle,
                                     fold[lines_[std::size_t(m)].left], mesh_, shape);
    const double sum = total(pull.col(k));
    if (sum > 0) pull.col(k) *= muscle.fold_strength * total(force_.col(m)) / sum;
  });
  const Eigen::MatrixXd response = solve(pull, between);
  for (Eigen::Index k = 0; k < pull.cols(); ++k) {
    const Eigen::Index m = with_fold[std::size_t(k)];
    force_.col(m) += pull.col(k);
    response_.col(m) += response.col(k);
    if (wide_force_.cols() == 0) continue;
    wide_force_.col(m) += pull.col(k);
    wide_response_.col(m) += response.col(k);
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
