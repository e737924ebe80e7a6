// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

using face::ibug;

class SixtyEight : public testing::Test {
 protected:
  io::Landmarks landmarks_ = test::small_face().landmarks;
  face::FaceFrame frame_ = face::face_frame(landmarks_);
  std::vector<std::string> names_ = face::all_ibug();

  Points rest() const {
    Points p(68, 3);
    for (int k = 0; k < 68; ++k) p.row(k) = landmarks_.at(ibug(k)).transpose();
    return p;
  }
  static int in_ring(const Triangles& t, Eigen::Index f, int first, int last) {
    int count = 0;
    for (int k = 0; k < 3; ++k) count += t(f, k) >= first && t(f, k) <= last;
    return count;
  }
  static void expect_open(const Triangles& t) {
    for (Eigen::Index f = 0; f < t.rows(); ++f) {
      EXPECT_LT(in_ring(t, f, 36, 41), 3) << "inside the right eye";
      EXPECT_LT(in_ring(t, f, 42, 47), 3) << "inside the left eye";
      EXPECT_LT(in_ring(t, f, 60, 67), 3) << "between the lips";
      int upper = 0, lower = 0;
      for (int k = 0; k < 3; ++k) {
        upper += anatomy::lip_of(ibug(t(f, k))) > 0;
        lower += anatomy::lip_of(ibug(t(f, k))) < 0;
      }
      EXPECT_FALSE(upper && lower) << "joins the lips";
    }
    EXPECT_EQ(boundary_loops(t).size(), 4u) << "the outline, two eyes, one mouth";
    std::set<std::pair<int, int>> directed;
    std::set<int> used;
    for (Eigen::Index f = 0; f < t.rows(); ++f)
      for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(directed.insert({t(f, k), t(f, (k + 1) % 3)}).second);
        used.insert(t(f, k));
      }
    EXPECT_EQ(used.size(), 68u) << "all points used";
    // The contours are edges.
    const auto edge = [&](int a, int b) { return directed.count({a, b}) + directed.count({b, a}); };
    for (const auto& [first, last] : {std::pair{36, 41}, {42, 47}, {48, 59}, {60, 67}})
      for (int k = first; k <= last; ++k) EXPECT_GT(edge(k, k == last ? first : k + 1), 0u) << k;
  }
};

TEST_F(SixtyEight, LeavesEyesAndMouthOpen) {
  expect_open(triangulate_points(names_, rest(), frame_));
}

TEST_F(SixtyEight, FacesOutwards) {
  const Points p = rest();
  const Triangles t = triangulate_points(names_, p, frame_);
  for (Eigen::Index f = 0; f < t.rows(); ++f) {
    const Vec3 a = p.row(t(f, 0)), b = p.row(t(f, 1)), c = p.row(t(f, 2));
    EXPECT_GT((b - a).cross(c - a).dot(frame_.z), 0) << t.row(f);
  }
}

TEST_F(SixtyEight, TellsTouchingAndCrossingLipsApartByName) {
  for (const double crossing : {0.0, 0.001}) {
    for (const auto& [lower, upper] : {std::pair{67, 61}, {66, 62}, {65, 63}})
      landmarks_[ibug(lower)] = landmarks_[ibug(upper)] + crossing * frame_.y;
    expect_open(triangulate_points(names_, rest(), frame_));
  }
}

TEST_F(SixtyEight, SurvivesCrossingContours) {
  std::swap(landmarks_[ibug(37)], landmarks_[ibug(41)]);
  std::swap(landmarks_[ibug(50)], landmarks_[ibug(56)]);
  const Triangles t = triangulate_points(names_, rest(), frame_);
  EXPECT_GT(t.rows(), 50);
  for (const int v : t.reshaped()) {
    EXPECT_GE(v, 0);
    EXPECT_LT(v, 68);
  }
}

TEST_F(SixtyEight, WorksWithoutContours) {
  Points p(4, 3);
  const face::FaceFrame& f = frame_;
  p.row(0) = f.world({-0.03, 0.03, 0}).transpose();
  p.row(1) = f.world({0.03, 0.03, 0.01}).transpose();
  p.row(2) = f.world({0.03, 0.08, 0}).transpose();
  p.row(3) = f.world({-0.03, 0.08, 0.01}).transpose();
  EXPECT_EQ(triangulate_points({"a", "b", "c", "d"}, p, f).rows(), 2);
  EXPECT_EQ(triangulate_points({"a", "b"}, p.topRows(2), f).rows(), 0);
}

}  // namespace
}  // namespace hyperex::simulate
