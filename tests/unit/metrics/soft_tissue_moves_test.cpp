// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/soft_tissue_moves.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "support/test_file.hpp"

namespace hyperex::metrics {
namespace {
using simulate::BoneMove;
using simulate::BonePart;

class SoftTissueMoves : public testing::Test {
 protected:
  /// Two samples: rest and the peak, at which every landmark has moved by `expression_mm`; all are
  /// shifted by `surgery_mm`. Both are along the axes of the face.
  simulate::Performance face(const Vec3& surgery_mm, const Vec3& expression_mm) const {
    simulate::Performance out;
    out.peak_frame = 1;
    out.landmarks.time_s = {0, 1};
    out.landmarks.positions.assign(2, Points(Eigen::Index(landmarks_.size()), 3));
    const auto world = [&](const Vec3& mm) -> Vec3 {
      return 1e-3 * (mm.x() * frame_.x + mm.y() * frame_.y + mm.z() * frame_.z);
    };
    Eigen::Index row = 0;
    for (const auto& [name, at] : landmarks_) {
      out.landmarks.names.push_back(name);
      out.landmarks.positions[0].row(row) = at + world(surgery_mm);
      out.landmarks.positions[1].row(row++) = at + world(surgery_mm + expression_mm);
    }
    return out;
  }
  std::vector<SoftTissueMove> moves(const std::vector<BoneMove>& bones,
                                    const Vec3& surgery_mm) const {
    return soft_tissue_moves(face(Vec3::Zero(), {1, 2, 3}), face(surgery_mm, {1, 1, 3}), landmarks_,
                             bones);
  }
  static const SoftTissueMove& of(const std::vector<SoftTissueMove>& all, const std::string& name) {
    for (const SoftTissueMove& one : all)
      if (one.landmark == name) return one;
    throw std::out_of_range(name);
  }

  const io::Landmarks landmarks_ = anatomy::embedded_face().landmarks;
  const face::FaceFrame frame_ = face::face_frame(landmarks_);
};

TEST_F(SoftTissueMoves, AreAlongTheAxesOfTheFace) {
  const auto all = moves({{.part = BonePart::mandible, .move_m = {0, 0, 0.006}}}, {0.5, -0.2, 4.8});
  ASSERT_EQ(all.size(), 10u);
  for (const SoftTissueMove& one : all) {
    EXPECT_LT((one.at_rest - Vec3(0.5, -0.2, 4.8)).norm(), 1e-9);
    EXPECT_LT((one.expression_before - Vec3(1, 2, 3)).norm(), 1e-9);
    EXPECT_LT((one.expression_after - Vec3(1, 1, 3)).norm(), 1e-9);
  }
}

TEST_F(SoftTissueMoves, StandBesideThePublishedRatios) {
  const auto forward = moves({{.part = BonePart::mandible, .move_m = {0, 0, 0.006}}}, {0, 0, 4.8});
  ASSERT_TRUE(of(forward, "pogonion").published);
  EXPECT_NEAR(of(forward, "pogonion").ratio, 0.8, 1e-9);
  EXPECT_EQ(of(forward, "pogonion").published->usual, 1.0);
  EXPECT_FALSE(of(forward, "subnasale").published) << "of the mandible none is published there";
  const auto back = moves({{.part = BonePart::mandible, .move_m = {0, 0, -0.005}}}, {0, 0, -4});
  EXPECT_NEAR(of(back, "pogonion").ratio, 0.8, 1e-9);
  EXPECT_EQ(of(back, "pogonion").published->usual, 0.95) << "setback has its own";
  const auto impacted = moves({{.part = BonePart::maxilla, .move_m = {0, 0.004, 0}}}, {0, 1, 0.5});
  EXPECT_NEAR(of(impacted, "subnasale").ratio, 0.25, 1e-9);
}

TEST_F(SoftTissueMoves, HaveNoRatioWhereTwoSegmentsMoveAlongOneAxis) {
  const auto both = moves({{.part = BonePart::mandible, .move_m = {0, 0, 0.006}},
                           {.part = BonePart::mandible, .move_m = {0, 0, 0.003}}},
                          {0, 0, 8});
  EXPECT_FALSE(of(both, "pogonion").published);
  EXPECT_TRUE(std::isnan(of(both, "pogonion").ratio));
  const auto aside = moves({{.part = BonePart::mandible, .move_m = {0, 0, 0.006}},
                            {.part = BonePart::maxilla, .move_m = {0, 0.003, 0}}},
                           {0, 1, 5});
  EXPECT_TRUE(of(aside, "pogonion").published) << "along another axis";
}

TEST_F(SoftTissueMoves, AreWrittenAsATable) {
  const auto all = moves({{.part = BonePart::chin, .move_m = {0, 0, 0.006}}}, {0, 0, 4.5});
  const std::filesystem::path file = test_file("surgery.csv");
  write_soft_tissue_csv(file, all);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const auto columns = std::ranges::count(line, ',');
  EXPECT_EQ(columns, 13);
  while (std::getline(in, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), columns) << line;
    if (line.starts_with("pogonion,")) {
      EXPECT_THAT(line, testing::EndsWith(",0.750,0.900,0.570,1.050"));
    }
  }
  const auto json = json_of(all);
  ASSERT_EQ(json.size(), 10u);
  EXPECT_THAT(json.dump(), testing::HasSubstr("Gupta and Schendel"));
}

TEST(ChangeOfVolume, IsThatBetweenTheSkins) {
  simulate::Performance before, after;
  // A closed surface, of which every place moves outwards by a tenth of its distance: 1.1^3 times.
  TriMesh& skin = before.skin_rest;
  skin.points = Points{{0, 0, 0}, {0.02, 0, 0}, {0, 0.03, 0}, {0, 0, 0.04}};
  skin.triangles = Triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  after.skin_rest = skin;
  after.neutral_displacement_m = (0.1 * skin.points).cast<float>();
  const double volume_ml = 1e6 * 0.02 * 0.03 * 0.04 / 6;
  EXPECT_NEAR(change_of_volume_ml(before, after), (std::pow(1.1, 3) - 1) * volume_ml, 1e-6);
  EXPECT_NEAR(change_of_volume_ml(after, before), (1 - std::pow(1.1, 3)) * volume_ml, 1e-6);
  EXPECT_NEAR(greatest_change_at_rest_mm(before, after), 4, 1e-5);
  EXPECT_EQ(change_of_volume_ml(before, before), 0);
}

}  // namespace
}  // namespace hyperex::metrics
