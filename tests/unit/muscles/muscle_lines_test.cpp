// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "muscles/a_face.hpp"

namespace hyperex::muscles {
namespace {

std::vector<MuscleLine> lines_of(const std::vector<TemplateMuscle>& muscles,
                                 const test::AFace& face = test::a_face()) {
  return muscle_lines(muscles, face.mesh, face.landmarks);
}

/// One muscle with a path.
std::vector<TemplateMuscle> with_path(const std::string& path) {
  return read_muscles("[[muscle]]\nname = \"own\"\npath = " + path, "test");
}

double farthest(const MuscleLine& line, const TriMesh& surface) {
  const SurfaceTree tree(surface);
  double most = 0;
  for (Eigen::Index i = 0; i < line.line.rows(); ++i)
    most = std::max(most, std::sqrt(tree.query(line.line.row(i)).squared_distance));
  return most;
}

TEST(MuscleLines, LeftAndRightOfEachInTurn) {
  const auto& muscles = muscle_template();
  const auto lines = lines_of(muscles);
  ASSERT_EQ(lines.size(), 2 * muscles.size());
  for (std::size_t m = 0; m < lines.size(); ++m) {
    const MuscleLine& line = lines[m];
    EXPECT_EQ(line.row, static_cast<int>(m / 2));
    EXPECT_EQ(line.left, m % 2 == 0);
    EXPECT_EQ(line.name, muscles[m / 2].name + (m % 2 == 0 ? "_L" : "_R"));
    ASSERT_EQ(line.arc.size(), static_cast<std::size_t>(line.line.rows()));
    EXPECT_EQ(line.arc.front(), 0);
    for (std::size_t i = 1; i < line.arc.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      EXPECT_NEAR(line.arc[i] - line.arc[i - 1], (line.line.row(k) - line.line.row(k - 1)).norm(),
                  1e-12);
    }
    EXPECT_GT(line.arc.back(), 0.008) << line.name;
    EXPECT_LT(line.arc.back(), 0.1) << line.name;
  }
}

TEST(MuscleLines, BeginAndEndAtTheirPlaces) {
  const test::AFace& face = test::a_face();
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  const double size_mm =
      1e3 * (face.landmarks.at("ibug68_45") - face.landmarks.at("ibug68_36")).norm();
  std::vector<TemplateMuscle> muscles = muscle_template();
  for (TemplateMuscle& m : muscles)
    for (TemplatePlace& place : m.path) place.depth = 0;
  for (const MuscleLine& line : lines_of(muscles)) {
    EXPECT_NEAR(line.scale, size_mm / 87.4, 1e-12);
    const auto by_hand = [&](const TemplatePlace& place) {
      Vec3 p = Vec3::Zero();
      for (const auto& [k, weight] : place.ibug) {
        const std::string name = face::ibug(k);
        p += weight * face.landmarks.at(line.left ? name : anatomy::mirrored_landmark(name));
      }
      const double side = line.left ? 1 : -1, mm = 1e-3 * size_mm / 87.4;
      return Vec3(p + mm * (side * place.out_mm * frame.x + place.up_mm * frame.y));
    };
    const auto& path = muscles[std::size_t(line.row)].path;
    const Vec3 first = line.line.row(0), last = line.line.row(line.line.rows() - 1);
    // An offset is tangent to the skin in the middle of the face, not at its side; the platysma's
    // origin lies under the embedded face's border.
    EXPECT_LT((first - by_hand(path.front())).norm(), path.front().up_mm < -20 ? 0.025 : 0.016)
        << line.name;
    EXPECT_LT((last - by_hand(path.back())).norm(), 0.008) << line.name;
    const SurfaceTree skin(face.mesh.volume.outer);
    EXPECT_LT((skin.query(by_hand(path.front())).point - first).norm(), 1e-4) << line.name;
    EXPECT_LT((skin.query(by_hand(path.back())).point - last).norm(), 1e-4) << line.name;
  }
}

/// The angle between a muscle's way from origin to insertion and the midline, from in front: 0
/// downwards, above 0 towards the midline, below 0 away from it.
double to_midline_deg(const MuscleLine& line, const face::FaceFrame& frame) {
  const Vec3 way = (line.line.row(line.line.rows() - 1) - line.line.row(0)).transpose();
  const double side = line.left ? 1 : -1;
  return std::atan2(-side * way.dot(frame.x), -way.dot(frame.y)) * 180 / std::numbers::pi;
}

/// Mean and standard deviation in 50 half faces (Hwang et al., Angle Orthod. 79, 2009, 70). Levator
/// alaeque runs outwards to the lip.
TEST(MuscleLines, RunAtTheAnglesThatDissectionFound) {
  struct Dissected {
    const char* muscle;
    double mean_deg, sigma_deg;
  };
  const test::AFace& face = test::a_face();
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  const auto lines = lines_of(muscle_template());
  for (const Dissected& d :
       {Dissected{"zyg_minor", 55.7, 6.4}, Dissected{"lev_alaeque", -20.2, 3.2},
        Dissected{"lev_lab_sup", 25.8, 4.8}}) {
    int found = 0;
    for (const MuscleLine& line : lines) {
      if (muscle_template()[std::size_t(line.row)].name != d.muscle) continue;
      ++found;
      const double angle_deg = to_midline_deg(line, frame);
      RecordProperty(line.name, std::to_string(angle_deg));
      EXPECT_NEAR(angle_deg, d.mean_deg, d.sigma_deg) << line.name;
    }
    EXPECT_EQ(found, 2) << d.muscle;
  }
}

TEST(MuscleLines, EndAtTheCornerOfTheMouth) {
  const test::AFace& face = test::a_face();
  const auto lines = lines_of(with_path(R"(["45 d0", "54 d0"])"));
  EXPECT_LT((Vec3(lines[0].line.bottomRows(1).transpose()) - face.landmarks.at("ibug68_54")).norm(),
            0.003);
  EXPECT_LT((Vec3(lines[1].line.bottomRows(1).transpose()) - face.landmarks.at("ibug68_48")).norm(),
            0.003);
  EXPECT_LT((Vec3(lines[1].line.row(0).transpose()) - face.landmarks.at("ibug68_36")).norm(),
            0.003);
}

TEST(MuscleLines, LieOnTheSkinAtDepth0AndOnTheBoneAt1) {
  const test::AFace& face = test::a_face();
  const char* places[] = {R"("45 (9, -30))", R"("0.35*45 + 0.65*54)", R"("54 (1, 1))"};
  const auto at = [&](const std::string& depth) {
    std::string path = "[";
    for (const char* place : places) path += place + (" d" + depth) + "\", ";
    return lines_of(with_path(path + "]"));
  };
  for (const MuscleLine& line : at("0")) EXPECT_LT(farthest(line, face.mesh.volume.outer), 1e-9);
  for (const MuscleLine& line : at("1")) EXPECT_LT(farthest(line, face.inner()), 1e-9);
  const auto skin = at("0"), middle = at("0.5"), bone = at("1");
  for (std::size_t m = 0; m < 2; ++m)
    EXPECT_LT((middle[m].line - 0.5 * (skin[m].line + bone[m].line)).rowwise().norm().maxCoeff(),
              1e-9);
}

/// Like a strap under the cheek, it does not follow the bulging skin above it.
TEST(MuscleLines, AStraightMuscleRunsStraightBetweenItsPlaces) {
  const std::string path = R"(["45 (9, -30) d1", "54 (1, 1) d0.4"])";
  const auto along = lines_of(with_path(path));
  const auto straight = lines_of(with_path(path + "\nstraight = true"));
  for (std::size_t m = 0; m < 2; ++m) {
    const Points &a = along[m].line, &s = straight[m].line;
    const Eigen::Index last = s.rows() - 1;
    EXPECT_LT((s.row(0) - a.row(0)).norm(), 1e-12);
    EXPECT_LT((s.row(last) - a.row(a.rows() - 1)).norm(), 1e-12);
    EXPECT_NEAR(straight[m].arc.back(), (s.row(last) - s.row(0)).norm(), 1e-12);
    EXPECT_GT(along[m].arc.back(), 1.001 * straight[m].arc.back());
  }
}

TEST(MuscleLines, ADepthThatIsNotGivenIsInterpolatedByTheWay) {
  const auto open = lines_of(with_path(R"(["45 (9, -30) d1", "0.5*45 + 0.5*54", "54 d0"])"));
  const SurfaceTree skin(test::a_face().mesh.volume.outer);
  const MuscleLine& line = open[0];
  double before = 1;
  for (Eigen::Index i = 0; i < line.line.rows(); i += 3) {
    // Depth as a share of the thickness, which is the same everywhere.
    const double depth = std::sqrt(skin.query(line.line.row(i)).squared_distance) / 0.008;
    EXPECT_LT(depth, before + 0.06);
    EXPECT_NEAR(depth, 1 - line.arc[std::size_t(i)] / line.arc.back(), 0.15) << i;
    before = depth;
  }
}

/// Greatest distance of the mirrored left lines from the right ones (m).
double mirrored_off(const std::vector<MuscleLine>& lines, const face::FaceFrame& frame) {
  double worst = 0;
  for (std::size_t m = 0; m < lines.size(); m += 2)
    for (Eigen::Index i = 0; i < lines[m].line.rows(); ++i) {
      Vec3 p = frame.local(lines[m].line.row(i));
      EXPECT_GT(p.x(), -0.001) << lines[m].name << ": on its own side";
      p.x() *= -1;
      const double off = nearest_on_line(lines[m + 1], frame.world(p)).distance_m;
      worst = std::max(worst, off);
    }
  return worst;
}

/// The face is symmetric, but its mesh is not. Lines on the skin depend only on the places. Lines
/// in the tissue also depend on the mesh's inner surface, which differs at the corners of the
/// mouth; and where closed lips lie 0.2 mm apart, a place between them is on either.
TEST(MuscleLines, LeftAndRightMirrorEachOther) {
  const test::AFace fine(0.0025);
  const face::FaceFrame frame = face::face_frame(fine.landmarks);
  std::vector<TemplateMuscle> on_skin = muscle_template();
  for (TemplateMuscle& m : on_skin)
    for (TemplatePlace& place : m.path) place.depth = 0;
  EXPECT_LT(mirrored_off(lines_of(on_skin, fine), frame), 0.002);
  EXPECT_LT(mirrored_off(lines_of(muscle_template(), fine), frame), 0.0035);
}

TEST(MuscleLines, GrowWithTheFace) {
  constexpr double kLarger = 1.3;
  test::AFace larger = test::a_face();
  larger.mesh.volume.nodes *= kLarger;
  larger.mesh.volume.outer.points *= kLarger;
  for (auto& [name, p] : larger.landmarks) p *= kLarger;
  const auto lines = lines_of(muscle_template()), large = lines_of(muscle_template(), larger);
  for (std::size_t m = 0; m < lines.size(); ++m) {
    EXPECT_NEAR(large[m].scale, kLarger * lines[m].scale, 1e-9);
    EXPECT_NEAR(large[m].arc.back(), kLarger * lines[m].arc.back(), 0.03 * large[m].arc.back());
    for (Eigen::Index i = 0; i < lines[m].line.rows(); ++i)
      EXPECT_LT(nearest_on_line(large[m], kLarger * lines[m].line.row(i).transpose()).distance_m,
                lines[m].name.starts_with("oo_") ? 0.001 : 0.0005)
          << lines[m].name;
  }
}

TEST(MuscleLines, NearestOnALineOfTwoPieces) {
  MuscleLine line;
  line.line.resize(4, 3);
  line.line << 0, 0, 0, 3, 0, 0, 3, 0, 0, 3, 1, 0;  // a piece without length among them
  line.arc = {0, 3, 3, 4};
  OnLine on = nearest_on_line(line, {1, -2, 0});
  EXPECT_DOUBLE_EQ(on.distance_m, 2);
  EXPECT_DOUBLE_EQ(on.share, 0.25);
  EXPECT_EQ(on.tangent, Vec3::UnitX());
  on = nearest_on_line(line, {4, 0.5, 0});
  EXPECT_DOUBLE_EQ(on.distance_m, 1);
  EXPECT_DOUBLE_EQ(on.share, 0.875);
  EXPECT_EQ(on.tangent, Vec3::UnitY());
  EXPECT_DOUBLE_EQ(nearest_on_line(line, {-3, -4, 0}).distance_m, 5);
  EXPECT_EQ(nearest_on_line(line, {-3, -4, 0}).share, 0);
  EXPECT_EQ(nearest_on_line(line, {3, 9, 0}).share, 1);
}

}  // namespace
}  // namespace hyperex::muscles
