// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/simulate/drive/support.hpp"

namespace hyperex::simulate {
namespace {
enum Kind { fixed = 0, driven = 1 };

/// Columns of the points that drive among those of all P points; still points have none.
Eigen::MatrixXd spread(const Eigen::MatrixXd& of_driven, const std::vector<int>& rows,
                       Eigen::Index points) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(of_driven.rows(), points);
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.col(rows[i]) = of_driven.col(static_cast<Eigen::Index>(i));
  return all;
}

/// Where a node is measured, it follows the tracked triangle and no patch.
void add_measured(const MeasuredRegion& region, DrivenSkin& driven, Eigen::Index points) {
  std::map<int, std::pair<Eigen::RowVectorXd, double>> rows;  // weights and hold
  for (std::size_t j = 0; j < driven.nodes.size(); ++j)
    rows[driven.nodes[j]] = {driven.weights.row(Eigen::Index(j)), driven.hold[Eigen::Index(j)]};
  for (std::size_t v = 0; v < region.outer.size(); ++v) {
    if (region.outer_share[v] < 1) continue;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(points);
    for (int k = 0; k < 3; ++k) row[region.outer[v].point[k]] += region.outer[v].weight[k];
    rows[static_cast<int>(v)] = {row, 1};
  }
  driven.nodes.clear();
  driven.weights.resize(static_cast<Eigen::Index>(rows.size()), points);
  driven.hold.resize(static_cast<Eigen::Index>(rows.size()));
  for (const auto& [node, row] : rows) {
    const auto j = static_cast<Eigen::Index>(driven.nodes.size());
    driven.weights.row(j) = row.first;
    driven.hold[j] = row.second;
    driven.nodes.push_back(node);
  }
}

}  // namespace

ChosenPoints chosen_points(const io::Landmarks& landmarks, const AlignedMotion& motion,
                           const DriveOptions& drive) {
  ChosenPoints chosen;
  const std::vector<std::string> names = drive.names_in(motion.motion);
  for (const std::string& name : names) {
    const int row = motion.motion.index_of(name);
    if (row < 0)
      throw InputError(motion.motion.source,
                       fmt::format("has no point {}, which is to be driven", name));
    if (std::count(chosen.rows.begin(), chosen.rows.end(), row)) continue;
    chosen.rows.push_back(row);
    chosen.points.push_back({name, motion.rest.row(row).transpose()});
  }
  for (const std::string& name : drive.still_points) {
    const auto it = landmarks.find(name);
    if (it == landmarks.end())
      throw InputError(
          motion.motion.source,
          fmt::format("{}, which is to be held still, is no landmark of the scan", name));
    if (!std::count(names.begin(), names.end(), name)) chosen.points.push_back({name, it->second});
  }
  return chosen;
}

DrivenSkin driven_skin(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                       const AlignedMotion& motion, const MeasuredRegion& region,
                       const DriveOptions& drive, ChinPatches chin) {
  const auto [points, rows] = chosen_points(landmarks, motion, drive);
  DrivenSkin driven;
  driven.rows = rows;
  const Vec3 up = face::face_frame(landmarks).y;
  const DriveField field(points, still_places(points, landmarks), mesh, up,
                         lip_parting(motion, driven.rows, up));
  const DrivenPatches patches = driven_patches(
      field, mesh, drive.patch_radius_m, motion.motion.source,
      chin == ChinPatches::fading ? on_chin(points, landmarks) : std::vector<char>());
  const tissue::VolumeMesh& volume = mesh.volume;
  driven.field_weights =
      spread(field.weights(volume.nodes.bottomRows(volume.surface_nodes()), mesh.upper_margin),
             driven.rows, motion.rest.rows());
  driven.nodes = patches.nodes;
  driven.weights = spread(patches.weights, driven.rows, motion.rest.rows());
  driven.hold = patches.hold;
  add_measured(region, driven, motion.rest.rows());
  return driven;
}

std::vector<int> jaw_rows(const AlignedMotion& motion, const std::vector<int>& driven,
                          const SupportOptions& support) {
  std::vector<int> rows;
  for (const std::string& name : support.jaw_points) {
    const int row = motion.motion.index_of(name);
    if (row < 0)
      throw InputError(motion.motion.source,
                       fmt::format("has no point {}, which is to carry the jaw", name));
    rows.push_back(row);
  }
  if (!rows.empty()) return rows;
  for (int k = 6; k <= 10; ++k)
    for (const int row : driven)
      if (motion.motion.names[std::size_t(row)] == face::ibug(k)) rows.push_back(row);
  if (!rows.empty()) return rows;
  for (const std::string& name : {face::ibug(8), std::string("pogonion")})
    if (const int row = motion.motion.index_of(name); row >= 0 && rows.empty()) rows.push_back(row);
  return rows;
}

