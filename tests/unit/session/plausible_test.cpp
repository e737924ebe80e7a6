// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/plausible.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/idle_keys.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
using test::is_about;
using test::is_note;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;

/// One triangle of the simulated skin, `off_m` above a vertex of the scan at its centre.
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
  const SkinOff off = skin_off_scan(skin_off_by(0.009), landmarks);
  EXPECT_NEAR(off.distance_mm, 9, 1e-9);
  EXPECT_EQ(off.landmark, "alare_L");
  EXPECT_THAT(skin_warning(off),
              Optional(AllOf(is_warning("skin.far_from_scan"), is_about("mesh.element_size_mm"),
                             says("9.0 mm"), says("10 mm from alare_L (wing of the nose, left)"),
                             says("Figures of driven points stay as recorded"))));
  EXPECT_EQ(skin_warning(skin_off_scan(skin_off_by(0.004), landmarks)), std::nullopt);
}

TEST(SkinWarning, LeavesEarsAndNeckAside) {
  EXPECT_EQ(skin_off_scan(skin_off_by(0.009), {{"ibug68_16", {0.01, 0.05, 0}}}).distance_mm, 0);
  EXPECT_EQ(skin_warning(skin_off_scan(skin_off_by(0.009), {})), std::nullopt);
}

const std::filesystem::path kData = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";

/// The samples from `first` to the end, or all of them in reverse order.
motion::Motion cut(motion::Motion m, std::size_t first) {
  m.time_s.erase(m.time_s.begin(), m.time_s.begin() + long(first));
  m.positions.erase(m.positions.begin(), m.positions.begin() + long(first));
  return m;
}
motion::Motion backwards(motion::Motion m) {
  std::reverse(m.positions.begin(), m.positions.end());
  return m;
}

TEST(AverageFace, TellsHowRealRecordingsStart) {
  if (!std::filesystem::exists(kData)) GTEST_SKIP() << "the shared recordings are not here";
  const auto read = [](const std::string& file) {
    return motion::stabilise(motion::read_motion(kData / file)).motion;
  };
  const FaceAtRest average = average_face();
  const auto start = [&](const motion::Motion& m) { return start_warning(m, average, false); };
  const auto smile = read("real/spacetime/smile_mm.csv"),
             opening = read("rgbd/subject_A_mouth_open/truth_landmarks68_camera_m.csv"),
             talk = read("rgbd/subject_A_talk/truth_landmarks68_camera_m.csv");
  for (const auto& good : {smile, opening, talk}) EXPECT_EQ(start(good), std::nullopt);
  for (const auto& late : {backwards(smile), cut(opening, 40)})
    EXPECT_THAT(start(late), Optional(AllOf(is_warning("recording.starts_in_expression"),
                                            is_about("motion.rest_s"), says("an average face"))));
  EXPECT_EQ(start_warning(backwards(smile), average, true), std::nullopt) << "weights know rest";
  for (const auto& whole : {smile, opening, talk}) EXPECT_TRUE(extent_warnings(whole).empty());
  EXPECT_THAT(extent_warnings(backwards(smile)),
              testing::ElementsAre(AllOf(is_warning("recording.starts_in_expression"),
                                         says("so give a recording that begins at rest"))));
  const motion::Motion half = motion::until(smile, 0.65, "end_s");
  EXPECT_THAT(extent_warnings(half),
              testing::ElementsAre(AllOf(is_warning("recording.ends_in_expression"),
                                         says("in the last sample, and is still on its way"))));
  for (auto exchanged : {smile, opening, talk}) {
    EXPECT_NO_THROW(check_sides(exchanged, average));
    for (Points& sample : exchanged.positions) sample.col(0) *= -1;
    EXPECT_THROW(check_sides(exchanged, average), InputError);
  }
}

