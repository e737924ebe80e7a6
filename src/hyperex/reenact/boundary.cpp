// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/reenact/support.hpp"

namespace hyperex::reenact {
namespace {
enum Kind { fixed = 0, driven = 1 };
}  // namespace

Boundary::Boundary(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                   const AlignedMotion& motion, const MeasuredRegion& region,
                   const DriveOptions& drive, const SupportOptions& support)
    : mesh_(mesh), rest_(motion.rest), jaw_(landmarks) {
  set_driven(motion, landmarks, drive);
  set_measured(region);
  set_jaw_points(motion, support);
  const std::vector<char> moves_with_jaw = near_jaw(mesh, landmarks);
  if (support.border_held)
    for (int v = 0; v < mesh.volume.surface_nodes(); ++v)
      if (mesh.on_border[v] && !moves_with_jaw[v])
        for (int level = 0; level <= mesh.volume.layers; ++level)
          fixed_nodes_.push_back(static_cast<int>(level * mesh.volume.surface_nodes()) + v);
  set_bones(landmarks, support);
  number_unknowns();
}

void Boundary::set_driven(const AlignedMotion& motion, const io::Landmarks& landmarks,
                          const DriveOptions& drive) {
  std::vector<DrivenPoint> points;
  const std::vector<std::string>& names = drive.names_in(motion.motion);
  for (const std::string& name : names) {
    const int row = motion.motion.index_of(name);
    if (row < 0)
      throw InputError(motion.motion.source,
                       fmt::format("has no point {}, which is to be driven", name));
    if (std::count(driven_rows_.begin(), driven_rows_.end(), row)) continue;
    driven_rows_.push_back(row);
    points.push_back({name, motion.rest.row(row).transpose()});
  }
  for (const std::string& name : drive.still_points) {
    const auto it = landmarks.find(name);
    if (it == landmarks.end())
      throw InputError(
          motion.motion.source,
          fmt::format("{}, which is to be held still, is no landmark of the scan", name));
    if (!std::count(names.begin(), names.end(), name)) points.push_back({name, it->second});
  }
  const Vec3 up = tissue::face_frame(landmarks).y;
  const DriveField field(points, still_places(points, landmarks), mesh_, up,
                         lip_parting(motion, driven_rows_, up));
  const DrivenPatches patches =
      driven_patches(field, mesh_, drive.patch_radius_m, motion.motion.source);
  set_field(field);
  driven_nodes_ = patches.nodes;
  driven_weights_ = Eigen::MatrixXd::Zero(patches.nodes.size(), rest_.rows());
  for (std::size_t i = 0; i < driven_rows_.size(); ++i)  // still points move nothing: no column
    driven_weights_.col(driven_rows_[i]) = patches.weights.col(i);
}

void Boundary::set_field(const DriveField& field) {
  const tissue::VolumeMesh& volume = mesh_.volume;
  const Eigen::MatrixXd weights =
      field.weights(volume.nodes.bottomRows(volume.surface_nodes()), mesh_.upper_margin);
  field_weights_ = Eigen::MatrixXd::Zero(weights.rows(), rest_.rows());
  for (std::size_t i = 0; i < driven_rows_.size(); ++i)
    field_weights_.col(driven_rows_[i]) = weights.col(i);
}

void Boundary::set_measured(const MeasuredRegion& region) {
  std::map<int, Eigen::RowVectorXd> rows;
  for (std::size_t j = 0; j < driven_nodes_.size(); ++j)
    rows[driven_nodes_[j]] = driven_weights_.row(j);
  for (std::size_t v = 0; v < region.outer.size(); ++v) {
    if (region.outer_share[v] < 1) continue;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(rest_.rows());
    for (int k = 0; k < 3; ++k) row[region.outer[v].point[k]] += region.outer[v].weight[k];
    rows[static_cast<int>(v)] = row;
  }
  driven_nodes_.clear();
  driven_weights_.resize(rows.size(), rest_.rows());
  for (const auto& [node, row] : rows) {
    driven_weights_.row(driven_nodes_.size()) = row;
    driven_nodes_.push_back(node);
  }
}

void Boundary::set_jaw_points(const AlignedMotion& motion, const SupportOptions& support) {
  for (const std::string& name : support.jaw_points) {
    const int row = motion.motion.index_of(name);
    if (row < 0)
      throw InputError(motion.motion.source,
                       fmt::format("has no point {}, which is to carry the jaw", name));
    jaw_rows_.push_back(row);
  }
  if (!jaw_rows_.empty()) return;
  for (int k = 6; k <= 10; ++k)
    for (int row : driven_rows_)
      if (motion.motion.names[row] == tissue::ibug(k)) jaw_rows_.push_back(row);
  if (!jaw_rows_.empty()) return;
  for (const char* name : {"ibug68_8", "pogonion"})
    if (const int row = motion.motion.index_of(name); row >= 0 && jaw_rows_.empty())
      jaw_rows_.push_back(row);
  if (jaw_rows_.empty() && support.mandible == Mandible::follow)
    throw InputError(
        motion.motion.source,
        "has no point over the chin (ibug68_8 or pogonion) for the jaw to follow; name some in "
        "support.jaw_points, or set support.mandible = \"free\"");
}

void Boundary::set_bones(const io::Landmarks& landmarks, const SupportOptions& support) {
  const std::vector<Bone> bones = bones_under(mesh_, landmarks);
  const Points normals = vertex_normals(mesh_.volume.outer);
  const Eigen::VectorXd areas = node_areas(mesh_.volume.outer);
  for (int v = 0; v < static_cast<int>(bones.size()); ++v) {
    const int node = mesh_.volume.inner_node(v);
    if (support.muscle_pa_per_m > 0 && bones[v] != Bone::mandible)
      springs_.push_back({node, areas[v] * support.muscle_pa_per_m * Eigen::Matrix3d::Identity(),
                          Spring::field, v});
    if (bones[v] == Bone::none) continue;
    const bool skull = bones[v] == Bone::skull;
    if (skull ? support.skull == Hold::free : support.mandible == Mandible::free) continue;
    const bool follows = !skull && support.mandible == Mandible::follow;
    ++(skull ? skull_count_ : mandible_count_);
    if (skull ? support.skull == Hold::held : support.mandible == Mandible::held) {
      fixed_nodes_.push_back(node);
      continue;
    }
    const BoneLayer& layer = skull ? support.skull_layer : support.mandible_layer;
    const Vec3 n = normals.row(v);
    const Eigen::Matrix3d across = n * n.transpose();
    springs_.push_back({node,
                        areas[v] * (layer.across_pa_per_m * across +
                                    layer.along_pa_per_m * (Eigen::Matrix3d::Identity() - across)),
                        follows ? Spring::jaw : Spring::rest, v});
  }
}

void Boundary::number_unknowns() {
  std::map<int, std::pair<int, int>> nodes;
  for (int node : fixed_nodes_) nodes[node] = {fixed, 0};
  for (std::size_t j = 0; j < driven_nodes_.size(); ++j)
    nodes[driven_nodes_[j]] = {driven, static_cast<int>(j)};
  for (const auto& [node, source] : nodes) {
    for (int axis = 0; axis < 3; ++axis) prescribed_.push_back(3 * node + axis);
    source_.push_back(source);
  }
}

std::vector<int> Boundary::held_nodes() const {
  std::vector<int> held = fixed_nodes_;
  for (const Spring& s : springs_)
    if (s.target == Spring::rest) held.push_back(s.node);
  return held;
}

void Boundary::add_springs(fem::SparseMatrix& stiffness) const {
  for (const Spring& s : springs_)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        stiffness.coeffRef(3 * s.node + a, 3 * s.node + b) += s.stiffness(a, b);
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

void Boundary::prescribe(const Points& point_displacement, const JawMotion& jaw,
                         Eigen::Ref<Eigen::VectorXd> values,
                         Eigen::Ref<Eigen::VectorXd> force) const {
  for (std::size_t i = 0; i < source_.size(); ++i) {
    const auto [kind, row] = source_[i];
    if (kind == fixed)
      values.segment<3>(3 * i).setZero();
    else
      values.segment<3>(3 * i).noalias() =
          (driven_weights_.row(row) * point_displacement).transpose();
  }
  force.setZero();
  for (const Spring& s : springs_) {
    if (s.target == Spring::rest) continue;
    const Vec3 x = mesh_.volume.nodes.row(s.node);
    const Vec3 to = s.target == Spring::jaw
                        ? Vec3(jaw.turn * x + jaw.slide)
                        : Vec3((field_weights_.row(s.row) * point_displacement).transpose());
    force.segment<3>(3 * s.node) += s.stiffness * to;
  }
}

std::vector<char> Boundary::acting_points() const {
  const bool field = std::any_of(springs_.begin(), springs_.end(),
                                 [](const Spring& s) { return s.target == Spring::field; });
  std::vector<char> acts(rest_.rows(), 0);
  for (Eigen::Index p = 0; p < rest_.rows(); ++p)
    acts[p] = (driven_weights_.rows() > 0 && !driven_weights_.col(p).isZero(0)) ||
              (field && !field_weights_.col(p).isZero(0));
  return acts;
}

bool Boundary::jaw_acts() const {
  return std::any_of(springs_.begin(), springs_.end(),
                     [](const Spring& s) { return s.target == Spring::jaw; });
}

}  // namespace hyperex::reenact
