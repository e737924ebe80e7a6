// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/alignment.hpp"

#include <gmock/gmock.h>

#include <random>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

using face::ibug;

io::Landmarks canonical_landmarks() {
  io::Landmarks landmarks;
  const auto& face = anatomy::canonical_face();
  for (const auto& name : face::all_ibug()) landmarks[name] = face.landmark(name, face.mesh.points);
  return landmarks;
}

/// The landmarks (and one other point) tracked in separate axes, and one more sample in which each
/// point is displaced by `displacement` in those axes.
motion::Motion tracked(const io::Landmarks& landmarks, const Similarity& motion_from_scan,
                       const std::function<Vec3(const Vec3&)>& displacement) {
  motion::Motion m;
  m.source = "tracked.csv";
  m.time_s = {0, 1};
  Points rest(static_cast<Eigen::Index>(landmarks.size()) + 1, 3);
  for (const auto& [name, p] : landmarks) {
    rest.row(static_cast<Eigen::Index>(m.names.size())) = (motion_from_scan * p).transpose();
    m.names.push_back(name);
  }
  rest.bottomRows(1) = (motion_from_scan * Vec3(0.02, 0.01, 0.05)).transpose();
  m.names.push_back("marker");
  Points moved = rest;
  for (Eigen::Index i = 0; i < rest.rows(); ++i)
    moved.row(i) += displacement(rest.row(i)).transpose();
  m.positions = {rest, moved};
  return m;
}

Similarity some_similarity(double scale) {
  Similarity s;
  s.scale = scale;
  s.rotation = Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  s.translation = {0.4, -1, 2};
  return s;
}

TEST(Align, RecoversAKnownSimilarity) {
  const io::Landmarks landmarks = canonical_landmarks();
  const Similarity motion_from_scan = some_similarity(1.7);
  const auto m = tracked(landmarks, motion_from_scan, [](const Vec3& x) { return 0.01 * x; });
  for (const auto method : {AlignmentMethod::similarity, AlignmentMethod::nonrigid}) {
    const AlignedMotion out = align(m, landmarks, method);
    EXPECT_NEAR(out.scan_from_motion.scale, 1 / 1.7, 1e-12);
    EXPECT_LT((out.scan_from_motion.rotation - motion_from_scan.rotation.transpose()).norm(),
              1e-12);
    EXPECT_LT(out.rms_mm, 1e-9);
    EXPECT_EQ(out.common.size(), 68u);
    for (std::size_t i = 0; i < m.names.size(); ++i) {
      const Vec3 expected =
          m.names[i] == "marker" ? Vec3(0.02, 0.01, 0.05) : landmarks.at(m.names[i]);
      EXPECT_LT((out.rest.row(i).transpose() - expected).norm(), 1e-12) << m.names[i];
      const Vec3 d = 0.01 * m.positions[0].row(i).transpose();
      const Vec3 turned = motion_from_scan.rotation.transpose() * d / 1.7;
      EXPECT_LT((out.motion.positions[1].row(i) - out.rest.row(i) - turned.transpose()).norm(),
                1e-12);
      EXPECT_LT((out.motion.positions[0].row(i) - out.rest.row(i)).norm(), 1e-12);
    }
  }
}

TEST(Align, NonrigidMeetsEveryLandmarkAndLeavesDisplacementsToTheSimilarity) {
  const io::Landmarks landmarks = canonical_landmarks();
  auto m = tracked(landmarks, some_similarity(1), [](const Vec3&) { return Vec3(0, 0.003, 0); });
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> unit(-0.004, 0.004);
  for (Eigen::Index i = 0; i < m.positions[0].rows(); ++i) {  // another face than the scan's
    const Eigen::RowVector3d off(unit(generator), unit(generator), unit(generator));
    for (Points& p : m.positions) p.row(i) += off;
  }
  const AlignedMotion similar = align(m, landmarks, AlignmentMethod::similarity);
  const AlignedMotion out = align(m, landmarks, AlignmentMethod::nonrigid);
  EXPECT_GT(out.rms_mm, 1);
  for (std::size_t i = 0; i < m.names.size(); ++i) {
    if (m.names[i] != "marker") {
      EXPECT_LT((out.rest.row(i).transpose() - landmarks.at(m.names[i])).norm(), 1e-9);
    }
    EXPECT_LT((out.motion.positions[1].row(i) - out.rest.row(i) -
               similar.motion.positions[1].row(i) + similar.rest.row(i))
                  .norm(),
              1e-12);
  }
}

class EveryMethod : public testing::TestWithParam<AlignmentMethod> {};

TEST_P(EveryMethod, AHalfSizeFaceGivesDoubledDisplacements) {
  const io::Landmarks landmarks = canonical_landmarks();
  Similarity half;
  half.scale = 0.5;
  const auto m = tracked(landmarks, half, [](const Vec3&) { return Vec3(0.001, -0.002, 0.0005); });
  const AlignedMotion out = align(m, landmarks, GetParam());
  for (Eigen::Index i = 0; i < out.rest.rows(); ++i) {
    EXPECT_LT((out.rest.row(i) - 2 * m.positions[0].row(i)).norm(), 1e-9);
    const Vec3 d = (out.motion.positions[1].row(i) - out.rest.row(i)).transpose();
    EXPECT_LT((d - Vec3(0.002, -0.004, 0.001)).norm(), 1e-9) << m.names[i];
  }
}