TEST(EndWarning, NamesThePointAndItsWay) {
  motion::Motion m;
  m.names = {"ibug68_48"};
  for (int k = 0; k < 24; ++k) {
    m.time_s.push_back(k / 30.0);
    m.positions.emplace_back((Points(1, 3) << 0, 1e-5 * k * k, 0).finished());
  }
  EXPECT_THAT(end_warning(m),
              Optional(AllOf(is_warning("recording.ends_in_expression"), is_about("motion.file"),
                             says("(5.3 mm)"), says("ibug68_48 (corner of the mouth, right)"),
                             says("may not be complete"))));
  EXPECT_THAT(extent_warnings(m), testing::ElementsAre(is_warning("recording.ends_in_expression")));
  m.positions.back() = m.positions[21];
  EXPECT_THAT(end_warning(m), Optional(says("0.03 s before the end")));
  for (Points& at : m.positions) at *= 0.3;
  EXPECT_EQ(end_warning(m), std::nullopt);
}

TEST(MisfitWarning, DependsOnHowManyPointsAreCommon) {
  using enum PointsOf;
  const auto warned = [](double rms_mm, std::size_t common, PointsOf points, double scale = 1) {
    return misfit_warning({rms_mm, scale, common}, "mm (as stated)", points).has_value();
  };
  EXPECT_TRUE(warned(5.1, 20, person));
  EXPECT_FALSE(warned(4.9, 20, person));
  EXPECT_FALSE(warned(9.9, 19, person)) << "few points say less";
  EXPECT_TRUE(warned(10.1, 19, person));
  EXPECT_FALSE(warned(9.9, 68, model)) << "a model's face is nobody's";
  EXPECT_TRUE(warned(10.1, 68, model));
  for (const PointsOf loose : {camera, model}) {
    EXPECT_TRUE(warned(1, 68, loose, 0.79));
    EXPECT_TRUE(warned(1, 68, loose, 1.26));
    EXPECT_FALSE(warned(1, 68, loose, 1.24));
  }
}

// 2.3 mm rms at a scale of 0.933: the smile of one person on the scan of another, by seven points.
TEST(MisfitWarning, KnowsAnotherPersonByTheSize) {
  const auto warning = [](double rms_mm, double scale) {
    return misfit_warning({rms_mm, scale, 7}, "mm (as stated)", PointsOf::person);
  };
  EXPECT_THAT(warning(2.3, 0.933),
              Optional(AllOf(is_warning("recording.fits_badly"), says("a scale of 0.933"),
                             says("0.95 to 1.05"), says("both are of one person"))));
  EXPECT_NE(warning(2.3, 1.06), std::nullopt);
  for (const double own : {0.96, 0.982, 1.007, 1.04}) EXPECT_EQ(warning(1, own), std::nullopt);
}

TEST(MisfitWarning, IsAboutTheSizeWhereThePointsFit) {
  const auto text = [](double rms_mm, double scale) {
    return misfit_warning({rms_mm, scale, 68}, "mm (as stated)", PointsOf::person).value().text;
  };
  EXPECT_THAT(text(1.5, 10),
              AllOf(HasSubstr("has not the size of the scan: it fits at a scale of 10.000 "
                              "(expected: 0.95 to 1.05)"),
                    HasSubstr("1.5 mm rms"), HasSubstr("as if in cm"), Not(HasSubstr("badly")),
                    Not(HasSubstr("under 5 mm"))));
  EXPECT_THAT(text(1.5, 1.25), HasSubstr("has not the size of the scan"));
  for (const double scale : {1.0, 1.25})
    EXPECT_THAT(text(5.5, scale), AllOf(HasSubstr("fits the scan badly"), HasSubstr("under 5 mm")));
}

