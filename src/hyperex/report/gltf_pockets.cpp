// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/gltf_pockets.hpp"

#include <algorithm>
#include <iterator>

#include "hyperex/report/gltf_face.hpp"

namespace hyperex::report {

using Eigen::Index;

namespace {

/// The pockets of all openings for a skin at `points` and a jaw, one after the other.
TriMesh pockets(const std::vector<Opening>& openings, const Points& points,
                const Eigen::Affine3d& jaw = Eigen::Affine3d::Identity()) {
  TriMesh all;
  for (const Opening& opening : openings) {
    const TriMesh one = pocket(opening, points, jaw);
    const Index vertices = all.points.rows(), triangles = all.triangles.rows();
    all.points.conservativeResize(vertices + one.points.rows(), 3);
    all.points.bottomRows(one.points.rows()) = one.points;
    all.triangles.conservativeResize(triangles + one.triangles.rows(), 3);
    all.triangles.bottomRows(one.triangles.rows()) = one.triangles.array() + int(vertices);
  }
  return all;
}

tinygltf::Primitive pocket_primitive(tinygltf::Model& model, GltfArrays& arrays,
                                     const PocketGroup& group) {
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor> srgb(group.at_rest.points.rows(),
                                                                       3);
  Index row = 0;
  for (const Opening& opening : group.openings)
    for (const Srgb& colour : opening.colours) {
      for (int k = 0; k < 3; ++k) srgb(row, k) = colour[std::size_t(k)];
      ++row;
    }
  const PointsF points = group.at_rest.points.cast<float>();
  tinygltf::Primitive cavity;
  cavity.mode = TINYGLTF_MODE_TRIANGLES;
  cavity.attributes["POSITION"] = arrays.vectors(points, true);
  cavity.attributes["NORMAL"] =
      arrays.vectors(vertex_normals(points, group.at_rest.triangles), false);
  cavity.attributes["COLOR_0"] = add_colours(arrays, srgb);
  cavity.indices = arrays.triangles(group.at_rest.triangles);
  cavity.material = static_cast<int>(model.materials.size());
  tinygltf::Material material =
      plain_material(group.lit ? "cavity" : "lid_pocket", {1, 1, 1, 1}, 1);
  material.doubleSided = true;
  if (!group.lit) {
    material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
    model.extensionsUsed.emplace_back("KHR_materials_unlit");
  }
  model.materials.push_back(material);
  return cavity;
}

}  // namespace

std::vector<PocketGroup> pocket_groups(const std::vector<Opening>& openings,
                                       const Points& skin_rest) {
  std::vector<PocketGroup> groups;
  for (const bool eyes : {false, true}) {
    PocketGroup group;
    group.lit = !eyes;
    std::ranges::copy_if(openings, std::back_inserter(group.openings),
                         [&](const Opening& opening) { return opening.eye == eyes; });
    if (group.openings.empty()) continue;
    group.at_rest = pockets(group.openings, skin_rest);
    groups.push_back(std::move(group));
  }
  return groups;
}

void add_pockets(tinygltf::Model& model, GltfArrays& arrays, tinygltf::Mesh& skin,
                 const std::vector<PocketGroup>& groups) {
  for (const PocketGroup& group : groups)
    skin.primitives.push_back(pocket_primitive(model, arrays, group));
}

void add_pocket_targets(tinygltf::Mesh& skin, GltfArrays& arrays,
                        const std::vector<PocketGroup>& groups, const Points& skin_rest,
                        const PoseTargets& targets, const std::vector<Eigen::Affine3d>& jaws) {
  for (std::size_t k = 0; k < targets.positions.size(); ++k) {
    const Points now = skin_rest + targets.positions[k].cast<double>();
    const Eigen::Affine3d jaw = jaws.empty() ? Eigen::Affine3d::Identity() : jaws.at(k);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Points moved = pockets(groups[g].openings, now, jaw).points - groups[g].at_rest.points;
      skin.primitives.at(1 + g).targets.push_back(
          {{"POSITION", arrays.few_vectors(moved.cast<float>(), targets.least_move_m, true)}});
    }
  }
}

}  // namespace hyperex::report
