// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/simulate/drive/drive.hpp"
#include "hyperex/simulate/drive/jaw.hpp"
#include "hyperex/simulate/drive/osteotomy.hpp"
#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// How skin and inner surface follow the motion's points: patches around the driven points,
/// measured nodes, and the interpolated field at the inner surface. It does not depend on the
/// support.
struct DrivenSkin {
  std::vector<int> rows;          ///< points of the motion that drive
  std::vector<int> nodes;         ///< outer nodes whose displacement is prescribed, rising
  Eigen::MatrixXd weights;        ///< |nodes| x P: displacement = weights * that of the points
  Eigen::VectorXd hold;           ///< |nodes|: DrivenPatches::hold; 1 at measured nodes
  Eigen::MatrixXd field_weights;  ///< |inner nodes| x P: the same for the field
};

/// The driven points, then those of the still ones that are not driven; `rows`: of the driven ones
/// in the motion.
struct ChosenPoints {
  std::vector<DrivenPoint> points;
  std::vector<int> rows;
};

/// Throws InputError for points that do not exist.
ChosenPoints chosen_points(const io::Landmarks& landmarks, const AlignedMotion& motion,
                           const DriveOptions& drive);

/// Whether the patches of points on the chin fade (DrivenPatches::hold).
enum class ChinPatches { even, fading };

/// Throws InputError for points that do not exist or lie far off the skin.
DrivenSkin driven_skin(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                       const AlignedMotion& motion, const MeasuredRegion& region,
                       const DriveOptions& drive, ChinPatches chin = ChinPatches::even);

/// Rows of the motion's points that determine the jaw's pose: those that the options name;
/// otherwise those of `driven` over the chin (ibug68_6 to 10); otherwise ibug68_8 or pogonion;
/// otherwise none. Throws InputError for a name that the motion lacks.
std::vector<int> jaw_rows(const AlignedMotion& motion, const std::vector<int>& driven,
                          const SupportOptions& support);

/// The same; throws InputError too where there are none and the mandible is to follow them.
std::vector<int> needed_jaw_rows(const AlignedMotion& motion, const std::vector<int>& driven,
                                 const SupportOptions& support);

/// What is prescribed to the tissue over time. Patches of skin and measured nodes follow the
/// tracked points, held nodes stay, and springs pull towards the bones. Springs over the mandible
/// follow the jaw.
class Boundary {
 public:
  Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
           const AlignedMotion& motion, const MeasuredRegion& region, const DriveOptions& drive,
           const SupportOptions& support);
  /// The same with a driven skin that is known. `mesh` must outlive this.
  Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
           const AlignedMotion& motion, std::shared_ptr<const DrivenSkin> driven,
           const SupportOptions& support);

  /// The boundary of a face that forces drive: no points prescribe anything. Springs that would
  /// follow the points' field hold the rest position. The jaw acts by forces_of_jaw().
  Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
           const SupportOptions& support);

  /// The same springs and held nodes without the driven ones.
  Boundary released() const;

  /// The same with segments of bone moved. Springs, held nodes and the place of the jaw go with
  /// them, and the tissue over neither bone is moved as bones on all sides of it, by the squares of
  /// their inverse distances. Where all bones have the same rigid motion, all support has it.
  Boundary with_moved_bones(const io::Landmarks& landmarks, const Osteotomies& cuts) const;
  /// What moved bones prescribe (m, as prescribed()) and the forces of their springs on all
  /// unknowns (N), where the tissue is at rest otherwise.
  Eigen::VectorXd prescribed_by_bones() const;
  Eigen::VectorXd forces_of_bones() const;

  /// Adds the springs' stiffness. Their blocks lie within the pattern of K.
  void add_springs(fem::SparseMatrix& stiffness) const;
  /// Whether add_springs() adds the same to any matrix.
  bool same_springs(const Boundary& other) const;
  /// Unknowns 3 n + axis, rising.
  const std::vector<int>& prescribed() const { return prescribed_; }
  /// A displacement x -> turn x + slide of the jaw. `turn` is a rotation less the identity.
  struct JawMotion {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
    Vec3 slide = Vec3::Zero();
  };
  /// The jaw's displacement that follows those of all the motion's points (P x 3, m). It starts
  /// from the last answer.
  JawMotion follow(const Points& point_displacement);
  /// Forces (N, all unknowns) of the springs that follow the jaw. They are linear in its motion.
  Eigen::VectorXd forces_of_jaw(const JawMotion& jaw) const;
  /// Forces of unit motions of the jaw (3 |nodes| x 12): one column per entry of its turn (column
  /// by column) and of its slide.
  Eigen::MatrixXd unit_forces_of_jaw() const;
  double jaw_opening_deg() const { return jaw_.opening_deg(); }  ///< of the last answer

  /// Sets the values of the prescribed unknowns (m) and the forces on all unknowns (N). Both are
  /// linear in both arguments.
  void prescribe(const Points& point_displacement, const JawMotion& jaw,
                 Eigen::Ref<Eigen::VectorXd> values, Eigen::Ref<Eigen::VectorXd> force) const;

  /// One flag per point of the motion: whether its displacement has an effect apart from that on
  /// the jaw.
  std::vector<char> acting_points() const;
  bool jaw_acts() const;
  const std::vector<int>& driven_nodes() const { return driven_->nodes; }
  std::vector<int> held_nodes() const;
  Eigen::Index node_count() const { return mesh_.volume.nodes.rows(); }
  int skull_count() const { return skull_count_; }
  int mandible_count() const { return mandible_count_; }
  /// Points of the motion that drive.
  const std::vector<int>& driven_rows() const { return driven_->rows; }

 private:
  enum class Holder : char { skull, mandible, upper_teeth, lower_teeth, throat, between };
  struct Spring {
    int node;
    Eigen::Matrix3d stiffness;  // N/m
    Holder holder;
    enum Target { rest, jaw, field } target;
    int row;                 // of the field
    Vec3 at = Vec3::Zero();  // of the jaw: the place on it that the spring follows
    double share = 1;        // of that place's displacement
    /// Displacement of the spring's fixed end, caused by bones that surgery moved (m).
    Vec3 base = Vec3::Zero();
  };
  struct Fixed {
    int node;
    Bone bone;  // none: held at the scan's border, with the skull
    Vec3 base = Vec3::Zero();
  };
  void hold_border(const io::Landmarks& landmarks, const SupportOptions& support);
  void set_bones(const io::Landmarks& landmarks, const SupportOptions& support);
  void number_unknowns();

  const tissue::TissueMesh& mesh_;
  const Points rest_;  // of the motion's points
  Jaw jaw_;
  std::shared_ptr<const DrivenSkin> driven_;
  std::vector<int> jaw_rows_;
  std::vector<Fixed> fixed_;
  std::vector<Spring> springs_;
  std::vector<int> prescribed_;
  /// Per prescribed node: kind (0 fixed, 1 driven), and its place in fixed_ or row of the driven.
  std::vector<std::pair<int, int>> source_;
  int skull_count_ = 0, mandible_count_ = 0;
};

/// Sorted unknowns: `prescribed` and the three of each of the nodes.
std::vector<int> with_nodes(const std::vector<int>& prescribed, const std::vector<int>& nodes);

}  // namespace hyperex::simulate
