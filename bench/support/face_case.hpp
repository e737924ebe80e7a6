// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/simulate/drive/boundary.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::bench {

/// The face that is measured: subject A's mouth opening if the data set lies beside the checkout,
/// else the face and motion that come with the program.
enum class Face { subject_a_if_there, embedded };

/// Zero members mean the value of the scene.
struct MeshSize {
  double element_size_m = 0;
  int layers = 0;
};

/// A scene prepared for the solver as `hyperex run` does it: mesh, boundary, tissue and motion.
class FaceCase {
 public:
  explicit FaceCase(Face face, const MeshSize& size = {});

  std::string name() const { return name_; }
  /// A Simulator of the same face, as a calling program would have it.
  simulate::Simulator simulator() const;
  const tissue::TissueMesh& mesh() const { return *mesh_; }
  const simulate::Boundary& boundary() const { return *boundary_; }
  const std::vector<int>& prescribed() const { return boundary_->prescribed(); }
  double dt_s() const { return dt_s_; }
  int steps() const { return steps_; }
  const simulate::TissueValues& tissue() const { return options_.tissue; }
  double mesh_seconds() const { return mesh_s_; }  ///< time of building the tissue mesh

  /// The scene's tissue with its viscosity multiplied.
  fem::Material material(double viscosity_factor = 1) const;
  /// Assembles, and adds the springs of the bones and the elastic foundation.
  void assemble(const fem::Assembler& assembler, const fem::Material& material,
                fem::System& system) const;
  fem::System system(fem::ElementKind kind, double viscosity_factor = 1) const;

  /// The scene's motion, with as many shapes as `hyperex run` uses for that tolerance of the
  /// solver.
  fem::Drive drive(double solver_tolerance, int steps = 0) const;
  /// The shape of the motion at its peak, times sin(2 pi t / period), sampled like a recording.
  fem::Drive sine(double period_s, double solver_tolerance) const;

 private:
  fem::Drive shapes(const std::function<Points(double)>& points, double tolerance, int steps) const;

  std::string name_;
  io::Landmarks landmarks_;
  simulate::AlignedMotion motion_;
  simulate::SimulationOptions options_;
  std::shared_ptr<const tissue::TissueMesh> mesh_;
  std::unique_ptr<simulate::Boundary> boundary_;
  std::unique_ptr<simulate::PointCurve> points_;
  double dt_s_ = 0, start_s_ = 0, peak_s_ = 0, mesh_s_ = 0;
  int steps_ = 0;
};

/// Greatest distance of any node between two columns of displacements, and the greatest
/// displacement of any node (m).
double greatest_apart(const Eigen::Ref<const Eigen::VectorXd>& a,
                      const Eigen::Ref<const Eigen::VectorXd>& b);
double greatest(const Eigen::Ref<const Eigen::MatrixXd>& d);

}  // namespace hyperex::bench
