// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/asymmetry_picture.hpp"

#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/report/border_fade.hpp"

namespace hyperex::run {
namespace {

TEST(AsymmetryPicture, HasNoColourWhereTheSkinEnds) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const Eigen::Index count = face.mesh.points.rows();
  const metrics::Asymmetry map = metrics::asymmetry_of(
      metrics::rest_asymmetry(face.mesh, face.landmarks), {PointsF::Zero(count, 3)});
  const Eigen::VectorXf fade = report::border_fade(face.mesh);
  const auto drawn = [&](float at_edge_mm, float inside_mm) {
    Eigen::VectorXf mm = Eigen::VectorXf::Constant(count, inside_mm);
    for (Eigen::Index v = 0; v < count; ++v)
      if (fade[v] < 1) mm[v] = at_edge_mm;
    return draw_asymmetry(face.mesh, mm, map, face.landmarks, "", "").rgb;
  };
  const auto plain = drawn(0, 1);
  EXPECT_EQ(drawn(5, 1), plain);
  EXPECT_NE(drawn(0, 4), plain);
}

/// The embedded face has holes at the eyes or the mouth.
TEST(AsymmetryPicture, ShowsWhatLiesBehindTheMouth) {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  const Eigen::Index count = face.mesh.points.rows();
  const metrics::Asymmetry map = metrics::asymmetry_of(
      metrics::rest_asymmetry(face.mesh, face.landmarks), {PointsF::Zero(count, 3)});
  const report::FaceBacking backing = backing_in_frame(face.mesh, face.landmarks, nullptr, frame);
  ASSERT_FALSE(backing.openings.empty());
  const TriMesh local{frame.local_points(face.mesh.points), face.mesh.triangles};
  io::Landmarks landmarks;
  for (const auto& [name, place] : face.landmarks) landmarks[name] = frame.local(place);
  const BackingSurfaces behind(backing, frame, local.points, nullptr,
                               Eigen::Isometry3d::Identity());
  const Eigen::VectorXf mm = Eigen::VectorXf::Zero(count);
  EXPECT_NE(draw_asymmetry(local, mm, map, landmarks, "", "", &behind).rgb,
            draw_asymmetry(local, mm, map, landmarks, "", "").rgb);
}

}  // namespace
}  // namespace hyperex::run
