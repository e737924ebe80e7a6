// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/scan_landmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "face_pictures.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::tracking {
namespace {

using testing::HasSubstr;

/// One of the 24 turns that map the axes on each other, then 20 degrees more.
Eigen::Matrix3d turn(int k) {
  const int axis = k / 4 % 3;
  Eigen::Matrix3d right_angles;
  right_angles.col(2) = Vec3::Unit(axis) * (k < 12 ? 1 : -1);
  right_angles.col(0) = Vec3::Unit((axis + 1) % 3);
  right_angles.col(1) = right_angles.col(2).cross(right_angles.col(0));
  return Eigen::AngleAxisd(0.35, Vec3(1, 2, 3).normalized()) * right_angles *
         Eigen::AngleAxisd(k % 4 * M_PI / 2, Vec3::UnitZ());
}

TriMesh turned(TriMesh mesh, const Eigen::Matrix3d& rotation) {
  mesh.points = mesh.points * rotation.transpose();
  return mesh;
}

/// Distances in mm of the landmarks that both have, sorted; `from`: the first iBUG point counted.
std::vector<double> errors_mm(const io::Landmarks& found, const io::Landmarks& truth,
                              const Eigen::Matrix3d& rotation, int from) {
  std::vector<double> errors;
  for (const auto& [name, at] : truth) {
    if (from > 0 && (!name.starts_with("ibug68_") || std::stoi(name.substr(7)) < from)) continue;
    if (found.contains(name)) errors.push_back(1e3 * (found.at(name) - rotation * at).norm());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(ScanLandmarks, OfTheEmbeddedFaceHoweverItIsTurned) {
  const auto& face = face_to_draw();
  for (const int k : {0, 9, 18}) {
    const TriMesh scan = turned(face.mesh, turn(k));
    const ScanLandmarks found = find_scan_landmarks(scan, {}, "made-up");
    EXPECT_EQ(found.landmarks.size(), face.landmarks.size());
    const auto errors = errors_mm(found.landmarks, face.landmarks, turn(k), 17);
    EXPECT_LT(errors[errors.size() / 2], 3.5) << k;
    EXPECT_GT(found.scan_from_canonical.rotation.col(2).dot(turn(k).col(2)), 0.98) << k;
    EXPECT_GT(found.scan_from_canonical.rotation.col(1).dot(turn(k).col(1)), 0.98) << k;
    const SurfaceTree surface(scan);
    for (const auto& [name, at] : found.landmarks)
      EXPECT_LT(surface.query(at).squared_distance, 1e-12) << name;
  }
}

TEST(ScanLandmarks, NoFaceIsSaidInOneLine) {
  // A ball of the size of a head.
  TriMesh ball;
  constexpr int n = 24;
  ball.points.resize(n * n, 3);
  ball.triangles.resize(2 * n * (n - 1), 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double polar = M_PI * (i + 0.5) / n, around = 2 * M_PI * j / n;
      ball.points.row(i * n + j) << 0.1 * std::sin(polar) * std::cos(around),
          0.1 * std::sin(polar) * std::sin(around), 0.1 * std::cos(polar);
      if (i + 1 == n) continue;
      const int a = i * n + j, b = i * n + (j + 1) % n;
      ball.triangles.row(2 * a) << a, a + n, b;
      ball.triangles.row(2 * a + 1) << b, a + n, b + n;
    }
  try {
    find_scan_landmarks(ball, {}, "ball.ply");
    FAIL() << "a face was found on a ball";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ball.ply: no face was found"));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(ScanLandmarks, AFaceInsideOutIsNotTakenForOne) {
  TriMesh scan = face_to_draw().mesh;
  scan.triangles.col(1).swap(scan.triangles.col(2));
  EXPECT_THROW(find_scan_landmarks(scan, {}, "inside_out.ply"), InputError);
}

struct RealScan {
  const char *scan, *landmarks;
  double median_inner_mm, median_mm, largest_mm;
};

/// The bounds are what the project demands; one turn each, the others take minutes.
TEST(ScanLandmarks, OfScansWithKnownLandmarks) {
  const auto data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not here";
  for (const RealScan& real :
       {RealScan{"ict/subject_A_neutral_scan.ply", "ict/subject_A_landmarks.json", 2.5, 4, 25},
        RealScan{"real/humface.ply", "real/humface_landmarks.json", 0, 3.5, 3.5}}) {
    const io::Scan scan = io::read_scan(data / real.scan);
    const io::Landmarks truth = io::read_landmarks(data / real.landmarks);
    const auto found = find_scan_landmarks(turned(scan.mesh, turn(14)), {}, real.scan);
    const auto inner = errors_mm(found.landmarks, truth, turn(14), 17);
    const auto all = errors_mm(found.landmarks, truth, turn(14), 0);
    if (!inner.empty()) {
      EXPECT_LT(inner[inner.size() / 2], real.median_inner_mm) << real.scan;
    }
    EXPECT_LT(all[all.size() / 2], real.median_mm) << real.scan;
    EXPECT_LT(all.back(), real.largest_mm) << real.scan;
  }
}

TEST(PictureColours, OwnElseTextureElseNone) {
  io::Scan scan;
  scan.mesh.points = Points::Zero(3, 3);
  scan.mesh.triangles.resize(1, 3);
  scan.mesh.triangles << 0, 1, 2;
  EXPECT_EQ(picture_colours(scan).rows(), 0);
  scan.texture = io::Image{render::png_bytes([] {
                             render::Image image(2, 2, {0, 0, 0});
                             image.pixel(1, 0)[0] = 250;  // red at the upper right
                             image.pixel(0, 1)[2] = 240;  // blue at the lower left
                             return image;
                           }()),
                           "image/png"};
  scan.corner_uv.resize(3, 2);
  scan.corner_uv << 0.75F, 0.25F, 0.25F, 0.75F, 0.25F, 0.25F;
  const auto colours = picture_colours(scan);
  ASSERT_EQ(colours.rows(), 3);
  EXPECT_EQ(colours.row(0), (Eigen::RowVector3i(250, 0, 0).cast<std::uint8_t>()));
  EXPECT_EQ(colours.row(1), (Eigen::RowVector3i(0, 0, 240).cast<std::uint8_t>()));
  EXPECT_EQ(colours.row(2), (Eigen::RowVector3i(0, 0, 0).cast<std::uint8_t>()));
  scan.vertex_colour = io::VertexColours::Constant(3, 4, 77);
  EXPECT_EQ(picture_colours(scan)(1, 1), 77);
}

}  // namespace
}  // namespace hyperex::tracking
