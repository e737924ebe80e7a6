// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/plausible.hpp"

#include <gmock/gmock.h>

namespace hyperex::scene {
namespace {

/// One triangle of the simulated skin, `off_m` above a vertex of the scan that is its middle.
tissue::TissueMesh skin_off_by(double off_m) {
  tissue::TissueMesh mesh;
  mesh.volume.outer.points = (Points(3, 3) << 0, 0, 0, 0.03, 0, 0, 0, 0.03, 0).finished();
  mesh.skin.points = (Points(1, 3) << 0.01, 0.01, -off_m).finished();
  tissue::Anchor anchor;
  anchor.node = {0, 1, 2};
  anchor.weight = Vec3::Constant(1.0 / 3);
  mesh.anchors = {anchor};
  return mesh;
}

TEST(SkinWarning, NamesThePlaceOnTheFace) {
  const io::Landmarks landmarks = {{"alare_L", {0.01, 0.02, -0.009}}, {"nasion", {1, 0, 0}}};
  EXPECT_THAT(skin_warning(skin_off_by(0.009), landmarks),
              testing::AllOf(testing::HasSubstr("up to 9.0 mm off the scan"),
                             testing::HasSubstr("10 mm from alare_L")));
  EXPECT_EQ(skin_warning(skin_off_by(0.004), landmarks), "");
}

TEST(SkinWarning, LeavesEarsAndNeckAside) {
  EXPECT_EQ(skin_warning(skin_off_by(0.009), {{"ibug68_16", {0.01, 0.05, 0}}}), "");
  EXPECT_EQ(skin_warning(skin_off_by(0.009), {}), "");
}

}  // namespace
}  // namespace hyperex::scene
