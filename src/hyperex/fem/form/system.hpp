// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <vector>

#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major, both triangles stored

/// Moves a sparse matrix, because Eigen 3.4 would copy it. `from` is left empty.
inline SparseMatrix taken(SparseMatrix& from) {
  SparseMatrix out;
  out.swap(from);
  return out;
}

/// K d + C d' + M d'' = f with 3 |nodes| unknowns, unknown 3 n + axis. Damping and mass have the
/// same pattern: the pairs of nodes with a common tetrahedron. The pattern of the stiffness is the
/// same or contains it. The row indices increase in each column. The blocks of two nodes have all
/// nine entries, including zeros.
struct System {
  SparseMatrix stiffness, damping, mass;

  System() = default;
  System(const System&) = default;
  System& operator=(const System&) = default;
  System(System&& from) noexcept { swap(from); }
  System& operator=(System&& from) noexcept {
    swap(from);
    return *this;
  }
  void swap(System& other) noexcept {
    stiffness.swap(other.stiffness);
    damping.swap(other.damping);
    mass.swap(other.mass);
  }
};

/// Uses an Assembler once. Throws as described in form/assembler.hpp.
System assemble(const Points& nodes, const Tetrahedra& tets, const Material& material,
                ElementKind kind = ElementKind::tet4_star);

/// |T| x 6 in Voigt order: strains (engineering shear) or stresses (Pa).
using VoigtRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Element strains on one mesh at many displacements. The gradients are computed once.
class ElementStrain {
 public:
  ElementStrain(const Points& nodes, const Tetrahedra& tets);
  /// At displacement `d` (|nodes| x 3).
  VoigtRows at(const Points& d) const;

 private:
  Eigen::Index nodes_;
  Tetrahedra tets_;
  std::vector<Eigen::Matrix<double, 4, 3>> gradient_;
};

/// Von Mises stress (Pa) of each element for a given strain. It does not depend on the element
/// kind, because the kinds differ in pressure only.
Eigen::VectorXd von_mises_pa(const VoigtRows& strain, const Material& material);

}  // namespace hyperex::fem
