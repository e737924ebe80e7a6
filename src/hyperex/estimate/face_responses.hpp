// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/estimate/question.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::estimate {

/// Displacements of points by the muscles: one column per muscle at activation 1 (`narrow`, `wide`:
/// the two bands of MuscleOptions::widening).
struct Bands {
  Eigen::MatrixXd narrow, wide;
};

/// The forces of the muscles, which act on few nodes each.
struct BandForces {
  fem::SparseMatrix narrow, wide;  ///< 3 |nodes| x muscles, N
};

/// How points move with what acts on the face.
struct PointColumns {
  Bands muscles;               ///< 3 P x muscles, m
  std::array<Bands, 2> lines;  ///< the same per metre that a muscle's line is moved out and up
  Eigen::MatrixXd jaw;         ///< 3 P x 12, m: for JawKinematics::motion()
  /// Per known load: 3 P x 3, m per m/s^2 or N along each axis.
  std::vector<Eigen::MatrixXd> loads;
};

/// What acts on a face: coefficients of these columns.
struct Acting {
  Eigen::VectorXd narrow, wide;           ///< per muscle
  std::array<Eigen::VectorXd, 2> line_m;  ///< per muscle: how far its line is moved out and up
  Eigen::Matrix<double, 12, 1> jaw;
};

/// The static response of points on the skin to forces, in tissue whose stiffness changes. Forces
/// are those of the muscles in the scene's own tissue and stay the same in any other. For each
/// stiffness there is one factorisation and one solution per coordinate of a point (the adjoint of
/// "displacement of the points"), whatever the number of muscles.
class FaceResponses {
 public:
  /// `places`: P x 3, m, at rest. Mesh and landmarks must outlive this.
  FaceResponses(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                const simulate::SimulationOptions& options, const std::vector<std::string>& points,
                const Points& places, std::vector<StiffnessRatio> ratios,
                const std::vector<KnownLoad>& loads);

  const std::vector<muscles::MuscleLine>& lines() const { return lines_; }
  Eigen::Index unknowns() const { return Eigen::Index(ratios_.size()) + 1; }

  /// Logarithms of the ratios, then of a factor on the whole tissue. Does nothing for those that
  /// are set. Throws NumericalError.
  void set_stiffness(const Eigen::VectorXd& logs);
  const PointColumns& columns() const { return columns_; }
  /// The derivative of the points' displacement by the logarithms, 3 P x unknowns(), m.
  Eigen::MatrixXd by_stiffness(const Acting& acting);
  /// The same under a known load.
  Eigen::MatrixXd by_stiffness(std::size_t load, const Vec3& amount);

 private:
  fem::Material material(const Eigen::VectorXd& logs) const;
  /// The derivative of Young's moduli by one logarithm.
  std::vector<double> young_by(const Eigen::VectorXd& logs, Eigen::Index which) const;
  fem::SparseMatrix stiffness(const fem::Material& material);
  Bands at_points(const BandForces& force) const;
  Eigen::VectorXd force(const Acting& acting) const;
  Eigen::MatrixXd by_stiffness_under(const Eigen::VectorXd& force);

  std::vector<StiffnessRatio> ratios_;
  fem::Assembler assembler_;
  fem::Material own_;  ///< the scene's
  std::vector<muscles::MuscleLine> lines_;
  std::optional<simulate::Boundary> boundary_;
  BandForces muscles_;
  std::array<BandForces, 2> moved_lines_;
  Eigen::MatrixXd jaw_;
  std::vector<Eigen::MatrixXd> loads_;
  simulate::CarrierMatrix carrier_;
  fem::System system_;
  std::optional<fem::PartitionedFactor> factor_;
  Eigen::VectorXd logs_;
  Eigen::MatrixXd adjoint_;  ///< 3 |nodes| x 3 P
  PointColumns columns_;
};

}  // namespace hyperex::estimate
