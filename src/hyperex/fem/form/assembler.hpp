// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/fem/form/dilatation_groups.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Assembles the system matrices of one mesh for any number of materials. The shape functions, the
/// sparsity patterns and the position of every contribution are computed once. The mass is
/// consistent. The viscous tensors have no volumetric part, so the damping matrix is that of the
/// plain element for every element kind. Const members may be called from several threads.
class Assembler {
 public:
  /// Throws InputError if there is no tetrahedron or if a corner is not a node. Throws
  /// NumericalError naming the first tetrahedron whose volume is not positive.
  Assembler(const Points& nodes, const Tetrahedra& tets, ElementKind kind);
  Assembler(const Points& nodes, const Tetrahedra& tets, const DilatationGroups& groups);

  /// The same mesh of tissue that has grown: at rest, each tetrahedron is stretched by a growth
  /// tensor G (symmetric, positive definite). Its deformation gradient from rest is F G^-1, its
  /// volume V det G (E. K. Rodriguez, A. Hoger, A. D. McCulloch, J. Biomech. 27 (1994) 455). Of
  /// finite strain (form/finite_strain.hpp); growth_force() is the same at small strain. Throws
  /// InputError unless there is one such tensor per tetrahedron.
  Assembler grown(const std::vector<Eigen::Matrix3d>& growth) const;

  Eigen::Index node_count() const { return tets_around_.size(); }
  Eigen::Index element_count() const { return static_cast<Eigen::Index>(shapes_.size()); }
  /// Those at rest.
  const std::vector<Tet4>& shapes() const { return shapes_; }
  bool has_grown() const {
    return gradient_of_mesh_.size() > 1 || !gradient_of_mesh_[0].isIdentity(0);
  }
  /// The deformation gradient of the unmoved mesh, G^-1: the identity unless grown().
  const Eigen::Matrix3d& gradient_of_mesh(Eigen::Index t) const {
    return gradient_of_mesh_.size() == 1 ? gradient_of_mesh_[0] : gradient_of_mesh_[std::size_t(t)];
  }

  // Data that other formulations on this mesh use (form/finite_strain.hpp).
  const Points& nodes() const { return nodes_; }
  const std::vector<std::array<int, 4>>& corners() const { return corners_; }
  const Lists& tets_around() const { return tets_around_; }  ///< node -> tetrahedra, increasing
  /// For each node, the nodes that share a tetrahedron with it, and those to which the stiffness
  /// couples it.
  const Lists& mass_neighbours() const { return narrow_; }
  const Lists& stiffness_neighbours() const { return groups_.size() ? wide_ : narrow_; }
  /// For each entry of tets_around(): the positions of its four corners in the node's list of
  /// neighbours.
  const std::vector<std::array<int, 4>>& mass_slots() const { return narrow_slots_; }
  const std::vector<std::array<int, 4>>& stiffness_slots() const {
    return groups_.size() ? wide_slots_ : narrow_slots_;
  }
  /// Dilatation group -> its tetrahedra; may be empty.
  const Lists& groups() const { return groups_; }
  const Lists& groups_of() const { return groups_of_; }  ///< tetrahedron -> its groups
  const Lists& group_nodes() const { return group_nodes_; }
  const std::vector<double>& group_volume() const { return group_volume_; }  ///< m^3
  /// A matrix of zeros with the pattern of System::stiffness.
  SparseMatrix stiffness_pattern() const;

  /// Throws InputError naming the first tetrahedron with an inadmissible material value (E <= 0
  /// ...). If this assembler filled `system` before, its patterns are kept: values are overwritten
  /// and no matrix is allocated. Runs in parallel; the order of summation does not depend on the
  /// number of threads.
  void assemble(const Material& material, System& system) const;

  /// One value per element at displacement `d` (|nodes| x 3). The stress is work-conjugate to the
  /// strain: the sum of V_e stress_e : strain_e(v) equals v^T K d. Its pressure is that of the
  /// element's groups.
  VoigtRows strain(const Points& d) const;
  VoigtRows stress_pa(const Material& material, const Points& d) const;
  Eigen::VectorXd von_mises_pa(const Material& material, const Points& d) const;
  /// -tr(stress) / 3, positive in compression.
  Eigen::VectorXd pressure_pa(const Material& material, const Points& d) const;
  /// theta, the mean dilatation of the element's groups; for tet4, the trace of the strain.
  Eigen::VectorXd dilatation(const Points& d) const;

  /// Forces (N, 3 |nodes|) with which tissue that grows pushes at small strain: K d = force where
  /// the strain G - I of each tetrahedron is free of stress. Throws as grown().
  Eigen::VectorXd growth_force(const Material& material,
                               const std::vector<Eigen::Matrix3d>& growth) const;

  /// Elastic moduli of one element, Pa. The stress of a strain e is first tr(e) I + 2 shear e. This
  /// includes the part of the bulk modulus that the element keeps; the groups get the rest,
  /// `averaged`.
  struct Moduli {
    double first, shear, averaged;
    double kept() const { return first + 2 * shear / 3; }
  };
  std::vector<Moduli> moduli(const Material& material) const;
  /// kappa_g V_g of each group, N m.
  std::vector<double> group_stiffness(const std::vector<Moduli>& moduli) const;
  /// Adds stiffness_g b_g b_g^T of all groups g of node n to the three columns of this node.
  /// `gradient`: b_g for each entry of group_nodes().
  void add_groups(int n, const std::vector<double>& stiffness, const std::vector<Vec3>& gradient,
                  SparseMatrix& matrix) const;

 private:
  void take_groups(const DilatationGroups& groups);
  void measure_groups();
  void find_slots();
  SparseMatrix pattern(const Lists& neighbours) const;
  Eigen::Matrix<double, 4, 3> corner_values(const Points& d, Eigen::Index t) const;
  Eigen::VectorXd own_dilatation(const Points& d) const;
  Eigen::VectorXd group_dilatation(const Points& d) const;
  Eigen::VectorXd mean_in_groups(const Eigen::VectorXd& of_element) const;
  Eigen::VectorXd spread(const Eigen::VectorXd& of_group) const;
  Eigen::VectorXd pressure_of(const Material& material, Eigen::VectorXd own_dilatation,
                              Eigen::VectorXd group_dilatation) const;
  void fill_elements(int n, const Material& material, const std::vector<Moduli>& moduli,
                     System& system) const;

  Points nodes_;
  std::vector<Tet4> shapes_;
  /// One per tetrahedron, or one of all.
  std::vector<Eigen::Matrix3d> gradient_of_mesh_ = {Eigen::Matrix3d::Identity()};
  std::vector<std::array<int, 4>> corners_;
  Lists tets_around_;    // node -> tetrahedra
  Lists narrow_, wide_;  // node -> nodes of a common tetrahedron, of a common group
  // For each entry of tets_around_: the positions of its four corners in the node's list of
  // neighbours.
  std::vector<std::array<int, 4>> narrow_slots_, wide_slots_;

  double kept_ = 0;
  Lists groups_, groups_of_;          // group -> tetrahedra and back
  std::vector<double> group_volume_;  // V_g
  Lists group_nodes_;
  std::vector<Vec3> group_gradient_;  // for each entry of group_nodes_: d theta_g / d (its node)
  struct Membership {
    int group, place;        // this node is group_nodes_.item[place]
    std::size_t slots_from;  // where the slots of all the group's nodes begin in group_slots_
  };
  std::vector<int> member_start_;  // node -> memberships_
  std::vector<Membership> memberships_;
  std::vector<std::uint16_t> group_slots_;
};

}  // namespace hyperex::fem
