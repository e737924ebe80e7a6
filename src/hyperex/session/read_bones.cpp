// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/read_bones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "hyperex/anatomy/align_surfaces.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/simulate/drive/jaw.hpp"

namespace hyperex::session {
namespace {
namespace fs = std::filesystem;

/// The skin about the nose by which a CT is aligned, and by which bones are checked.
constexpr double kFace_m = 0.09, kOffMoving_m = 0.012;
constexpr std::size_t kMostPoints = 4000;
/// A CT's skin this near to the scan (median) is in its frame.
constexpr double kSameFrame_m = 0.5e-3;
constexpr double kDoubtful_m = 1.5e-3, kRefused_m = 6e-3;
constexpr double kUnder_m = 0.03, kOver_m = 0.01;
constexpr double kLeastUnder = 0.15, kSomeOver = 0.01, kMostOver = 0.1;

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& key,
                         const std::string& expected) {
  throw InputError(scene::problem_at(scene, key, expected));
}

struct BoneFiles {
  fs::path skull, mandible;
};

BoneFiles files_of(const scene::Scene& scene) {
  const scene::AnatomyOptions& options = scene.anatomy;
  BoneFiles out{options.skull, options.mandible};
  if (options.ct.empty()) return out;
  if (!fs::is_regular_file(options.ct / "skin.ply"))
    refuse(scene, "anatomy.ct", "a folder that hyperex ct wrote, with skin.ply");
  if (out.skull.empty()) out.skull = options.ct / "skull.ply";
  if (out.mandible.empty() && fs::is_regular_file(options.ct / "mandible.ply"))
    out.mandible = options.ct / "mandible.ply";
  if (!fs::is_regular_file(out.skull))
    refuse(scene, "anatomy.ct", "a folder that hyperex ct wrote, with skull.ply");
  return out;
}

/// Vertices of the scan within kFace_m of the nose, at most kMostPoints of them. `still`: without
/// those near points that expressions move.
std::vector<int> vertices_about_nose(const TriMesh& scan, const io::Landmarks& landmarks,
                                     bool still) {
  const Vec3 nose = landmarks.at(face::ibug(30));
  std::vector<Vec3> moving;
  if (still)
    for (int k = 17; k < 68; ++k)
      if (k < 27 || k > 35) moving.push_back(landmarks.at(face::ibug(k)));
  std::vector<int> out;
  for (int v = 0; v < scan.points.rows(); ++v) {
    const Vec3 p = scan.points.row(v);
    if ((p - nose).norm() > kFace_m) continue;
    if (std::none_of(moving.begin(), moving.end(),
                     [&](const Vec3& m) { return (p - m).norm() < kOffMoving_m; }))
      out.push_back(v);
  }
  const std::size_t stride = out.size() / kMostPoints + 1;
  std::vector<int> some;
  for (std::size_t i = 0; i < out.size(); i += stride) some.push_back(out[i]);
  return some;
}

/// The rigid motion from the CT's landmarks to those of the scan.
Eigen::Isometry3d by_landmarks(const scene::Scene& scene, const io::Landmarks& landmarks) {
  const fs::path file = scene.anatomy.ct / "landmarks.json";
  io::Landmarks of_ct;
  if (fs::is_regular_file(file)) of_ct = io::read_landmarks(file, std::nullopt);
  std::vector<Vec3> from, to;
  for (const auto& [name, at] : of_ct)
    if (const auto own = landmarks.find(name); own != landmarks.end()) {
      from.push_back(at);
      to.push_back(own->second);
    }
  Points a(from.size(), 3), b(to.size(), 3);
  for (std::size_t i = 0; i < from.size(); ++i)
    a.row(Eigen::Index(i)) = from[i], b.row(Eigen::Index(i)) = to[i];
  constexpr double kLeastSpread = 0.05;
  if (from.size() < 3 || spread_off_line(a) < kLeastSpread)
    refuse(scene, "anatomy.ct",
           fmt::format("a folder whose landmarks.json has three or more landmarks of the scan, not "
                       "on one line, as the CT lies in another frame than the scan (it has {})",
                       from.size()));
  return fit_rigid(a, b);
}

Eigen::Isometry3d scan_from_ct(const scene::Scene& scene, const io::Scan& scan,
                               const io::Landmarks& landmarks, std::vector<Note>& notes) {
  const TriMesh skin = io::read_mesh(scene.anatomy.ct / "skin.ply", io::LengthUnit::millimetre);
  const std::vector<int> still = vertices_about_nose(scan.mesh, landmarks, true);
  if (still.size() < 50)
    refuse(scene, "anatomy.ct", "a scan with at least 50 vertices about the nose");
  const Points points = scan.mesh.points(still, Eigen::all);
  std::vector<double> apart;
  for (const ClosestPoint& c : SurfaceTree(skin).query_all(points))
    apart.push_back(std::sqrt(c.squared_distance));
  if (median(apart) < kSameFrame_m) {
    notes.push_back(make_note("anatomy.ct_in_frame",
                              "the CT's skin lies on the scan: both are in one frame",
                              "anatomy.ct"));
    return Eigen::Isometry3d::Identity();
  }
  const Eigen::Isometry3d start = by_landmarks(scene, landmarks).inverse();
  const anatomy::SurfaceAlignment fit = anatomy::align_to_surface(points, skin, start);
  if (fit.median_m > kRefused_m)
    refuse(scene, "anatomy.ct",
           fmt::format("a CT of the same face: its skin is {:.1f} mm (median) from the scan",
                       1e3 * fit.median_m));
  const std::string text = fmt::format(
      "the CT was laid on the scan by nose, forehead, cheeks and chin: its skin is {:.2f} "
      "mm (median; 95 %: {:.2f} mm) from the scan there",
      1e3 * fit.median_m, 1e3 * fit.p95_m);
  notes.push_back(fit.median_m > kDoubtful_m
                      ? make_warning("anatomy.ct_fits_badly", text, "anatomy.ct")
                      : make_note("anatomy.ct_aligned", text, "anatomy.ct"));
  return fit.to_from_points.inverse();
}

TriMesh read_bone(const fs::path& file, io::LengthUnit unit, const Eigen::Isometry3d& moved) {
  if (file.empty()) return {};
  TriMesh mesh = io::read_mesh(file, unit);
  mesh.points =
      ((mesh.points * moved.linear().transpose()).rowwise() + moved.translation().transpose())
          .eval();
  return mesh;
}

/// Bones that lie under little of the face, or over it, are in another frame or unit.
void check_places(const scene::Scene& scene, const io::Scan& scan, const io::Landmarks& landmarks,
                  const anatomy::Bones& bones, std::vector<Note>& notes) {
  const Points normals = vertex_normals(scan.mesh);
  const std::vector<int> face = vertices_about_nose(scan.mesh, landmarks, false);
  std::size_t under = 0, over = 0;
  for (const int v : face) {
    const Vec3 p = scan.mesh.points.row(v), n = normals.row(v);
    under += std::isfinite(bones.along(p, -n, kUnder_m));
    over += std::isfinite(bones.along(p, n, kOver_m));
  }
  const double count = double(std::max<std::size_t>(1, face.size()));
  const std::string key = !scene.anatomy.ct.empty()      ? "anatomy.ct"
                          : !scene.anatomy.skull.empty() ? "anatomy.skull"
                                                         : "anatomy.mandible";
  if (double(under) < kLeastUnder * count || double(over) > kMostOver * count)
    refuse(scene, key,
           fmt::format("bones that lie under the skin of the scan, in its frame (under {:.0f} % of "
                       "the face there is bone within {:g} mm, over {:.0f} % bone lies outside; "
                       "anatomy.unit states the unit)",
                       100 * double(under) / count, 1e3 * kUnder_m, 100 * double(over) / count));
  if (double(over) > kSomeOver * count)
    notes.push_back(make_warning("anatomy.bone_outside",
                                 fmt::format("at {:.0f} % of the face, bone lies outside the skin",
                                             100 * double(over) / count),
                                 key));
}

}  // namespace

