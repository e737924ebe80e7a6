// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_shapes.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/fold_pull.hpp"
#include "muscles/a_face.hpp"

namespace hyperex::muscles {
namespace {

class MuscleShapes : public testing::Test {
 protected:
  std::size_t row(const std::string& name) const {
    for (std::size_t m = 0; m < lines_.size(); ++m)
      if (lines_[m].name == name) return m;
    ADD_FAILURE() << name;
    return 0;
  }
  const Points& drawn(const std::string& name) const { return shapes_[row(name)].line; }

  const test::AFace& face_ = test::a_face();
  const std::vector<MuscleLine> lines_ =
      muscle_lines(muscle_template(), face_.mesh, face_.landmarks);
  const std::vector<MuscleShape> shapes_ =
      muscle_shapes(lines_, muscle_template(), face_.mesh, face_.landmarks);
};

TEST_F(MuscleShapes, ASheetSpreadsFromTheOriginAlongThePartOfTheFold) {
  ASSERT_EQ(shapes_.size(), lines_.size());
  int sheets = 0;
  for (std::size_t m = 0; m < lines_.size(); ++m) {
    const TemplateMuscle& muscle = muscle_template()[std::size_t(lines_[m].row)];
    const Points& sheet = shapes_[m].sheet;
    ASSERT_EQ(sheet.rows() > 0, muscle.ends_in_fold()) << lines_[m].name;
    if (sheet.rows() == 0) continue;
    ++sheets;
    EXPECT_EQ(sheet.row(0), lines_[m].line.row(0)) << "the tip";
    const Points fold = nasolabial_fold(face_.mesh, face_.landmarks, lines_[m].left);
    const double last = double(fold.rows() - 1);
    const auto nearest = [&](double share) { return fold.row(Eigen::Index(share * last + 0.5)); };
    const double step = (fold.row(1) - fold.row(0)).norm();
    EXPECT_LT((sheet.row(1) - nearest(muscle.fold_from)).norm(), step) << lines_[m].name;
    EXPECT_LT((sheet.bottomRows<1>() - nearest(muscle.fold_to)).norm(), step) << lines_[m].name;
  }
  EXPECT_EQ(sheets, 8);
}

TEST_F(MuscleShapes, TheHalvesOfARingMeet) {
  for (const char* side : {"_L", "_R"}) {
    const Points& lower = drawn(std::string("orb_oculi_lo") + side);
    const Points& upper = drawn(std::string("orb_oculi_up") + side);
    EXPECT_EQ(lower.row(0), upper.row(0)) << "at the nose";
    EXPECT_EQ(lower.bottomRows<1>(), upper.bottomRows<1>()) << "at the temple";
    const Points& before = lines_[row(std::string("orb_oculi_lo") + side)].line;
    ASSERT_EQ(lower.rows(), before.rows() + 2);
    EXPECT_EQ(lower.middleRows(1, before.rows()), before);
    const double added = (lower.row(0) - lower.row(1)).norm();
    EXPECT_GT(added, 0.002);
    EXPECT_LT(added, 0.0075) << "a half of some 8 mm";
  }
}

/// The mouth's rings meet already, at the corners and, with those of the other side, at the
/// midline.
TEST_F(MuscleShapes, AllOtherLinesAreTheMuscles) {
  const std::set<std::string> led_on = {"orb_oculi_lo_L", "orb_oculi_lo_R", "orb_oculi_up_L",
                                        "orb_oculi_up_R"};
  for (std::size_t m = 0; m < lines_.size(); ++m)
    if (!led_on.contains(lines_[m].name)) {
      EXPECT_EQ(shapes_[m].line, lines_[m].line) << lines_[m].name;
    }
}

}  // namespace
}  // namespace hyperex::muscles
