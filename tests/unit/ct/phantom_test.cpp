// SPDX-License-Identifier: GPL-3.0-or-later
// The CT of a real head phantom, against values read from it by other means (truth.json beside it).
#include <gmock/gmock.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "hyperex/core/files.hpp"
#include "hyperex/ct/ct_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "support/refusal.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kFolder = fs::path(HYPEREX_SHARED_DIR) / "data/ct";

Vec3 face_mm(const nlohmann::json& patient_mm) {
  return face_from_patient() * Vec3(patient_mm[0], patient_mm[1], patient_mm[2]);
}

class Phantom : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kFolder)) GTEST_SKIP() << "needs " << kFolder;
    truth_ = nlohmann::json::parse(read_file(kFolder / "truth.json"))["phantom_head.zip"];
  }
  Vec3 point(const char* name) const { return face_mm(truth_["points_mm"][name]); }
  nlohmann::json truth_;
};

/// Where the measured values cross `iso_hu` between neighbours along each index: other places than
/// those of the surface's diagonals, and all that a surface may have missed.
std::vector<Vec3> crossings(const Volume& volume, double iso_hu) {
  std::vector<Vec3> out;
  for (int k = 0; k + 1 < volume.size[2]; ++k)
    for (int j = 0; j + 1 < volume.size[1]; ++j)
      for (int i = 0; i + 1 < volume.size[0]; ++i) {
        const double here = volume.hu[volume.at(i, j, k)];
        const std::array<double, 3> next = {volume.hu[volume.at(i + 1, j, k)],
                                            volume.hu[volume.at(i, j + 1, k)],
                                            volume.hu[volume.at(i, j, k + 1)]};
        for (int a = 0; a < 3; ++a) {
          if ((here < iso_hu) == (next[std::size_t(a)] < iso_hu)) continue;
          Vec3 at(i, j, k);
          at[a] += (iso_hu - here) / (next[std::size_t(a)] - here);
          out.push_back(volume.place(at.x(), at.y(), at.z()));
        }
      }
  return out;
}

/// Slices half-way between those measured are their means: with them no two places of the cloud are
/// much farther apart than 1 mm.
Volume with_slices_between(const Volume& volume) {
  Volume out = volume;
  out.size[2] = 2 * volume.size[2] - 1;
  out.step_m.col(2) /= 2;
  out.hu.resize(out.count());
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i)
        out.hu[out.at(i, j, k)] =
            (volume.hu[volume.at(i, j, k / 2)] + volume.hu[volume.at(i, j, (k + 1) / 2)]) / 2;
  return out;
}

/// A cloud of places as triangles without area.
TriMesh as_mesh(const std::vector<Vec3>& cloud) {
  TriMesh out{Points(Eigen::Index(cloud.size()), 3), Triangles(Eigen::Index(cloud.size()), 3)};
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    out.points.row(Eigen::Index(p)) = cloud[p].transpose();
    out.triangles.row(Eigen::Index(p)).setConstant(int(p));
  }
  return out;
}

/// Greatest distance (mm) of the vertices in front of the couch from the crossings. Where the
/// mandible was cut from the skull there are none: vertices within 2.5 mm of `other` are left out.
double farthest_from_mm(const TriMesh& mesh, const TriMesh& cloud, const TriMesh* other = nullptr) {
  const SurfaceTree tree(cloud);
  std::optional<SurfaceTree> cut;
  if (other != nullptr) cut.emplace(*other);
  double out = 0;
  Vec3 where = Vec3::Zero();
  int left_out = 0;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const Vec3 p = mesh.points.row(v);
    if (p.z() < 0.115) continue;
    if (cut && cut->query(p, 2.5e-3).triangle >= 0) {
      ++left_out;
      continue;
    }
    const double distance = std::sqrt(tree.query(p).squared_distance);
    if (distance > out) out = distance, where = p;
  }
  std::cout << "  farthest " << 1e3 * out << " mm at " << 1e3 * where.transpose() << " mm, "
            << left_out << " of " << mesh.points.rows() << " left out\n";
  return 1e3 * out;
}