TEST_P(EveryMethod, TooFewCommonPointsAreRefused) {
  const io::Landmarks landmarks = canonical_landmarks();
  const auto whole = tracked(landmarks, {}, [](const Vec3&) { return Vec3::Zero(); });
  const auto only = [&](const std::vector<std::string>& names) {
    motion::Motion m = whole;
    m.names = names;
    for (Points& p : m.positions) {
      Points kept(names.size(), 3);
      for (std::size_t i = 0; i < names.size(); ++i) kept.row(i) = p.row(whole.index_of(names[i]));
      p = kept;
    }
    return m;
  };
  EXPECT_THAT(
      hyperex::test::refusal([&] {
        align(only({ibug(36), ibug(45), "marker"}), landmarks, GetParam());
      }),
      testing::AllOf(testing::HasSubstr("tracked.csv"), testing::HasSubstr("2 point names")));
  // The corners of both eyes lie nearly on a line.
  EXPECT_THROW(align(only({ibug(36), ibug(39), ibug(42), ibug(45)}),
                     {{ibug(36), {0, 0, 0}},
                      {ibug(39), {0.03, 0, 0}},
                      {ibug(42), {0.06, 0.0001, 0}},
                      {ibug(45), {0.09, 0, 0}}},
                     GetParam()),
               InputError);
}

INSTANTIATE_TEST_SUITE_P(All, EveryMethod,
                         testing::Values(AlignmentMethod::nonrigid, AlignmentMethod::similarity,
                                         AlignmentMethod::normalised));

/// A face with given widths and heights of its parts about the nose apex (0, 0, 0), in the axes of
/// the frame.
io::Landmarks parts(double width, double upper, double lower) {
  return {{ibug(30), {0, 0, 0}},
          {ibug(27), {0, upper, -0.02}},
          {ibug(8), {0, -lower, -0.02}},
          {ibug(36), {-width / 2, upper, -0.04}},
          {ibug(45), {width / 2, upper, -0.04}},
          {ibug(48), {-0.3 * width, -lower / 2, -0.03}},
          {ibug(54), {0.3 * width, -lower / 2, -0.03}}};
}

TEST(Align, NormalisedFollowsTheSourcesFormulas) {
  // w, h_u, h_d of the shape model (s) and of the tracked mesh (a).
  const double ws = 0.09, hsu = 0.05, hsd = 0.08, wa = 0.06, hau = 0.04, had = 0.05;
  const io::Landmarks scan = parts(ws, hsu, hsd);
  Similarity moved;  // the tracked mesh lies elsewhere, in the same axes
  moved.translation = {0.5, 0.1, -0.3};
  const Vec3 displacement(0.003, 0.004, -0.005);
  auto m = tracked(parts(wa, hau, had), moved, [&](const Vec3&) { return displacement; });
  const AlignedMotion out = align(m, scan, AlignmentMethod::normalised);
  for (std::size_t i = 0; i < m.names.size(); ++i) {
    const Vec3 a = m.positions[0].row(i).transpose() - moved.translation;  // about the nose apex
    const Vec3 p = out.rest.row(i).transpose();
    // [5.1-5.4]: the shape's point p lands on the tracked mesh's a.
    EXPECT_NEAR(p.x() * wa / ws, a.x(), 1e-12) << m.names[i];
    EXPECT_NEAR(p.z() * wa / ws, a.z(), 1e-12);
    EXPECT_NEAR(p.y() >= 0 ? p.y() * hau / hsu : p.y() * had / hsd, a.y(), 1e-12);
    // Displacements brought back: x and z by w_s / w_a, y by h_s / h_a.
    const Vec3 d = (out.motion.positions[1].row(i) - out.rest.row(i)).transpose();
    EXPECT_NEAR(d.x(), 0.003 * ws / wa, 1e-12);
    EXPECT_NEAR(d.y(), 0.004 * (a.y() >= 0 ? hsu / hau : hsd / had), 1e-12);
    EXPECT_NEAR(d.z(), -0.005 * ws / wa, 1e-12);
  }
}

TEST(Align, NormalisedNamesThePointItMisses) {
  const io::Landmarks scan = parts(0.09, 0.05, 0.08);
  io::Landmarks fewer = scan;
  fewer.erase(ibug(30));
  const auto m = tracked(fewer, {}, [](const Vec3&) { return Vec3::Zero(); });
  EXPECT_THAT(hyperex::test::refusal([&] { align(m, scan, AlignmentMethod::normalised); }),
              testing::HasSubstr("ibug68_30"));
}

}  // namespace
}  // namespace hyperex::simulate
