// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds, couch, air, jaw and landmarks of a head made by code.
#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/ct/ct_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/made_ct.hpp"
#include "support/refusal.hpp"

namespace hyperex::ct {
namespace {
using testing::HasSubstr;

const Vec3 kSize_mm(120, 130, 126);

Volume volume_of(const test::MadeHead& head) {
  return test::volume_of(head, {0, 0, 5}, kSize_mm, {1, 1, 1});
}

CtFace face_of(const Volume& volume, const CtOptions& options = {}) {
  SeriesVolume series;
  series.volume = volume;
  series.shown = "series";
  return face_of_series(std::move(series), options);
}

const Volume& small_volume() {
  static const Volume volume = volume_of(test::small_head());
  return volume;
}

const CtFace& small_face() {
  static const CtFace face = face_of(small_volume());
  return face;
}

/// The greatest distance (mm) of a surface's vertices from a shape.
double farthest_mm(const TriMesh& mesh, const test::Shape& shape, double above_y_mm = -1e3) {
  double out = 0;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    if (const Vec3 p = 1e3 * mesh.points.row(v).transpose(); p.y() > above_y_mm)
      out = std::max(out, std::abs(shape(p)));
  return out;
}

TEST(Head, ThresholdsAreHalfWay) {
  const CtFace& face = small_face();
  EXPECT_NEAR(face.thresholds.skin_hu, -480, 10);
  EXPECT_NEAR(face.thresholds.bone_hu, 500, 60);
  EXPECT_NEAR(face.thresholds.noise_hu, 30, 6);
  CtOptions given;
  given.skin_hu = -300, given.bone_hu = 400;
  const CtFace other = face_of(small_volume(), given);
  EXPECT_EQ(other.thresholds.skin_hu, -300);
  EXPECT_EQ(other.thresholds.bone_hu, 400);
}

TEST(Head, RefusesValuesThatAreNoHounsfieldUnits) {
  Volume mri = small_volume();
  for (float& v : mri.hu) v = (v + 1024) / 3;
  EXPECT_THAT(test::refusal([&] { face_of(mri); }),
              testing::AllOf(HasSubstr("no Hounsfield units"), HasSubstr("--skin-hu and"),
                             HasSubstr("--bone-hu")));
  Volume nothing = volume_of({test::ball({0, 0, 0}, 8), test::ball({0, 0, 0}, 3), 0});
  EXPECT_THAT(test::refusal([&] { face_of(nothing); }), HasSubstr("series: "));
}

TEST(Head, OtherUnitsAreTakenWithBothValues) {
  const test::MadeHead head = test::small_head();
  Volume other = small_volume();
  for (float& v : other.hu) v = 3000 + 2 * v;
  CtOptions options;
  options.skin_hu = 2040;
  EXPECT_THAT(test::refusal([&] { face_of(other, options); }), HasSubstr("--bone-hu"));
  options.bone_hu = 4000;
  const CtFace face = face_of(other, options);
  EXPECT_THAT(face.warnings, testing::Contains(HasSubstr("no Hounsfield units")));
  EXPECT_NEAR(face.thresholds.air_hu, 1000, 30);
  EXPECT_NEAR(face.thresholds.soft_hu, 3080, 30);
  EXPECT_NEAR(face.thresholds.noise_hu, 60, 20);
  EXPECT_EQ(face.metal_cm3, 0);
  EXPECT_LT(farthest_mm(face.skin, head.skin), 1.0);
  EXPECT_TRUE(face.separated);
  options.skin_hu = -5000;
  EXPECT_THAT(test::refusal([&] { face_of(other, options); }),
              HasSubstr("expected values of the volume below the first"));
}

TEST(Head, SurfacesLieOnTheMadeOnes) {
  const test::MadeHead head = test::small_head();
  const CtFace& face = small_face();
  EXPECT_FALSE(face.body.couch);
  EXPECT_LT(farthest_mm(face.skin, head.skin), 1.0);
  EXPECT_TRUE(boundary_loops(face.skin.triangles).empty());
  ASSERT_TRUE(face.separated);
  EXPECT_LT(
      farthest_mm(face.bones.skull, test::joined(test::small_skull(), test::small_joints()), -5),
      1.0);
  EXPECT_LT(farthest_mm(face.bones.mandible, test::small_mandible(), -100), 2.5);
}

TEST(Head, TheJawIsParted) {
  const CtFace& face = small_face();
  ASSERT_TRUE(face.separated);
  const Vec3 low = face.bones.mandible.points.colwise().minCoeff().transpose(),
             high = face.bones.mandible.points.colwise().maxCoeff().transpose();
  EXPECT_NEAR(1e3 * low.y(), -39, 1.5);
  EXPECT_LT(1e3 * high.y(), 1);
  EXPECT_NEAR(1e3 * (high.x() - low.x()), 74, 3);
  // The skull has nothing of the bow.
  EXPECT_GT(1e3 * face.bones.skull.points.col(1).minCoeff(), -30);
}

TEST(Head, SeedsPartTheJawToo) {
  CtOptions options;
  options.seeds = Seeds{{0, 0.045, -0.006}, {0, -0.034, 0.032}};
  const CtFace face = face_of(small_volume(), options);
  EXPECT_TRUE(face.seeded);
  EXPECT_LT(1e3 * face.bones.mandible.points.col(1).maxCoeff(), 1);
  EXPECT_GT(1e3 * face.bones.skull.points.col(1).minCoeff(), -30);
  options.seeds->mandible_m = {0, -0.07, 0.032};
  EXPECT_THAT(test::refusal([&] { face_of(small_volume(), options); }),
              HasSubstr("series: --seed-mandible: no bone within 6 mm of 0.0,-70.0,32.0 mm"));
}

TEST(Head, SeedsThatAreNotOneInEachAreRefused) {
  const Volume& volume = small_volume();
  CtOptions options;
  const Vec3 skull(0, 0.045, -0.006), jaw(0, -0.034, 0.032);
  options.seeds = Seeds{jaw, jaw};
  EXPECT_THAT(test::refusal([&] { face_of(volume, options); }), HasSubstr("within 6 mm"));
  options.seeds = Seeds{jaw, jaw + Vec3(0.004, 0, 0)};
  EXPECT_THAT(test::refusal([&] { face_of(volume, options); }), HasSubstr("within 6 mm"));
  options.seeds = Seeds{jaw, skull};
  EXPECT_THAT(test::refusal([&] { face_of(volume, options); }),
              HasSubstr("the mandible would be larger than the skull"));
}

TEST(Head, WithoutAJawSaysSo) {
  test::MadeHead head = test::small_head();
  head.bone = test::small_skull();
  const CtFace face = face_of(volume_of(head));
  EXPECT_FALSE(face.separated);
  EXPECT_EQ(face.bones.mandible.triangles.rows(), 0);
  EXPECT_THAT(face.warnings, testing::Contains(HasSubstr("--seed-mandible")));
}

TEST(Head, ACouchIsRemoved) {
  test::MadeHead head = test::small_head();
  const test::Shape alone = head.skin;
  // The back of the head, at z = -53, dips 1 mm into it.
  const test::Shape couch = test::box({-90, -90, -70}, {90, 90, -52});
  head.skin = test::joined(alone, couch);
  head.bone = test::joined(head.bone, test::box({-90, -90, -64}, {90, 90, -60}));
  const CtFace face = face_of(test::volume_of(head, {0, 0, -2}, {130, 134, 126}, {1, 1, 1}));
  EXPECT_TRUE(face.body.couch);
  const Vec3 low = face.skin.points.colwise().minCoeff().transpose();
  EXPECT_GT(1e3 * low.z(), -53);
  EXPECT_GT(1e3 * face.bones.skull.points.col(2).minCoeff(), -50);
  // In front of the couch the skin is the same.
  double farthest = 0;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v)
    if (const Vec3 p = 1e3 * face.skin.points.row(v).transpose(); p.z() > -46)
      farthest = std::max(farthest, std::abs(alone(p)));
  EXPECT_LT(farthest, 1.0);
}

/// A stack through a head of an adult's size that lies on a couch; most of its columns are dense in
/// every slice.
TEST(Head, AShortStackKeepsTheHeadAndLosesTheCouch) {
  const test::Shape alone = test::ellipsoid({0, 0, 0}, {75, 150, 95});
  const test::Shape couch = test::box({-110, -300, -114}, {110, 300, -94});
  const test::MadeHead head{test::joined(alone, couch),
                            test::without(test::ellipsoid({0, 0, 0}, {68, 140, 86}),
                                          test::ellipsoid({0, 0, 0}, {62, 134, 80})),
                            0};
  for (const double height_mm : {70.0, 100.0}) {
    const Volume volume = test::volume_of(head, {0, 0, 0}, {230, 250, height_mm}, {2, 2, 2});
    const Body body = find_body(volume, find_skin_threshold(volume, "series"), "series");
    EXPECT_TRUE(body.couch);
    EXPECT_FALSE(body.doubtful_couch);
    // 20 mm by 220 mm, with the 2.5 mm of the head that touch it.
    EXPECT_NEAR(body.couch_cm3, 4.4 * height_mm, 0.15 * 4.4 * height_mm);
    int missing = 0, beside = 0;
    for (int k = 0; k < volume.size[2]; ++k)
      for (int j = 0; j < volume.size[1]; ++j)
        for (int i = 0; i < volume.size[0]; ++i) {
          const Vec3 p = 1e3 * volume.place(i, j, k);
          const bool kept = body.mask[volume.at(i, j, k)] != 0;
          missing += alone(p) < -2 && p.z() > -90 && !kept ? 1 : 0;
          beside += alone(p) > 2 && kept ? 1 : 0;
        }
    EXPECT_EQ(missing, 0);
    EXPECT_EQ(beside, 0);
  }
}

TEST(Head, ACouchThatIsMostOfAllIsKeptWithAWarning) {
  test::MadeHead head = test::small_head();
  for (const double side : {-1.0, 1.0}) {
    const test::Shape sheets =
        test::joined(test::box({-90, -90, side > 0 ? 60.0 : -76}, {90, 90, side > 0 ? 82.0 : -60}),
                     test::box({side > 0 ? 52.0 : -78, -90, -76}, {side > 0 ? 78.0 : -52, 90, 82}));
    head.skin = test::joined(head.skin, sheets);
  }
  const Volume volume = test::volume_of(head, {0, 0, 5}, {180, 170, 126}, {2, 2, 2});
  const Body body = find_body(volume, find_skin_threshold(volume, "series"), "series");
  EXPECT_TRUE(body.doubtful_couch);
  EXPECT_FALSE(body.couch);
}

TEST(Head, AirInsideIsNoSkin) {
  test::MadeHead head = test::small_head();
  const test::Shape closed = head.skin;
  // A sinus, and an airway of 5 mm from it to the outside.
  const test::Shape sinus = test::ball({20, -18, 10}, 6),
                    airway = test::box({17.5, -20.5, 10}, {22.5, -15.5, 70});
  head.skin = test::without(test::without(closed, sinus), airway);
  const CtFace face = face_of(volume_of(head));
  EXPECT_GT(face.body.cavities_cm3, 0.9);
  EXPECT_LT(face.body.cavities_cm3, 2.0);
  // The nose's entrance is open by as much as a ball of 8 mm gets in; nothing lies deeper.
  double deepest = 0;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v)
    deepest = std::min(deepest, closed(1e3 * face.skin.points.row(v).transpose()));
  EXPECT_GT(deepest, -6);
}

