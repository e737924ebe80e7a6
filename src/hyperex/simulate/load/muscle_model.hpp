// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/muscles/muscle_forces.hpp"
#include "hyperex/simulate/drive/boundary.hpp"

namespace hyperex::simulate {

struct MuscleModelOptions {
  SupportOptions support;
  muscles::ForceShape shape;
  double widening = 1;  ///< width of the band of a strong pull over that of a weak one
  /// Greatest displacement of the skin by a muscle of activation 1, without its pull at the fold.
  double unit_m = 0.010;
  muscles::FoldShape fold = {};  ///< of pulls along the fold from nose to mouth
};

/// The static responses of a face at rest to unit pulls of its muscles and unit motions of its jaw:
/// one factorisation of the stiffness without driven points, and one solution for each.
class MuscleModel {
 public:
  /// `stiffness`: assembled, without springs, which are added here. `between` (may be empty) is
  /// called repeatedly; it may throw, which ends the computation.
  MuscleModel(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
              const fem::SparseMatrix& stiffness,
              const std::vector<muscles::TemplateMuscle>& muscles,
              const MuscleModelOptions& options,
              std::shared_ptr<const fem::NodeOrder> order = nullptr,
              const std::function<void()>& between = {});

  const std::vector<muscles::MuscleLine>& lines() const { return lines_; }
  const Boundary& boundary() const { return boundary_; }
  const fem::SparseMatrix& stiffness() const { return stiffness_; }  ///< with springs
  Eigen::Index outer_nodes() const { return mesh_.volume.surface_nodes(); }
  const std::shared_ptr<const fem::NodeOrder>& order() const { return factor_->order(); }
  /// 3 |nodes| x |lines|, N and m: force and response of each muscle at activation 1.
  const Eigen::MatrixXd& force() const { return force_; }
  const Eigen::MatrixXd& response() const { return response_; }
  /// The same with the wide bands; no columns where widening is 1.
  const Eigen::MatrixXd& wide_force() const { return wide_force_; }
  const Eigen::MatrixXd& wide_response() const { return wide_response_; }
  /// 3 |nodes| x 12: one column per entry of the jaw's turn (column by column) and of its slide
  /// (m).
  const Eigen::MatrixXd& jaw_force() const { return jaw_force_; }
  const Eigen::MatrixXd& jaw_response() const { return jaw_response_; }

 private:
  std::vector<muscles::MuscleLine> lines_;
  Boundary boundary_;
  fem::SparseMatrix stiffness_;
  std::optional<fem::PartitionedFactor> factor_;
  /// Displacements (3 |nodes| x n) under forces.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& force, const std::function<void()>& between);
  void scale_to_unit(double unit_m, const std::function<void()>& between, Eigen::MatrixXd& force,
                     Eigen::MatrixXd& response);
  void add_fold(const std::vector<muscles::TemplateMuscle>& muscles, const io::Landmarks& landmarks,
                const muscles::FoldShape& shape, const std::function<void()>& between);
  const tissue::TissueMesh& mesh_;
  Eigen::MatrixXd force_, response_, wide_force_, wide_response_, jaw_force_, jaw_response_;
};

}  // namespace hyperex::simulate
