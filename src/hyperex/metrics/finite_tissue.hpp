// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <mutex>

#include "hyperex/fem/form/finite_strain.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::metrics {

/// The material of a performance's tissue for computing elastic stress: without mass and viscosity.
fem::Material elastic_material(const simulate::Performance& performance);

/// Takes growth off a strain of displacement: what is left makes stress.
void take_growth_off(const simulate::Performance& performance, fem::VoigtRows& strain);

/// The state at one displacement, one value per tetrahedron.
struct FiniteState {
  fem::VoigtRows green_lagrange;  ///< engineering shear
  fem::VoigtRows cauchy_pa;       ///< with the pressure of the element's groups
  Eigen::VectorXd von_mises_pa;   ///< of cauchy_pa
  Eigen::VectorXd volume_ratio;   ///< J
  Points stretch;                 ///< principal stretches, increasing
};

/// Elastic strain and stress of a performance at finite strain, without viscosity and Maxwell
/// branches. The stress is NaN in inverted elements.
class FiniteTissue {
 public:
  /// Copies the nodes, tetrahedra, material values and model of the performance; keeps no
  /// reference.
  explicit FiniteTissue(const simulate::Performance& performance);
  /// The state at displacement `d` (|nodes| x 3, metres). May be called from several threads; the
  /// calls are executed one at a time.
  FiniteState at(const Points& d) const;

 private:
  fem::Assembler assembler_;
  mutable fem::FiniteStrain form_;
  mutable std::mutex one_at_a_time_;
};

}  // namespace hyperex::metrics