void expect_on_stated_values(const CtFace& face, double skin_hu, double bone_hu) {
  EXPECT_NEAR(face.thresholds.skin_hu, skin_hu, 10);
  EXPECT_NEAR(face.thresholds.bone_hu, bone_hu, 10);
  const Volume dense = with_slices_between(face.series.volume);
  const TriMesh skin = as_mesh(crossings(dense, skin_hu)),
                bone = as_mesh(crossings(dense, bone_hu));
  EXPECT_LT(farthest_from_mm(face.skin, skin), 1.0);
  EXPECT_LT(farthest_from_mm(face.bones.skull, bone, &face.bones.mandible), 1.5);
  EXPECT_LT(farthest_from_mm(face.bones.mandible, bone, &face.bones.skull), 1.5);
}

/// From the crossings of the skin's value, of the face alone, to the surface.
void expect_whole_face(const CtFace& face, double skin_hu) {
  const SurfaceTree tree(face.skin);
  double farthest = 0;
  int count = 0;
  for (const Vec3& p : crossings(face.series.volume, skin_hu)) {
    if (p.z() < 0.23 || p.y() < 0.3) continue;
    farthest = std::max(farthest, std::sqrt(tree.query(p).squared_distance));
    ++count;
  }
  EXPECT_GT(count, 10000);
  EXPECT_LT(1e3 * farthest, 1.0);
}

void expect_no_couch(const CtFace& face, const nlohmann::json& skin_box_mm) {
  EXPECT_TRUE(face.body.couch);
  // Its front is near y = -107 of the patient, which is z of the face.
  for (const TriMesh* mesh : {&face.skin, &face.bones.skull, &face.bones.mandible})
    EXPECT_GT(1e3 * mesh->points.col(2).minCoeff(), 106);
  EXPECT_NEAR(1e3 * face.skin.points.col(0).minCoeff(), double(skin_box_mm["x"][0]), 2);
  EXPECT_NEAR(1e3 * face.skin.points.col(0).maxCoeff(), double(skin_box_mm["x"][1]), 2);
}

void expect_jaw(const CtFace& face) {
  ASSERT_TRUE(face.separated);
  const TriMesh& jaw = face.bones.mandible;
  EXPECT_NEAR(1e3 * jaw.points.col(1).minCoeff(), 330, 2);
  EXPECT_LT(1e3 * jaw.points.col(1).maxCoeff(), 412);
  EXPECT_GT(1e3 * jaw.points.col(1).maxCoeff(), 395);
  EXPECT_GT(1e3 * jaw.points.col(2).minCoeff(), 195);
}

/// A few slices of the same phantom with a tilted gantry show the same skin.
void expect_same_skin_tilted(const CtFace& face) {
  CtOptions options;
  options.source = kFolder / "tilted.zip";
  const CtFace tilted = face_of_ct(options);
  EXPECT_NEAR(tilted.series.tilt_deg, 15, 0.1);
  EXPECT_THAT(tilted.notes, testing::Contains(HasSubstr("tilted by 15.0 degrees")));
  const SurfaceTree tree(face.skin);
  double farthest = 0;
  for (Eigen::Index v = 0; v < tilted.skin.points.rows(); ++v)
    if (tilted.skin.points(v, 2) > 0.2)
      farthest = std::max(
          farthest, std::sqrt(tree.query(tilted.skin.points.row(v).transpose()).squared_distance));
  std::cout << "  tilted: farthest " << 1e3 * farthest << " mm\n";
  EXPECT_LT(1e3 * farthest, 1.0);
}

/// Tolerances as stated with the data, and the width of the midline.
void expect_points_of_bone(const Vec3& pogonion_off_mm, const Vec3& menton_off_mm) {
  std::cout << "  bone pogonion " << pogonion_off_mm.transpose() << ", menton "
            << menton_off_mm.transpose() << " mm from their places\n";
  EXPECT_LT(std::abs(pogonion_off_mm.x()), 3);
  EXPECT_LT(std::abs(pogonion_off_mm.y()), 4);
  EXPECT_LT(std::abs(pogonion_off_mm.z()), 2);
  EXPECT_LT(std::abs(menton_off_mm.x()), 3);
  EXPECT_LT(std::abs(menton_off_mm.y()), 2);
  EXPECT_LT(std::abs(menton_off_mm.z()), 5);
}

