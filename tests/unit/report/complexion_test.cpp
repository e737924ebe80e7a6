// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/complexion.hpp"

#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::report {
namespace {

/// The embedded face at rest, moved, turned and scaled, as a scan without colours.
simulate::Performance still_face(const anatomy::EmbeddedFace& face) {
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, -1).normalized());
  const auto place = [&](const Vec3& p) -> Vec3 { return 1.1 * (turn * p) + Vec3(0.2, -0.1, 0.4); };
  simulate::Performance still;
  still.skin_rest = face.mesh;
  for (Eigen::Index v = 0; v < face.mesh.points.rows(); ++v)
    still.skin_rest.points.row(v) = place(face.mesh.points.row(v).transpose()).transpose();
  Points positions(Eigen::Index(face.landmarks.size()), 3);
  for (const auto& [name, at] : face.landmarks) {
    positions.row(Eigen::Index(still.landmarks.names.size())) = place(at).transpose();
    still.landmarks.names.push_back(name);
  }
  still.landmarks.positions = {positions};
  return still;
}

TEST(Complexion, CarriesThePaintedSkinToTheScan) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const simulate::Performance still = still_face(face);
  const io::VertexColours colours = complexion(still, face::SkinTone::light);
  ASSERT_EQ(colours.rows(), face.mesh.points.rows());
  EXPECT_EQ(colours.col(3).minCoeff(), 255);
  // The same picture by the face's own texture coordinates, as faint as a scan's.
  const face::SkinPicture& skin = face::painted_skin(face::SkinTone::light, face::SkinDetail::soft);
  const auto plain = face::tone_colour(face::SkinTone::light);
  double off = 0;
  for (Eigen::Index v = 0; v < colours.rows(); ++v) {
    const auto own = skin.at(face.uv(v, 0), face.uv(v, 1));
    for (int k = 0; k < 3; ++k)
      off += std::abs(plain[std::size_t(k)] + 0.6 * (own[std::size_t(k)] - plain[std::size_t(k)]) -
                      colours(v, k)) /
             double(3 * colours.rows());
  }
  EXPECT_LT(off, 4) << "of 255 levels";
}

TEST(Complexion, ShowsNoFaceOnTheBackOfTheHead) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  simulate::Performance still = still_face(face);
  // The same surface once more, 15 cm behind.
  const Eigen::Index count = still.skin_rest.points.rows();
  const Vec3 forward = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()) * Vec3::UnitZ();
  still.skin_rest.points.conservativeResize(2 * count, 3);
  still.skin_rest.points.bottomRows(count) =
      still.skin_rest.points.topRows(count).rowwise() - 0.15 * forward.transpose();
  const io::VertexColours colours = complexion(still, face::SkinTone::light);
  const auto plain = face::tone_colour(face::SkinTone::light);
  for (Eigen::Index v = count; v < 2 * count; ++v)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(colours(v, k), plain[std::size_t(k)]) << v;
}

TEST(Complexion, IsNoneWithoutLandmarks) {
  simulate::Performance still = still_face(anatomy::embedded_face());
  still.landmarks = {};
  EXPECT_EQ(complexion(still, face::SkinTone::dark).rows(), 0);
}

}  // namespace
}  // namespace hyperex::report