/// Six points, one of them off by less than what shows which is wrong.
TEST(ExchangedWarning, SaysHowFarAPointIsOffWhereNoExchangeHelps) {
  const io::Landmarks landmarks = {
      {"ibug68_36", {-0.05, 0.05, 0}},      {"ibug68_45", {0.05, 0.05, 0}},
      {"ibug68_39", {-0.018, 0.05, 0.01}},  {"ibug68_42", {0.018, 0.05, 0.01}},
      {"ibug68_48", {-0.012, -0.05, 0.01}}, {"ibug68_54", {0.012, -0.05, 0.01}}};
  motion::Motion m;
  m.time_s = {0};
  m.positions.emplace_back(Eigen::Index(landmarks.size()), 3);
  for (const auto& [name, at] : landmarks) {
    m.positions[0].row(Eigen::Index(m.names.size())) = at.transpose();
    m.names.push_back(name);
  }
  const FaceAtRest face{landmarks, "the face"};
  EXPECT_EQ(exchanged_warning(m, face), std::nullopt);
  m.positions[0].row(m.index_of("ibug68_54")) += Eigen::RowVector3d(-0.025, 0.014, 0);
  EXPECT_NO_THROW(check_pairs(m, face));
  EXPECT_THAT(exchanged_warning(m, face),
              Optional(AllOf(is_warning("sides.exchanged_pair"),
                             says("ibug68_48 and ibug68_54 (corner of the mouth): ibug68_54 lies"),
                             says("mm from its place"), says("would not bring both"))));
}

TEST(RescaledNote, SaysInWhoseMillimetresResultsAre) {
  EXPECT_THAT(rescaled_note(0.931),
              Optional(AllOf(is_note("recording.rescaled"), says("in millimetres of the scan"),
                             says("they are 1.074 times as large"))));
  EXPECT_NE(rescaled_note(1.031), std::nullopt);
  EXPECT_EQ(rescaled_note(1.029), std::nullopt);
  EXPECT_EQ(rescaled_note(0.971), std::nullopt);
}

TEST(MisfitWarning, NamesTheUnitWhoseScaleItIs) {
  const auto text = [](double scale, const std::string& unit_note) {
    return misfit_warning({0.1, scale, 68}, unit_note, PointsOf::person).value().text;
  };
  EXPECT_THAT(text(10, "mm (as the columns say)"),
              AllOf(HasSubstr("as if in cm, and were read as mm (as the columns say)"),
                    Not(HasSubstr("one person"))));
  EXPECT_THAT(text(9.6, "mm (as stated)"), HasSubstr("as if in cm"));
  EXPECT_THAT(text(1040, "mm (as the file says)"), HasSubstr("as if in m,"));
  EXPECT_THAT(text(0.1, "cm (as stated)"), HasSubstr("as if in mm"));
  EXPECT_THAT(text(100, "cm (as stated)"), HasSubstr("as if in m,"));
  EXPECT_THAT(
      text(25.6, "mm (as stated)"),
      HasSubstr("as if in inches, and were read as mm (as stated): give them in mm, cm or m"));
  EXPECT_THAT(text(2.54, "cm (guessed)"), HasSubstr("as if in inches"));
  for (const auto& [scale, unit_note] : {std::pair{9.4, "mm (as stated)"},
                                         {10.0, "cm (as stated)"},
                                         {10.0, "cm, mm (as the columns say)"},
                                         {10.0, ""}})
    EXPECT_THAT(text(scale, unit_note), AllOf(HasSubstr("one person"), Not(HasSubstr("as if"))));
}

TEST(IdleLawWarning, NamesKeysOfFiniteStrainWhereNothingHasIt) {
  Scene scene;
  EXPECT_EQ(idle_law_warning(scene), std::nullopt);
  scene.origins["tissue.law"] = {};
  scene.origins["tissue.maxwell"] = {};
  EXPECT_THAT(idle_law_warning(scene),
              Optional(AllOf(is_warning("law.idle"), says(": tissue.law, tissue.maxwell"))));
  Variant variant;
  variant.scene.model.strain = simulate::Strain::finite;
  scene.variants.push_back(variant);
  EXPECT_EQ(idle_law_warning(scene), std::nullopt);
  scene.variants.clear();
  scene.model.strain = simulate::Strain::finite;
  EXPECT_EQ(idle_law_warning(scene), std::nullopt);
}

}  // namespace
}  // namespace hyperex::session