TEST(Head, PointsLieWhereTheShapeHasThem) {
  const CtFace& face = small_face();
  const auto& points = face.points.skin;
  ASSERT_TRUE(points.contains("pronasale") && points.contains("pogonion") &&
              points.contains("subnasale"));
  EXPECT_LT((1e3 * points.at("pronasale") - Vec3(1, -8, 56)).norm(), 1.0);
  const Vec3 chin = 1e3 * points.at("pogonion");
  EXPECT_NEAR(chin.x(), 1, 1.5);
  EXPECT_NEAR(chin.z(), 46, 0.7);
  EXPECT_NEAR(chin.y(), -36, 3);
  const Vec3 lip = 1e3 * points.at("subnasale");
  EXPECT_LT(lip.y(), -18);
  EXPECT_GT(lip.y(), -30);
}

TEST(Head, AStackThatEndsBelowTheNoseHasNoNoseTip) {
  const CtFace face =
      face_of(test::volume_of(test::small_head(), {0, -37, 5}, {120, 130, 50}, {1, 1, 1}));
  EXPECT_FALSE(face.points.skin.contains("pronasale"));
  EXPECT_THAT(face.warnings, testing::Contains(HasSubstr("no couch was looked for")));
}

TEST(Head, MetalIsTold) {
  Volume volume = small_volume();
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if ((1e3 * volume.place(i, j, k) - Vec3(0, -34, 32)).norm() < 3)
          volume.hu[volume.at(i, j, k)] = 3000;
  const CtFace face = face_of(volume);
  EXPECT_NEAR(face.metal_cm3, 0.113, 0.02);
  EXPECT_THAT(face.warnings, testing::Contains(HasSubstr("denser than 2500 HU: metal")));
}

}  // namespace
}  // namespace hyperex::ct
