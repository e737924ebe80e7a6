// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/fem/form/dilatation_groups.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// The matrices of one mesh for any number of materials: shapes, patterns, and the place of every
/// contribution are computed once. Consistent mass; the viscous tensors have no volumetric part,
/// and so damping is the plain element's whatever the kind. Const members may be called from
/// several threads.
class Assembler {
 public:
  /// Throws InputError where there is no tetrahedron or one has a corner that is no node,
  /// NumericalError naming the first tetrahedron whose volume is not positive.
  Assembler(const Points& nodes, const Tetrahedra& tets, ElementKind kind);
  Assembler(const Points& nodes, const Tetrahedra& tets, const DilatationGroups& groups);

  Eigen::Index node_count() const { return tets_around_.size(); }
  Eigen::Index element_count() const { return static_cast<Eigen::Index>(shapes_.size()); }
  const std::vector<Tet4>& shapes() const { return shapes_; }

  // What another form on this mesh gathers with: form/finite_strain.hpp.
  const Points& nodes() const { return nodes_; }
  const std::vector<std::array<int, 4>>& corners() const { return corners_; }
  const Lists& tets_around() const { return tets_around_; }  ///< node -> tetrahedra, rising
  /// Node -> nodes of a common tetrahedron, and those that the stiffness couples it to.
  const Lists& mass_neighbours() const { return narrow_; }
  const Lists& stiffness_neighbours() const { return groups_.size() ? wide_ : narrow_; }
  /// For each entry of tets_around(): where its four corners stand among the node's neighbours.
  const std::vector<std::array<int, 4>>& mass_slots() const { return narrow_slots_; }
  const std::vector<std::array<int, 4>>& stiffness_slots() const {
    return groups_.size() ? wide_slots_ : narrow_slots_;
  }
  const Lists& groups() const { return groups_; }  ///< of dilatation -> tetrahedra; may be none
  const Lists& groups_of() const { return groups_of_; }  ///< and back
  const Lists& group_nodes() const { return group_nodes_; }
  const std::vector<double>& group_volume() const { return group_volume_; }  ///< m^3
  /// Zeros on the pattern of System::stiffness.
  SparseMatrix stiffness_pattern() const;

  /// Throws InputError naming the first tetrahedron with a value that no material has (E <= 0
  /// ...). A `system` that this assembler filled before keeps its patterns: values are overwritten,
  /// no matrix is allocated. Parallel; the sums' order does not depend on the number of threads.
  void assemble(const Material& material, System& system) const;

  /// Per element at displacement `d` (|nodes| x 3). The stress is the one that does the work: the
  /// sum of V_e stress_e : strain_e(v) is v^T K d. Its pressure is that of the element's groups.
  VoigtRows strain(const Points& d) const;
  VoigtRows stress_pa(const Material& material, const Points& d) const;
  Eigen::VectorXd von_mises_pa(const Material& material, const Points& d) const;
  /// -tr(stress) / 3: positive where compressed.
  Eigen::VectorXd pressure_pa(const Material& material, const Points& d) const;
  /// theta, the mean of the groups of the element: the strain's trace for tet4 alone.
  Eigen::VectorXd dilatation(const Points& d) const;

  /// Of one element: the stress of strain e is first tr(e) I + 2 shear e, its kept volumetric part
  /// included; `averaged` is what the bulk modulus leaves to the groups. Pa.
  struct Moduli {
    double first, shear, averaged;
    double kept() const { return first + 2 * shear / 3; }
  };
  std::vector<Moduli> moduli(const Material& material) const;
  /// kappa_g V_g of each group, N m.
  std::vector<double> group_stiffness(const std::vector<Moduli>& moduli) const;
  /// Adds stiffness_g b_g b_g^T of the groups that node n belongs to, to its three columns;
  /// `gradient`: b_g for each entry of group_nodes().
  void add_groups(int n, const std::vector<double>& stiffness, const std::vector<Vec3>& gradient,
                  SparseMatrix& matrix) const;

 private:
  void take_groups(const DilatationGroups& groups);
  void find_slots();
  SparseMatrix pattern(const Lists& neighbours) const;
  Eigen::Matrix<double, 4, 3> corner_values(const Points& d, Eigen::Index t) const;
  Eigen::VectorXd own_dilatation(const Points& d) const;
  Eigen::VectorXd group_dilatation(const Points& d) const;
  Eigen::VectorXd spread(const Eigen::VectorXd& of_group) const;
  void fill_elements(int n, const Material& material, const std::vector<Moduli>& moduli,
                     System& system) const;

  Points nodes_;
  std::vector<Tet4> shapes_;
  std::vector<std::array<int, 4>> corners_;
  Lists tets_around_;    // node -> tetrahedra
  Lists narrow_, wide_;  // node -> nodes of a common tetrahedron, of a common group
  // For each entry of tets_around_: where its four corners stand among the node's neighbours.
  std::vector<std::array<int, 4>> narrow_slots_, wide_slots_;

  double kept_ = 0;
  Lists groups_, groups_of_;          // group -> tetrahedra and back
  std::vector<double> group_volume_;  // V_g
  Lists group_nodes_;
  std::vector<Vec3> group_gradient_;  // for each entry of group_nodes_: d theta_g / d (its node)
  struct Membership {
    int group, place;        // the node is group_nodes_.item[place]
    std::size_t slots_from;  // of all the group's nodes, in group_slots_
  };
  std::vector<int> member_start_;  // node -> memberships_
  std::vector<Membership> memberships_;
  std::vector<std::uint16_t> group_slots_;
};

}  // namespace hyperex::fem
