// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <vector>

#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major, both triangles stored

/// Moves a sparse matrix, which Eigen 3.4 would copy. `from` is left empty; its memory goes to the
/// result.
inline SparseMatrix taken(SparseMatrix& from) {
  SparseMatrix out;
  out.swap(from);
  return out;
}

/// K d + C d' + M d'' = f over 3 |nodes| unknowns, unknown 3 n + axis.
/// Damping and mass share one pattern: nodes of a common tetrahedron. The stiffness has the same or
/// a wider one that contains it. Rows rise in each column; blocks of two nodes have all nine
/// entries, zeros included.
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

/// An Assembler used once (form/assembler.hpp, where its errors stand).
System assemble(const Points& nodes, const Tetrahedra& tets, const Material& material,
                ElementKind kind = ElementKind::tet4_star);

/// |T| x 6 in the order of Voigt: strains (engineering shear) or stresses (Pa).
using VoigtRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Strains of the elements of one mesh at many displacements: gradients are computed once.
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

/// Per element: von Mises stress (Pa) of a strain, which is the same for all element kinds: they
/// differ in the pressure alone.
Eigen::VectorXd von_mises_pa(const VoigtRows& strain, const Material& material);

}  // namespace hyperex::fem
