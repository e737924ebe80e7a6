// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/ct_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/size_text.hpp"
#include "hyperex/ct/iso_surface.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/geometry/thin_mesh.hpp"

namespace hyperex::ct {
namespace {

constexpr double kMuchMetal_cm3 = 0.02, kMuchNoise_hu = 80, kCoarse_m = 1.5e-3;
/// Measured: what the filters take of a large volume. Besides: surfaces, pictures and, where
/// addresses are limited, those that Embree and threads reserve.
constexpr double kBytesOfValue = 46, kBytesBesides = 450e6;

/// The triangles of the component with the most of them, and its vertices.
TriMesh largest_component(const TriMesh& mesh) {
  const std::vector<int> number = triangle_components(mesh.triangles, mesh.points.rows());
  std::vector<int> count;
  for (const int n : number) {
    if (n >= int(count.size())) count.resize(std::size_t(n) + 1, 0);
    ++count[std::size_t(n)];
  }
  if (count.size() < 2) return mesh;
  const int kept = int(std::max_element(count.begin(), count.end()) - count.begin());
  std::vector<int> vertex(std::size_t(mesh.points.rows()), -1), source;
  Triangles triangles(count[std::size_t(kept)], 3);
  Eigen::Index row = 0;
  for (std::size_t f = 0; f < number.size(); ++f) {
    if (number[f] != kept) continue;
    for (int k = 0; k < 3; ++k) {
      int& to = vertex[std::size_t(mesh.triangles(Eigen::Index(f), k))];
      if (to < 0) to = int(source.size()), source.push_back(mesh.triangles(Eigen::Index(f), k));
      triangles(row, k) = to;
    }
    ++row;
  }
  return {mesh.points(source, Eigen::all), triangles};
}

TriMesh thinned_surface(const Volume& volume, double iso_hu, double edge_m, bool one_piece) {
  TriMesh mesh = iso_surface(volume, iso_hu);
  if (one_piece) mesh = largest_component(mesh);
  if (mesh.triangles.rows() == 0) return mesh;
  return thin_mesh(mesh, {.edge_m = edge_m, .tolerance_m = kThinned_m}).mesh;
}

void note_values(CtFace& face) {
  std::size_t dense = 0;
  for (std::size_t v = 0; v < face.body.volume.hu.size(); ++v) {
    if (face.body.mask[v] == 0) continue;
    face.greatest_hu = std::max(face.greatest_hu, double(face.body.volume.hu[v]));
    dense += face.thresholds.is_hu && face.body.volume.hu[v] > kMetal_hu ? 1 : 0;
  }
  face.metal_cm3 = double(dense) * face.series.volume.voxel_m3() * 1e6;
  if (face.metal_cm3 > kMuchMetal_cm3)
    face.warnings.push_back(
        fmt::format("{:.2f} cm^3 are denser than {:g} HU: metal, whose streaks may look like bone.",
                    face.metal_cm3, kMetal_hu));
  if (!face.thresholds.is_hu)
    face.warnings.push_back(
        "The values are no Hounsfield units: skin and bone lie at the given ones, which nothing "
        "checks; look at slices.png. Metal and noise are not judged.");
  if (face.thresholds.is_hu && face.thresholds.noise_hu > kMuchNoise_hu)
    face.warnings.push_back(
        fmt::format("The noise in soft tissue is {:.0f} HU: specks of bone may be noise.",
                    face.thresholds.noise_hu));
  if (face.body.couch)
    face.notes.push_back(
        fmt::format("A couch of {:.0f} cm^3 was removed, with 2.5 mm around it: a head that rests "
                    "on it is flat "
                    "there.",
                    face.body.couch_cm3));
  if (face.body.doubtful_couch)
    face.warnings.push_back(
        "What looks like a couch is more than half of all that is dense: it was kept.");
  if (face.body.too_low_for_couch)
    face.warnings.push_back("The slices reach over less than 60 mm: no couch was looked for.");
  if (face.body.cavities_cm3 > 0.05)
    face.notes.push_back(
        fmt::format("{:.1f} cm^3 of air inside the head were taken for tissue in the "
                    "surface of the skin.",
                    face.body.cavities_cm3));
}

/// Teeth could be surfaces of their own only if enamel were denser than bone in the scan, and if
/// voxels were smaller than the gaps between crowns.
void note_teeth(CtFace& face) {
  const double voxel = face.series.volume.spacing_m().maxCoeff();
  if (voxel > kTeethVoxel_m)
    face.notes.push_back(
        fmt::format("Teeth are part of skull and mandible: voxels of {:.2g} mm are too "
                    "coarse to part them (at most {:.1f} mm).",
                    voxel * 1e3, kTeethVoxel_m * 1e3));
  else
    face.notes.push_back("Teeth are part of skull and mandible: they are not parted from bone.");
  if (voxel > kCoarse_m)
    face.notes.push_back(
        fmt::format("Steps of {:.2g} mm are coarse: bone thinner than that is missing "
                    "or thickened.",
                    voxel * 1e3));
}

/// Skin and bones, side by side.
void take_surfaces(CtFace& face, const CtOptions& options) {
  std::vector<std::function<void()>> all = {[&] {
    face.skin =
        thinned_surface(face.body.volume, face.thresholds.skin_hu, kSkinEdge_m, /*one_piece=*/true);
  }};
  Bones found;
  const auto add_part = [&](int part, TriMesh& to) {
    all.emplace_back([&, part] {
      to = thinned_surface(bone_alone(face.body, found, part, face.thresholds),
                           face.thresholds.bone_hu, kBoneEdge_m, /*one_piece=*/false);
    });
  };
  if (!options.own.given()) {
    found = find_bones(face.body, face.thresholds, options.seeds, face.series.shown);
    face.separated = found.separated;
    face.level_hu = found.level_hu;
    face.seeded = options.seeds.has_value();
    add_part(kSkull, face.bones.skull);
    if (found.separated) add_part(kMandible, face.bones.mandible);
  }
  {
    Progress progress("the surfaces", 0);
    run_together(all);
  }
  if (options.own.given()) {
    face.bones = read_own_bones(options.own, face.body.volume, face.thresholds.skin_hu);
    face.own_bones = true;
    face.separated = face.bones.mandible.triangles.rows() > 0;
  }
  if (!face.separated && !face.own_bones)
    face.warnings.push_back(
        "The mandible was not separated from the skull and is part of its surface: give a point in "
        "each, "
        "--seed-skull and --seed-mandible.");
}

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh out{Points(a.points.rows() + b.points.rows(), 3),
              Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  out.points << a.points, b.points;
  out.triangles << a.triangles, (b.triangles.array() + int(a.points.rows())).matrix();
  return out;
}

/// Filters that find no memory while they work end the program.
void require_memory(const Volume& volume, const std::string& source) {
  const double needed = kBytesOfValue * double(volume.count()) + kBytesBesides,
               available = available_memory_bytes();
  if (needed > available)
    throw std::runtime_error(fmt::format(
        "{}: a volume of {:.0f} million values takes about {} of memory and {} are "
        "available; a part of it, or a coarser one, takes less",
        source, 1e-6 * double(volume.count()), size_text(needed), size_text(available)));
}

}  // namespace

CtFace face_of_series(SeriesVolume series, const CtOptions& options) {
  CtFace face;
  face.series = std::move(series);
  face.notes = face.series.notes;
  const std::string& source = face.series.shown;
  require_memory(face.series.volume, source);
  face.thresholds =
      find_skin_threshold(face.series.volume, source, options.skin_hu, options.bone_hu);
  {
    Progress progress("finding head, couch and air", 0);
    face.body = find_body(face.series.volume, face.thresholds, source);
  }
  find_bone_threshold(face.body.volume, face.thresholds, options.bone_hu);
  note_values(face);
  take_surfaces(face, options);
  note_teeth(face);
  Progress progress("landmarks and thickness", 0);
  face.points =
      find_points(face.body.volume, face.thresholds.skin_hu, face.skin, face.bones.mandible);
  face.bounds = face_bounds(face.bones.skull, face.bones.mandible);
  face.thickness = measure_thickness(face.skin, joined(face.bones.skull, face.bones.mandible),
                                     face.bounds, face.points);
  return face;
}

CtFace face_of_ct(const CtOptions& options) {
  return face_of_series(read_series(options.source, options.series), options);
}

}  // namespace hyperex::ct