std::shared_ptr<const anatomy::Bones> read_bones(const scene::Scene& scene, const io::Scan& scan,
                                                 const io::Landmarks& landmarks,
                                                 std::vector<Note>& notes) {
  if (!scene.anatomy.any()) return nullptr;
  const BoneFiles files = files_of(scene);
  const bool by_ct = !scene.anatomy.ct.empty();
  const io::LengthUnit unit =
      scene.anatomy.unit.value_or(by_ct ? io::LengthUnit::millimetre : scan.unit);
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  if (by_ct && !landmarks.empty()) moved = scan_from_ct(scene, scan, landmarks, notes);
  TriMesh skull = read_bone(files.skull, unit, moved);
  TriMesh mandible = read_bone(files.mandible, unit, moved);
  if (landmarks.empty()) return nullptr;
  std::optional<anatomy::Condyles> condyles;
  if (mandible.triangles.rows() > 0) {
    const simulate::JawHinge hinge(landmarks, nullptr);
    condyles = anatomy::find_condyles(mandible, hinge.frame, hinge.centre);
    notes.push_back(
        condyles
            ? make_note("anatomy.condyles",
                        fmt::format("the jaw turns about the heads of its own mandible, whose "
                                    "centres are {:.0f} mm apart",
                                    1e3 * ((*condyles)[0] - (*condyles)[1]).norm()),
                        "anatomy.mandible")
            : make_warning("anatomy.no_condyles",
                           "the heads of the mandible were not found on its surface: the jaw turns "
                           "about an axis estimated from landmarks",
                           "anatomy.mandible"));
  } else {
    notes.push_back(make_warning(
        "anatomy.no_mandible",
        "no mandible is given: the tissue over the lower jaw is held by no bone, and the jaw turns "
        "about an axis estimated from landmarks",
        "anatomy.mandible"));
  }
  auto bones =
      std::make_shared<const anatomy::Bones>(std::move(skull), std::move(mandible), condyles);
  check_places(scene, scan, landmarks, *bones, notes);
  return bones;
}

}  // namespace hyperex::session