TEST_F(Phantom, IsMeasured) {
  CtOptions options;
  options.source = kFolder / "phantom_head.zip";
  const CtFace face = face_of_ct(options);
  const double skin_hu = truth_["iso_HU"]["skin"], bone_hu = truth_["iso_HU"]["bone"];
  expect_on_stated_values(face, skin_hu, bone_hu);
  expect_whole_face(face, skin_hu);
  expect_no_couch(face, truth_["skin_bbox_mm"]);
  expect_jaw(face);
  const auto& points = face.points;
  const double nose = (1e3 * points.skin.at("pronasale") - point("nose_tip")).norm(),
               chin = (1e3 * points.skin.at("pogonion") - point("soft_pogonion")).norm();
  std::cout << "  nose tip " << nose << ", chin " << chin << " mm from their places\n";
  EXPECT_LT(nose, 3);
  EXPECT_LT(chin, 3);
  ASSERT_TRUE(points.bone_pogonion_m && points.bone_menton_m);
  expect_points_of_bone(1e3 * *points.bone_pogonion_m - point("bone_pogonion"),
                        1e3 * *points.bone_menton_m - point("bone_menton"));
  expect_same_skin_tilted(face);
}

/// The slices from one height (mm, of the patient) to another.
Volume between(const Volume& volume, double from_mm, double to_mm) {
  Volume out = volume;
  int first = volume.size[2], last = -1;
  for (int k = 0; k < volume.size[2]; ++k)
    if (const double y = 1e3 * volume.place(0, 0, k).y(); y >= from_mm && y <= to_mm)
      first = std::min(first, k), last = std::max(last, k);
  out.size[2] = last - first + 1;
  out.origin_m = volume.place(0, 0, first);
  const auto at = [&](int k) { return volume.hu.begin() + std::ptrdiff_t(volume.at(0, 0, k)); };
  out.hu.assign(at(first), at(last + 1));
  return out;
}

TEST_F(Phantom, ShortStacksKeepTheHead) {
  const Volume whole = read_series(kFolder / "phantom_head.zip").volume;
  for (const auto& [from_mm, to_mm] :
       {std::pair{380, 470}, {360, 460}, {345, 407}, {420, 482}, {284, 346}}) {
    const Volume volume = between(whole, from_mm, to_mm);
    const Body body = find_body(volume, find_skin_threshold(volume, "phantom"), "phantom");
    double kept = 0;
    for (const auto v : body.mask) kept += v;
    kept *= volume.voxel_m3() * 1e6;
    std::cout << "  " << from_mm << " to " << to_mm << " mm: couch " << body.couch_cm3
              << " cm3, kept " << kept << " cm3\n";
    EXPECT_NEAR(body.couch_cm3 / (to_mm - from_mm), 7.4, 0.8) << from_mm;
    EXPECT_GT(kept / (to_mm - from_mm), 9) << from_mm;
  }
}

TEST_F(Phantom, ASkullSeedInAFragmentPartsTheSameJaw) {
  const Volume volume = read_series(kFolder / "phantom_head.zip").volume;
  Thresholds thresholds = find_skin_threshold(volume, "phantom");
  const Body body = find_body(volume, thresholds, "phantom");
  find_bone_threshold(body.volume, thresholds);
  const Bones by_shape = find_bones(body, thresholds, {}, "phantom"),
              by_seeds = find_bones(body, thresholds,
                                    Seeds{{0.064, 0.410, 0.240}, {0.003, 0.336, 0.296}}, "phantom");
  double skull = 0, other_skull = 0, jaw = 0, other_jaw = 0;
  for (std::size_t v = 0; v < by_shape.label.size(); ++v) {
    skull += by_shape.label[v] == kSkull, other_skull += by_seeds.label[v] == kSkull;
    jaw += by_shape.label[v] == kMandible, other_jaw += by_seeds.label[v] == kMandible;
  }
  EXPECT_NEAR(other_skull / skull, 1, 0.05);
  EXPECT_NEAR(other_jaw / jaw, 1, 0.05);
}

TEST_F(Phantom, HostileSeriesAreNamed) {
  const auto refused = [](const char* name) {
    return test::refusal([&] { read_series(kFolder / name); });
  };
  EXPECT_THAT(refused("gap.zip"),
              HasSubstr("1 slice is missing between z = 361.5 and z = 365.5 mm"));
  EXPECT_THAT(refused("two_series.zip"),
              HasSubstr("2 series in one folder (1: 9 slices of CT; 2: 9"));
}

}  // namespace
}  // namespace hyperex::ct