std::vector<int> needed_jaw_rows(const AlignedMotion& motion, const std::vector<int>& driven,
                                 const SupportOptions& support) {
  std::vector<int> rows = jaw_rows(motion, driven, support);
  if (rows.empty() && support.mandible == Mandible::follow)
    throw InputError(motion.motion.source,
                     "has no point over the chin (" + face::ibug(8) +
                         " or pogonion) for the jaw to follow; name some in "
                         "support.jaw_points, or set support.mandible = \"free\"");
  return rows;
}

Boundary::Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                   const AlignedMotion& motion, const MeasuredRegion& region,
                   const DriveOptions& drive, const SupportOptions& support)
    : Boundary(
          mesh, landmarks, motion,
          std::make_shared<const DrivenSkin>(driven_skin(mesh, landmarks, motion, region, drive)),
          support) {}

Boundary::Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                   const AlignedMotion& motion, std::shared_ptr<const DrivenSkin> driven,
                   const SupportOptions& support)
    : mesh_(mesh),
      rest_(motion.rest),
      jaw_(landmarks, mesh.bones.get()),
      driven_(std::move(driven)),
      jaw_rows_(needed_jaw_rows(motion, driven_->rows, support)) {
  hold_border(landmarks, support);
  set_bones(landmarks, support);
  number_unknowns();
}

Boundary::Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                   const SupportOptions& support)
    : mesh_(mesh),
      jaw_(landmarks, mesh.bones.get()),
      driven_(std::make_shared<const DrivenSkin>()) {
  hold_border(landmarks, support);
  set_bones(landmarks, support);
  number_unknowns();
}

Boundary Boundary::released() const {
  Boundary out = *this;
  out.driven_ = std::make_shared<const DrivenSkin>();
  out.prescribed_.clear();
  out.source_.clear();
  out.number_unknowns();
  return out;
}

void Boundary::hold_border(const io::Landmarks& landmarks, const SupportOptions& support) {
  if (!support.border_held) return;
  const std::vector<char> moves_with_jaw = near_jaw(mesh_, landmarks);
  const std::vector<char> slides = over_frontalis(mesh_, landmarks);
  for (int v = 0; v < mesh_.volume.surface_nodes(); ++v)
    if (mesh_.on_border[v] && !moves_with_jaw[v] && !slides[v])
      for (int level = 0; level <= mesh_.volume.layers; ++level)
        fixed_.push_back({static_cast<int>(level * mesh_.volume.surface_nodes()) + v, Bone::none});
}

