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

void check_inside(const TriMesh& bone, const TriMesh& skin, const fs::path& file) {
  if (bone.triangles.rows() == 0) return;
  const Vec3 low = skin.points.colwise().minCoeff().transpose(),
             high = skin.points.colwise().maxCoeff().transpose();
  const Vec3 middle = (bone.points.colwise().minCoeff() + bone.points.colwise().maxCoeff()) / 2;
  if ((middle.array() < low.array()).any() || (middle.array() > high.array()).any())
    throw InputError(file,
                     "the middle of the bone lies outside the skin; expected the frame of the "
                     "patient, or --bones-frame face");
}

}  // namespace

TriMesh label_surface(const Volume& labels, int label) {
  Volume flags = labels;
  for (float& v : flags.hu) v = std::lround(v) == label ? 1.0F : 0.0F;
  for (int axis = 0; axis < 3; ++axis) smooth_along(flags, axis);
  return iso_surface(flags, 0.5);
}

BoneSurfaces read_own_bones(const OwnBones& own, const TriMesh& skin) {
  BoneSurfaces out;
  if (!own.labels.empty()) {
    if (!is_volume_file(own.labels))
      throw InputError(own.labels, "expected labels as .nrrd, .nii or .nii.gz");
    const Volume labels = read_volume_file(own.labels);
    out.skull = surface_of(labels, own.skull_label, own.labels);
    out.mandible = surface_of(labels, own.mandible_label, own.labels);
    check_inside(out.skull, skin, own.labels);
    check_inside(out.mandible, skin, own.labels);
    return out;
  }
  if (!own.skull.empty()) out.skull = read_surface(own.skull, own.frame);
  if (!own.mandible.empty()) out.mandible = read_surface(own.mandible, own.frame);
  check_inside(out.skull, skin, own.skull);
  check_inside(out.mandible, skin, own.mandible);
  return out;
}

}  // namespace hyperex::ct
