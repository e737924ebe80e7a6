// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <mutex>

#include "hyperex/fem/form/finite_strain.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::metrics {

/// What a performance's tissue is made of, as elastic stress needs it: no mass, no viscosity.
fem::Material elastic_material(const simulate::Performance& performance);

/// Per tetrahedron, at one displacement.
struct FiniteState {
  fem::VoigtRows green_lagrange;  ///< engineering shear
  fem::VoigtRows cauchy_pa;       ///< with the pressure of the element's groups
  Eigen::VectorXd von_mises_pa;   ///< of cauchy_pa
  Eigen::VectorXd volume_ratio;   ///< J
  Points stretch;                 ///< principal ones, rising
};

/// Strain and stress of a performance at finite strain: the elastic part alone, without viscosity
/// and Maxwell branches. Stress is NaN in elements that are turned inside out.
class FiniteTissue {
 public:
  /// Of its nodes, tetrahedra, values and model; keeps nothing of it.
  explicit FiniteTissue(const simulate::Performance& performance);
  /// At the displacement `d` (|nodes| x 3, metres). May be called from several threads, which
  /// wait for one another.
  FiniteState at(const Points& d) const;

 private:
  fem::Assembler assembler_;
  mutable fem::FiniteStrain form_;
  mutable std::mutex one_at_a_time_;
};

}  // namespace hyperex::metrics