void Boundary::set_bones(const io::Landmarks& landmarks, const SupportOptions& support) {
  const std::vector<Bone> bones = bones_under(mesh_, landmarks);
  const Points normals = vertex_normals(mesh_.volume.outer);
  const Eigen::VectorXd areas = node_areas(mesh_.volume.outer);
  const std::vector<double> to_lips = distances_to_lips(mesh_, landmarks);
  const std::vector<EdgeOfJaw> edge =
      support.throat_pa_per_m > 0 ? edge_of_jaw(mesh_, landmarks) : std::vector<EdgeOfJaw>();
  const bool follows_field = driven_->field_weights.rows() > 0;
  const std::vector<char> backed = backed_by_bone(mesh_, landmarks);
  const auto layered = [&](int v, const BoneLayer& layer) {
    const Vec3 n = normals.row(v);
    const Eigen::Matrix3d across = n * n.transpose();
    return Eigen::Matrix3d(areas[v] *
                           (layer.across_pa_per_m * across +
                            layer.along_pa_per_m * (Eigen::Matrix3d::Identity() - across)));
  };
  for (int v = 0; v < static_cast<int>(bones.size()); ++v) {
    const int node = mesh_.volume.inner_node(v);
    if (support.field_pa_per_m > 0 &&
        (follows_field ? bones[v] != Bone::mandible : bones[v] == Bone::none && backed[v]))
      springs_.push_back({node, areas[v] * support.field_pa_per_m * Eigen::Matrix3d::Identity(),
                          Holder::between, follows_field ? Spring::field : Spring::rest, v});
    if (bones[v] == Bone::none && support.teeth_layer.across_pa_per_m > 0 &&
        to_lips[v] < support.teeth_reach_m) {
      const bool upper = mesh_.upper_margin[v] > 0;
      springs_.push_back(
          {node, layered(v, support.teeth_layer), upper ? Holder::upper_teeth : Holder::lower_teeth,
           upper ? Spring::rest : Spring::jaw, v, mesh_.volume.nodes.row(node).transpose()});
    }
    if (bones[v] == Bone::none && !edge.empty() && edge[v].below)
      springs_.push_back({node, areas[v] * support.throat_pa_per_m * Eigen::Matrix3d::Identity(),
                          Holder::throat, Spring::jaw, v, edge[v].nearest,
                          std::exp(-std::pow(edge[v].distance_m / support.throat_reach_m, 2))});
    if (bones[v] == Bone::none) continue;
    const bool skull = bones[v] == Bone::skull;
    if (skull ? support.skull == Hold::free : support.mandible == Mandible::free) continue;
    const bool follows = !skull && support.mandible == Mandible::follow;
    ++(skull ? skull_count_ : mandible_count_);
    if (skull ? support.skull == Hold::held : support.mandible == Mandible::held) {
      fixed_.push_back({node, bones[v]});
      continue;
    }
    const BoneLayer& layer = skull ? support.skull_layer : support.mandible_layer;
    springs_.push_back({node, layered(v, layer), skull ? Holder::skull : Holder::mandible,
                        follows ? Spring::jaw : Spring::rest, v,
                        mesh_.volume.nodes.row(node).transpose()});
  }
}

void Boundary::number_unknowns() {
  std::map<int, std::pair<int, int>> nodes;
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    nodes[fixed_[i].node] = {fixed, static_cast<int>(i)};
  for (std::size_t j = 0; j < driven_->nodes.size(); ++j)
    nodes[driven_->nodes[j]] = {driven, static_cast<int>(j)};
  for (const auto& [node, source] : nodes) {
    for (int axis = 0; axis < 3; ++axis) prescribed_.push_back(3 * node + axis);
    source_.push_back(source);
  }
}

std::vector<int> Boundary::held_nodes() const {
  std::vector<int> held;
  for (const Fixed& f : fixed_) held.push_back(f.node);
  for (const Spring& s : springs_)
    if (s.target == Spring::rest) held.push_back(s.node);
  return held;
}

Boundary Boundary::with_moved_bones(const io::Landmarks& landmarks, const Osteotomies& cuts) const {
  Boundary out = *this;
  const Points& rest = mesh_.volume.nodes;
  const BonesAbout about(cuts, bones_under(mesh_, landmarks),
                         rest.bottomRows(mesh_.volume.surface_nodes()));
  const auto by = [](const Eigen::Isometry3d& motion, const Vec3& at) -> Vec3 {
    return motion * at - at;
  };
  const auto cranium = [&](const Vec3& at) { return by(cuts.cranium(), at); };
  for (Fixed& f : out.fixed_) {
    const Vec3 at = rest.row(f.node);
    f.base = cranium(at);
    if (f.bone == Bone::skull) f.base = cuts.displacement_of_skull(at);
    if (f.bone == Bone::mandible) f.base = by(cuts.motion(f.bone, at), at);
  }
  for (Spring& s : out.springs_) {
    const Vec3 at = rest.row(s.node);
    Vec3 of_jaw = Vec3::Zero();  // of the place that follows the jaw
    switch (s.holder) {
      case Holder::skull:
        s.base = cuts.displacement_of_skull(at);
        break;
      case Holder::mandible:
        s.base = of_jaw = by(cuts.motion(Bone::mandible, at), at);
        break;
      case Holder::upper_teeth:
        s.base = by(cuts.upper_teeth(), at);
        break;
      case Holder::lower_teeth:
        s.base = of_jaw = by(cuts.lower_teeth(), at);
        break;
      case Holder::throat:
        // The base lies between the edge of the jaw and the neck, which goes with the skull.
        of_jaw = by(cuts.motion(Bone::mandible, s.at), s.at);
        s.base = s.share * by(cuts.motion(Bone::mandible, s.at), at) + (1 - s.share) * cranium(at);
        break;
      case Holder::between:
        s.base = about.displacement(at);
        break;
    }
    s.at += of_jaw;
  }
  return out;
}

