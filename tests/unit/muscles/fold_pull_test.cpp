// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/fold_pull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "muscles/a_face.hpp"

namespace hyperex::muscles {
namespace {

class FoldPull : public testing::Test {
 protected:
  FoldPull() {
    for (const MuscleLine& line : lines_)
      if (line.name == "zyg_minor_L") line_ = line;
    muscle_ = muscle_template()[std::size_t(line_.row)];
  }
  Points pull() const {
    const Eigen::VectorXd f = fold_pull(line_, muscle_, fold_, face_.mesh, shape_);
    EXPECT_EQ(f.size(), 3 * face_.mesh.volume.nodes.rows());
    return Eigen::Map<const Points>(f.data(), f.size() / 3, 3);
  }
  static double sum(const Points& force) { return force.rowwise().norm().sum(); }

  const test::AFace& face_ = test::a_face();
  const std::vector<MuscleLine> lines_ =
      muscle_lines(muscle_template(), face_.mesh, face_.landmarks);
  const Points fold_ = nasolabial_fold(face_.mesh, face_.landmarks, true);
  MuscleLine line_;
  TemplateMuscle muscle_;
  FoldShape shape_;
};

TEST_F(FoldPull, TheLineRunsOnTheSkinFromBesideTheNoseToBesideTheMouth) {
  const face::FaceFrame frame = face::face_frame(face_.landmarks);
  const SurfaceTree skin(face_.mesh.volume.outer);
  for (const bool left : {true, false}) {
    const Points line = nasolabial_fold(face_.mesh, face_.landmarks, left);
    const auto out_mm = [&](Eigen::Index row, int landmark) {
      return 1e3 * (left ? 1 : -1) *
             frame.x.dot(line.row(row).transpose() - face_.landmarks.at(face::ibug(landmark)));
    };
    EXPECT_NEAR(out_mm(0, left ? 35 : 31), 4.5, 2.5) << "the closest skin is not straight ahead";
    EXPECT_NEAR(out_mm(line.rows() - 1, left ? 54 : 48), 10, 2.5);
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
      EXPECT_LT((skin.query(line.row(i)).point - line.row(i).transpose()).norm(), 1e-9);
      EXPECT_GT((left ? 1 : -1) * frame.local(line.row(i)).x(), 0.01);
      if (i > 0) {
        EXPECT_LT((line.row(i) - line.row(i - 1)).dot(frame.y), 0) << "downwards";
      }
    }
  }
}

/// Of the skin of `a_face()`: the place beside a point of the line that the rule gives, off it by
/// so much outwards and up, mm.
Vec3 beside_fold(double share, double out_mm, double up_mm, bool left) {
  const test::AFace& face = test::a_face();
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  const Points line = nasolabial_fold(face.mesh, face.landmarks, left);
  const Vec3 at = line.row(Eigen::Index(std::lround(share * double(line.rows() - 1))));
  const double out_m = (left ? 1e-3 : -1e-3) * out_mm;
  return SurfaceTree(face.mesh.volume.outer)
      .query(at + out_m * frame.x + 1e-3 * up_mm * frame.y)
      .point;
}

double distance_mm(const Points& line, const Vec3& p) {
  MuscleLine as_muscle;
  as_muscle.line = line;
  as_muscle.arc = arc_of(line);
  return 1e3 * nearest_on_line(as_muscle, p).distance_m;
}

TEST(LineOfTheFold, PassesThroughTheGivenLandmarksOnTheSkin) {
  const test::AFace& face = test::a_face();
  const SurfaceTree skin(face.mesh.volume.outer);
  for (const bool left : {true, false})
    for (const double share : {0.5, 0.35, 0.05}) {
      io::Landmarks landmarks = face.landmarks;
      const auto give = [&](face::FoldPoint point, const Vec3& at) {
        landmarks[face::fold_landmark(point, left)] = at;
        return at;
      };
      const Vec3 upper = give(face::FoldPoint::upper, beside_fold(0, 3, 2, left));
      const Vec3 middle = give(face::FoldPoint::middle, beside_fold(share, 4, 0, left));
      const Vec3 lower = give(face::FoldPoint::lower, beside_fold(1, -4, -3, left));
      const Points line = nasolabial_fold(face.mesh, landmarks, left);
      EXPECT_LT((line.row(0).transpose() - upper).norm(), 1e-9);
      EXPECT_LT((line.row(line.rows() - 1).transpose() - lower).norm(), 1e-9);
      EXPECT_LT(distance_mm(line, middle), 0.3) << share;
      EXPECT_GT(distance_mm(nasolabial_fold(face.mesh, face.landmarks, left), middle), 1.5);
      for (Eigen::Index i = 0; i < line.rows(); ++i)
        EXPECT_LT(skin.query(line.row(i)).squared_distance, 1e-18);
      for (Eigen::Index i = 1; i < line.rows(); ++i)
        EXPECT_LT((line.row(i) - line.row(i - 1)).norm(), 0.006) << "no sharp bend";
    }
}

TEST(LineOfTheFold, HasItsBowFromTheRuleBetweenTwoGivenEnds) {
  const test::AFace& face = test::a_face();
  io::Landmarks landmarks = face.landmarks;
  const Vec3 upper = beside_fold(0, 3, 0, true), lower = beside_fold(1, 3, 0, true);
  landmarks["nasolabial_fold_upper_L"] = upper;
  landmarks["nasolabial_fold_lower_L"] = lower;
  const Points line = nasolabial_fold(face.mesh, landmarks, true);
  EXPECT_LT((line.row(0).transpose() - upper).norm(), 1e-9);
  EXPECT_LT((line.row(line.rows() - 1).transpose() - lower).norm(), 1e-9);
  // Moved outwards with both of its ends.
  EXPECT_LT(distance_mm(line, beside_fold(0.5, 3, 0, true)), 1.5);
}

TEST(LineOfTheFold, LeavesTheOtherSideAndWhatIsNotGiven) {
  const test::AFace& face = test::a_face();
  const Points right = nasolabial_fold(face.mesh, face.landmarks, false),
               left = nasolabial_fold(face.mesh, face.landmarks, true);
  io::Landmarks landmarks = face.landmarks;
  landmarks["nasolabial_fold_upper_L"] = beside_fold(0, 3, 2, true);
  EXPECT_EQ(nasolabial_fold(face.mesh, landmarks, false), right);
  const Points one_end = nasolabial_fold(face.mesh, landmarks, true);
  EXPECT_GT((one_end.row(0) - left.row(0)).norm(), 0.0015);
  EXPECT_EQ(one_end.row(left.rows() - 1), left.row(left.rows() - 1));
  landmarks["nasolabial_fold_middle_L"] = beside_fold(0.5, 4, 0, true);
  landmarks["nasolabial_fold_lower_L"] = beside_fold(1, 4, 0, true);
  EXPECT_EQ(nasolabial_fold(face.mesh, landmarks, false), right);
}

TEST(LineOfTheFold, PlacesWhatIsNotGiven) {
  const test::AFace& face = test::a_face();
  const io::Landmarks all = fold_places(face.mesh, face.landmarks);
  ASSERT_EQ(all.size(), face::optional_landmarks().size());
  for (const bool left : {true, false}) {
    const Points line = nasolabial_fold(face.mesh, face.landmarks, left);
    const auto at = [&](face::FoldPoint point) { return all.at(face::fold_landmark(point, left)); };
    EXPECT_EQ(at(face::FoldPoint::upper), line.row(0).transpose());
    EXPECT_LT(distance_mm(line, at(face::FoldPoint::middle)), 1e-6);
    EXPECT_EQ(at(face::FoldPoint::lower), line.row(line.rows() - 1).transpose());
  }
  io::Landmarks some = face.landmarks;
  some["nasolabial_fold_middle_R"] = all.at("nasolabial_fold_middle_R");
  const io::Landmarks others = fold_places(face.mesh, some);
  EXPECT_EQ(others.size(), all.size() - 1);
  EXPECT_FALSE(others.contains("nasolabial_fold_middle_R"));
}

TEST_F(FoldPull, DrawsTheSkinTowardsTheOriginAndIntoTheTissue) {
  const Points force = pull(), normals = vertex_normals(face_.mesh.volume.outer);
  const double inwards = std::sin(shape_.inwards_deg * std::numbers::pi / 180);
  const Eigen::Index skin = face_.mesh.volume.surface_nodes();
  ASSERT_GT(sum(force), 0);
  EXPECT_EQ(sum(force.bottomRows(force.rows() - skin)), 0) << "of the skin alone";
  for (Eigen::Index v = 0; v < skin; ++v) {
    const double size = force.row(v).norm();
    if (size == 0) continue;
    EXPECT_NEAR(force.row(v).dot(normals.row(v)), -inwards * size, 1e-9 * size);
    EXPECT_GT(force.row(v).dot(line_.line.row(0) - face_.mesh.volume.nodes.row(v)), 0);
  }
}

TEST_F(FoldPull, FallsOffBesideItsPartOfTheLine) {
  const Points force = pull();
  const Eigen::VectorXd areas = node_areas(face_.mesh.volume.outer);
  MuscleLine part;  // between two of the line's points, as the template says
  const auto first = Eigen::Index(std::lround(muscle_.fold_from * double(fold_.rows() - 1)));
  const auto last = Eigen::Index(std::lround(muscle_.fold_to * double(fold_.rows() - 1)));
  part.line = fold_.middleRows(first, last - first + 1);
  part.arc = arc_of(part.line);
  const double width = 1e-3 * shape_.width_mm * line_.scale;
  for (Eigen::Index v = 0; v < areas.size(); ++v) {
    const double distance =
        nearest_on_line(part, face_.mesh.volume.nodes.row(v).transpose()).distance_m;
    const double wanted = areas[v] * std::exp(-std::pow(distance / width, 2));
    // The part ends up to half a step of the whole line away from its point.
    if (force.row(v).norm() > 0 || wanted > 2e-3 * areas[v]) {
      EXPECT_NEAR(force.row(v).norm(), wanted, 0.2 * areas[v]) << v;
    }
  }
  muscle_.fold_from = 0;
  muscle_.fold_to = 1;
  EXPECT_GT(sum(pull()), 1.8 * sum(force)) << "a third is pulled less than the whole";
}

TEST_F(FoldPull, IsNothingForAMuscleThatDoesNotEndThere) {
  muscle_.fold_from = muscle_.fold_to = 0;
  EXPECT_EQ(sum(pull()), 0);
}

}  // namespace
}  // namespace hyperex::muscles
