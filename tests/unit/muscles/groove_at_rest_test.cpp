// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/anatomy/fold_profile.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/fold_pull.hpp"
#include "muscles/a_face.hpp"
#include "support/subdivided.hpp"

namespace hyperex::muscles {
namespace {

/// The skin of `a_face()` with a groove of 3 mm along the rule's line of the left side, shifted
/// outwards.
TriMesh with_groove(double shift_mm) {
  const test::AFace& face = test::a_face();
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  Points line = nasolabial_fold(face.mesh, face.landmarks, true, false);
  line.rowwise() += (1e-3 * shift_mm * frame.x).transpose();
  const Points seen = frame.local_points(line);
  TriMesh skin = hyperex::test::subdivided(face.mesh.skin);
  for (auto point : skin.points.rowwise()) {
    const Vec3 at = frame.local(point.transpose());
    const double off_m = std::sqrt((seen.leftCols<2>().rowwise() - at.head<2>().transpose())
                                       .rowwise()
                                       .squaredNorm()
                                       .minCoeff());
    point -= 0.003 * std::exp(-0.5 * std::pow(off_m / 0.002, 2)) * frame.z.transpose();
  }
  return skin;
}

double outwards_mm(const Vec3& shift, bool left) {
  return (left ? 1e3 : -1e3) * face::face_frame(test::a_face().landmarks).x.dot(shift);
}

TEST(GrooveAtRest, IsFoundBesideTheRulesLine) {
  const test::AFace& face = test::a_face();
  for (const double shift_mm : {-4., 4.}) {
    const TriMesh skin = with_groove(shift_mm);
    EXPECT_NEAR(outwards_mm(groove_at_rest(skin, face.landmarks, true), true), shift_mm, 1.5);
    EXPECT_EQ(groove_at_rest(skin, face.landmarks, false), Vec3::Zero()) << "none on that side";
  }
}

TEST(GrooveAtRest, IsNoneOnAFaceWithoutAFoldFarOffOrAtAHole) {
  const test::AFace& face = test::a_face();
  for (const bool left : {true, false})
    EXPECT_EQ(groove_at_rest(face.mesh.skin, face.landmarks, left), Vec3::Zero());
  EXPECT_EQ(groove_at_rest(with_groove(11), face.landmarks, true), Vec3::Zero());
  TriMesh torn = with_groove(4);
  const Vec3 hole = nasolabial_fold(face.mesh, face.landmarks, true, false).row(15);
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < torn.triangles.rows(); ++t)
    if ((torn.points.row(torn.triangles(t, 0)).transpose() - hole).norm() > 0.006)
      torn.triangles.row(kept++) = torn.triangles.row(t);
  torn.triangles.conservativeResize(kept, 3);
  EXPECT_EQ(groove_at_rest(torn, face.landmarks, true), Vec3::Zero());
}

TEST(GrooveAtRest, ShiftsWhatNoLandmarkGives) {
  const test::AFace& face = test::a_face();
  tissue::TissueMesh mesh = face.mesh;
  mesh.skin = with_groove(-4);
  const Points ruled = nasolabial_fold(mesh, face.landmarks, true, false),
               shifted = nasolabial_fold(mesh, face.landmarks, true, true);
  const Eigen::Index last = ruled.rows() - 1;
  const auto moved_mm = [&](Eigen::Index row) {
    return outwards_mm((shifted.row(row) - ruled.row(row)).transpose(), true);
  };
  EXPECT_LT(moved_mm(0), -0.5);
  EXPECT_LT(moved_mm(last / 2), -1);
  EXPECT_LT(moved_mm(last), -1);
  EXPECT_EQ(nasolabial_fold(mesh, face.landmarks, false, true),
            nasolabial_fold(mesh, face.landmarks, false, false));
  io::Landmarks landmarks = face.landmarks;
  landmarks["nasolabial_fold_lower_L"] = ruled.row(last);
  const Points given = nasolabial_fold(mesh, landmarks, true, true);
  EXPECT_LT((given.row(last) - ruled.row(last)).norm(), 1e-9);
  EXPECT_EQ(given.row(0), shifted.row(0));
}

}  // namespace
}  // namespace hyperex::muscles