Eigen::VectorXd Boundary::prescribed_by_bones() const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(Eigen::Index(prescribed_.size()));
  for (std::size_t i = 0; i < source_.size(); ++i)
    if (source_[i].first == fixed)
      values.segment<3>(3 * Eigen::Index(i)) = fixed_[std::size_t(source_[i].second)].base;
  return values;
}

Eigen::VectorXd Boundary::forces_of_bones() const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh_.volume.nodes.rows());
  for (const Spring& s : springs_) force.segment<3>(3 * s.node) += s.stiffness * s.base;
  return force;
}

void Boundary::add_springs(fem::SparseMatrix& stiffness) const {
  for (const Spring& s : springs_)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        stiffness.coeffRef(3 * s.node + a, 3 * s.node + b) += s.stiffness(a, b);
}

bool Boundary::same_springs(const Boundary& other) const {
  return std::equal(springs_.begin(), springs_.end(), other.springs_.begin(), other.springs_.end(),
                    [](const Spring& a, const Spring& b) {
                      return a.node == b.node && a.stiffness == b.stiffness;
                    });
}

Boundary::JawMotion Boundary::follow(const Points& point_displacement) {
  if (jaw_rows_.empty()) return {};
  Points at(jaw_rows_.size(), 3), by(jaw_rows_.size(), 3);
  for (std::size_t i = 0; i < jaw_rows_.size(); ++i) {
    at.row(i) = rest_.row(jaw_rows_[i]);
    by.row(i) = point_displacement.row(jaw_rows_[i]);
  }
  const Eigen::Isometry3d to = jaw_.follow(at, by);
  return {to.linear() - Eigen::Matrix3d::Identity(), to.translation()};
}

Eigen::VectorXd Boundary::forces_of_jaw(const JawMotion& jaw) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh_.volume.nodes.rows());
  for (const Spring& s : springs_)
    if (s.target == Spring::jaw)
      force.segment<3>(3 * s.node) += s.stiffness * (s.share * (jaw.turn * s.at + jaw.slide));
  return force;
}

Eigen::MatrixXd Boundary::unit_forces_of_jaw() const {
  Eigen::MatrixXd out(3 * mesh_.volume.nodes.rows(), 12);
  for (int k = 0; k < 12; ++k) {
    JawMotion unit;
    (k < 9 ? unit.turn.data()[k] : unit.slide[k - 9]) = 1;
    out.col(k) = forces_of_jaw(unit);
  }
  return out;
}

void Boundary::prescribe(const Points& point_displacement, const JawMotion& jaw,
                         Eigen::Ref<Eigen::VectorXd> values,
                         Eigen::Ref<Eigen::VectorXd> force) const {
  for (std::size_t i = 0; i < source_.size(); ++i) {
    const auto [kind, row] = source_[i];
    if (kind == fixed)
      values.segment<3>(3 * i).setZero();
    else
      values.segment<3>(3 * i).noalias() =
          (driven_->weights.row(row) * point_displacement).transpose();
  }
  force.setZero();
  for (const Spring& s : springs_) {
    if (s.target == Spring::rest) continue;
    const Vec3 to =
        s.target == Spring::jaw
            ? Vec3(s.share * (jaw.turn * s.at + jaw.slide))
            : Vec3((driven_->field_weights.row(s.row) * point_displacement).transpose());
    force.segment<3>(3 * s.node) += s.stiffness * to;
  }
}

std::vector<char> Boundary::acting_points() const {
  const bool field = std::any_of(springs_.begin(), springs_.end(),
                                 [](const Spring& s) { return s.target == Spring::field; });
  std::vector<char> acts(rest_.rows(), 0);
  for (Eigen::Index p = 0; p < rest_.rows(); ++p)
    acts[p] = (driven_->weights.rows() > 0 && !driven_->weights.col(p).isZero(0)) ||
              (field && !driven_->field_weights.col(p).isZero(0));
  return acts;
}

bool Boundary::jaw_acts() const {
  return std::any_of(springs_.begin(), springs_.end(),
                     [](const Spring& s) { return s.target == Spring::jaw; });
}

std::vector<int> with_nodes(const std::vector<int>& prescribed, const std::vector<int>& nodes) {
  std::vector<int> out = prescribed;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) out.push_back(3 * node + axis);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace hyperex::simulate
