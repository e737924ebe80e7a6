// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/label_surfaces.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/ct/iso_surface.hpp"
#include "hyperex/ct/read_series.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

constexpr double kLeastInside = 0.98;

void smooth_along(Volume& volume, int axis) {
  const std::size_t step = axis == 0   ? 1
                           : axis == 1 ? std::size_t(volume.size[0])
                                       : std::size_t(volume.size[0]) * volume.size[1];
  const std::vector<float> before = volume.hu;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const std::array<int, 3> index = {i, j, k};
        const int n = index[std::size_t(axis)];
        const std::size_t v = volume.at(i, j, k);
        const float low = n > 0 ? before[v - step] : before[v],
                    high = n + 1 < volume.size[std::size_t(axis)] ? before[v + step] : before[v];
        volume.hu[v] = (low + 2 * before[v] + high) / 4;
      }
}

TriMesh read_surface(const fs::path& file, SurfaceFrame frame) {
  TriMesh mesh = io::read_mesh(file, io::LengthUnit::millimetre);
  if (frame == SurfaceFrame::patient)
    mesh.points = (mesh.points * face_from_patient().transpose()).eval();
  return mesh;
}

TriMesh surface_of(const Volume& labels, int label, const fs::path& file) {
  TriMesh mesh = label_surface(labels, label);
  if (mesh.triangles.rows() == 0)
    throw InputError(file,
                     fmt::format("the label {} does not occur; expected the labels of skull and "
                                 "mandible, or --skull-label and --mandible-label",
                                 label));
  return mesh;
}

/// Throws where too few of the bone's vertices lie in tissue, as for a bone in the wrong frame. The
/// frames of patient and face are rotated against each other, so that part of such a bone lies in
/// air even if both have one origin within the head.
void check_inside(const TriMesh& bone, const Volume& head, double skin_hu, const fs::path& file) {
  if (bone.triangles.rows() == 0) return;
  Eigen::Index inside = 0;
  for (Eigen::Index v = 0; v < bone.points.rows(); ++v)
    inside += head.sample(bone.points.row(v).transpose()) >= skin_hu ? 1 : 0;
  const double share = double(inside) / double(bone.points.rows());
  if (share < kLeastInside)
    throw InputError(file, fmt::format("{:.0f} % of the bone lies in the head's tissue; expected "
                                       "at least {:.0f} %, in the frame of the patient, or "
                                       "another --bones-frame",
                                       std::floor(100 * share), 100 * kLeastInside));
}

double middle_height_m(const TriMesh& mesh) {
  return (mesh.points.col(1).minCoeff() + mesh.points.col(1).maxCoeff()) / 2;
}

void check_order(const BoneSurfaces& bones, const fs::path& file) {
  if (middle_height_m(bones.mandible) >= middle_height_m(bones.skull))
    throw InputError(file,
                     "the mandible lies above the middle of the skull; expected skull and mandible "
                     "not the other way round, or another --bones-frame");
}

}  // namespace

TriMesh label_surface(const Volume& labels, int label) {
  Volume flags = labels;
  for (float& v : flags.hu) v = std::lround(v) == label ? 1.0F : 0.0F;
  for (int axis = 0; axis < 3; ++axis) smooth_along(flags, axis);
  return iso_surface(flags, 0.5);
}

BoneSurfaces read_own_bones(const OwnBones& own, const Volume& head, double skin_hu) {
  BoneSurfaces out;
  const bool of_labels = !own.labels.empty();
  const fs::path& skull = of_labels ? own.labels : own.skull;
  const fs::path& mandible = of_labels ? own.labels : own.mandible;
  if (of_labels) {
    if (!is_volume_file(own.labels))
      throw InputError(own.labels, "expected labels as .nrrd, .nii or .nii.gz");
    const Volume labels = read_volume_file(own.labels);
    out.skull = surface_of(labels, own.skull_label, own.labels);
    out.mandible = surface_of(labels, own.mandible_label, own.labels);
  } else {
    if (skull.empty() || mandible.empty())
      throw InputError(fmt::format("{} alone: expected {} too",
                                   skull.empty() ? "--mandible" : "--skull",
                                   skull.empty() ? "--skull" : "--mandible"));
    out.skull = read_surface(skull, own.frame);
    out.mandible = read_surface(mandible, own.frame);
  }
  check_inside(out.skull, head, skin_hu, skull);
  check_inside(out.mandible, head, skin_hu, mandible);
  check_order(out, mandible);
  return out;
}

}  // namespace hyperex::ct
