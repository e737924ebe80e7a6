// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/camera_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "recording.hpp"

namespace hyperex::capture {
namespace {
using testing::HasSubstr;
using namespace test;

const std::string sound =
    "width = 640\nheight = 480\nfx = 525\nfy = 526.5\ncx = 319.5\ncy = 239.5\n";

Camera read(const std::string& text) {
  const Folder folder;
  write_text(folder / "camera.toml", text);
  return read_camera_file(folder / "camera.toml");
}

std::string error_of(std::string text, const std::string& from = "", const std::string& to = "") {
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return refusal([&] { read(text); });
}

TEST(CameraFile, EveryKeyReachesItsTarget) {
  const Camera camera = read(sound + "depth_scale = 1000\nfps = 30\nk1 = 0\n");
  EXPECT_EQ(camera.intrinsics.width_px, 640);
  EXPECT_EQ(camera.intrinsics.height_px, 480);
  EXPECT_EQ(camera.intrinsics.fx_px, 525);
  EXPECT_EQ(camera.intrinsics.fy_px, 526.5);
  EXPECT_EQ(camera.intrinsics.cx_px, 319.5);
  EXPECT_EQ(camera.intrinsics.cy_px, 239.5);
  EXPECT_EQ(camera.depth_per_metre, 1000);
  EXPECT_THAT(camera.notes, testing::IsEmpty());
  EXPECT_EQ(read(sound).depth_per_metre, 5000);
}

TEST(CameraFile, FaultsAreNamedByLineAndKey) {
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) {
    const std::string line = std::string(key) + " = ";
    EXPECT_THAT(error_of(sound, line, "other_" + line), HasSubstr(key)) << key;
    const std::string error = error_of(sound, line, line + "\"a\" # ");
    EXPECT_THAT(error, HasSubstr(std::string(key) + " = ")) << key;
    EXPECT_THAT(error, HasSubstr("expected")) << key;
  }
  EXPECT_THAT(error_of(sound, "fx = 525", "fx = -525"), HasSubstr("camera.toml:3: fx = -525"));
  EXPECT_THAT(error_of(sound, "fx = 525", "fx = nan"), HasSubstr("fx = nan"));
  EXPECT_THAT(error_of(sound, "width = 640", "width = 640.5"), HasSubstr("width = 640.5"));
  EXPECT_THAT(error_of(sound, "width = 640", "width = 0"), HasSubstr("width = 0"));
  EXPECT_THAT(error_of(sound + "depth_scale = 0\n"), HasSubstr("camera.toml:7: depth_scale"));
  EXPECT_THAT(error_of(sound + "k1 = 0.1\n"), HasSubstr("distortion"));
  EXPECT_THAT(error_of(sound + "[=\n"), HasSubstr("camera.toml:7: "));
  EXPECT_THAT(error_of(sound + "fx = [1]\n"), HasSubstr("TOML"));
}

TEST(CameraFile, SaysWhatItDoesNotUse) {
  EXPECT_THAT(read(sound + "lens = \"wide\"\n").notes,
              testing::ElementsAre(testing::AllOf(HasSubstr(":7: "), HasSubstr("lens"))));
}

TEST(GuessedIntrinsics, SpanTheStatedAngleAcrossTheLongerSide) {
  const Intrinsics wide = guess_intrinsics(640, 480, 60);
  // From the left edge of the first pixel to the right edge of the last.
  EXPECT_NEAR(2 * std::atan(320 / wide.fx_px) * 180 / M_PI, 60, 1e-9);
  EXPECT_EQ(wide.fx_px, wide.fy_px);
  EXPECT_EQ(wide.cx_px, 319.5);
  EXPECT_EQ(wide.cy_px, 239.5);
  EXPECT_EQ(guess_intrinsics(480, 640, 60).fx_px, wide.fx_px);
  EXPECT_THAT(refusal([] { guess_intrinsics(640, 480, 180); }), HasSubstr("10 to 170"));
}

}  // namespace
}  // namespace hyperex::capture
