// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/report/face_backing.hpp"
#include "support/test_file.hpp"
#include "unit/report/made_up_face.hpp"
#include "unit/report/page_reader.hpp"

namespace hyperex::report {
namespace {

using nlohmann::json;
using testing::element;
using testing::from_base64;
using testing::made_up_face;
using testing::MadeUpFace;
using testing::stretch;
using testing::Surface;

std::string written(const MadeUpFace& face, const DisplacementModes& modes, std::string title = "t",
                    json summary = json::object()) {
  const auto file = test_file("report_test.html");
  write_html_report(file, {face.performance,
                           face.scan,
                           modes,
                           &face.symmetry,
                           std::move(summary),
                           {"a note"},
                           std::move(title)});
  return read_file(file);
}

/// A mode's values, of which small ones take a byte.
std::vector<int> steps_of(const std::vector<std::uint8_t>& bytes, const json& at) {
  std::vector<int> steps;
  if (at.at("type") == "int8") {
    const auto values = stretch<std::int8_t>(bytes, at);
    steps.assign(values.begin(), values.end());
  } else {
    const auto values = stretch<std::int16_t>(bytes, at);
    steps.assign(values.begin(), values.end());
  }
  return steps;
}

TEST(HtmlReport, HoldsTheMotionWithinToleranceAndQuantisation) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const std::string page = written(face, modes);
  const json manifest = json::parse(element(page, "hyperex-manifest"));
  const auto bytes = from_base64(element(page, "hyperex-binary"));
  const auto& motion = manifest.at("motion");
  const auto weights = stretch<float>(bytes, motion.at("weights"));
  const std::size_t count = motion.at("modes").size();
  ASSERT_EQ(count, modes.modes.size());
  double worst = 0;
  for (std::size_t f = 0; f < face.performance.frame_time_s.size(); ++f) {
    PointsF sum = PointsF::Zero(face.performance.skin_rest.points.rows(), 3);
    for (std::size_t k = 0; k < count; ++k) {
      const auto values = steps_of(bytes, motion["modes"][k].at("values"));
      const float factor = weights[f * count + k] * motion["modes"][k].at("step_m").get<float>();
      for (Eigen::Index i = 0; i < sum.size(); ++i) sum.data()[i] += factor * values[i];
    }
    const PointsF error = sum - face.performance.skin_displacement_m[f];
    worst = std::max<double>(worst, error.rowwise().norm().maxCoeff());
  }
  EXPECT_LT(worst, 2.2e-5);
  // A mode of a tenth of a millimetre takes bytes.
  PointsF small = modes.modes[0] * (1e-4F / modes.modes[0].cwiseAbs().maxCoeff());
  DisplacementModes faint{{small}, modes.weights.leftCols(1), 0};
  const json other = json::parse(element(written(face, faint), "hyperex-manifest")).at("motion");
  EXPECT_EQ(other["modes"][0]["values"]["type"], "int8");
  EXPECT_EQ(motion["modes"][0]["values"]["type"], "int16");
  EXPECT_LT(other["modes"][0]["step_m"].get<double>(), 2e-6);
  EXPECT_NEAR(motion.at("max_displacement_mm").get<double>(),
              1e3 * face.performance.skin_displacement_m[15].rowwise().norm().maxCoeff(), 1e-6);
  const auto triangles = stretch<int>(bytes, manifest.at("skin").at("triangles"));
  EXPECT_TRUE(
      std::equal(triangles.begin(), triangles.end(), face.performance.skin_rest.triangles.data()));
  EXPECT_EQ(manifest.at("symmetry").at("s").size(), face.symmetry.s.size());
  EXPECT_EQ(manifest.at("lip_cut").size(),
            static_cast<std::size_t>(face.performance.lip_cut_rest.rows()));
}

TEST(HtmlReport, HoldsVariantsAsTheirDifferenceFromTheSceneItself) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  std::vector<testing::MadeUpVariant> made;
  for (int i = 0; i < testing::made_up_variants; ++i) made.push_back(made_up_variant(face, i));
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  input.tissue = testing::made_up_tissue(face);
  for (const auto& variant : made) input.variants.push_back(reported(face, variant));
  const auto mirror = testing::made_up_mirror(face);
  input.mirror = &mirror;
  const auto file = test_file("report_variants_test.html");
  write_html_report(file, input);
  const std::string page = read_file(file);
  const json variants = json::parse(element(page, "hyperex-manifest")).at("variants");
  const auto bytes = from_base64(element(page, "hyperex-binary"));
  ASSERT_EQ(variants.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto& difference = variants[i].at("difference");
    const auto& shown = made[i].face.performance;
    const auto weights = stretch<float>(bytes, difference.at("weights"));
    const std::size_t count = difference.at("modes").size(), f = 15;
    PointsF sum = face.performance.skin_displacement_m[f];
    for (std::size_t k = 0; k < count; ++k) {
      const auto values = steps_of(bytes, difference["modes"][k].at("values"));
      const float factor =
          weights[f * count + k] * difference["modes"][k].at("step_m").get<float>();
      for (Eigen::Index j = 0; j < sum.size(); ++j) sum.data()[j] += factor * values[j];
    }
    EXPECT_LT((sum - shown.skin_displacement_m[f]).rowwise().norm().maxCoeff(), 2.2e-5);
    EXPECT_NEAR(variants[i].at("max_displacement_mm").get<double>(),
                1e3 * shown.skin_displacement_m[f].rowwise().norm().maxCoeff(), 1e-6);
    const std::size_t most = variants[i].at("max_difference_frame");
    EXPECT_NEAR(variants[i].at("max_difference_mm").get<double>(),
                1e3 * (shown.skin_displacement_m[most] - face.performance.skin_displacement_m[most])
                          .rowwise()
                          .norm()
                          .maxCoeff(),
                1e-6);
    const auto& map = variants[i].at("tissue").at(0);
    const auto steps = stretch<std::uint8_t>(bytes, map.at("values"));
    const double step = (map["greatest"].get<double>() - map["least"].get<double>()) / 255;
    for (std::size_t v = 0; v < steps.size(); ++v)
      ASSERT_NEAR(map["least"].get<double>() + step * steps[v],
                  made[i].tissue[0].values[Eigen::Index(v)], 0.51 * step);
  }
  const json counterparts = json::parse(element(page, "hyperex-manifest")).at("mirror");
  const auto twin = stretch<int>(bytes, counterparts.at("vertices"));
  const auto share = stretch<std::uint8_t>(bytes, counterparts.at("weights"));
  EXPECT_EQ(twin.at(0), 40);
  EXPECT_EQ(share.at(0), 255);
  EXPECT_EQ(share.at(1), 0);
  EXPECT_EQ(twin.back(), -1) << "what the cut added has none";
  EXPECT_TRUE(variants[4].at("difference").at("modes").empty());
  EXPECT_EQ(variants[4].at("max_difference_mm"), 0);
  EXPECT_EQ(variants[4].at("max_difference_frame"), 0);
  input.variants[0].tissue.clear();
  EXPECT_THROW(write_html_report(file, input), std::invalid_argument);
}

TEST(HtmlReport, HoldsTheExpectedErrorOfTheSkin) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  const auto file = test_file("report_uncertainty_test.html");
  write_html_report(file, input);
  EXPECT_FALSE(json::parse(element(read_file(file), "hyperex-manifest")).contains("uncertainty"));
  const Eigen::Index vertices = face.performance.skin_rest.points.rows();
  input.uncertainty = {.key = "uncertainty",
                       .name = "Expected error",
                       .unit = "mm",
                       .greatest = 5,
                       .values = Eigen::VectorXd::LinSpaced(vertices, 0, 5)};
  write_html_report(file, input);
  const std::string page = read_file(file);
  const json map = json::parse(element(page, "hyperex-manifest")).at("uncertainty");
  EXPECT_EQ(map.at("unit"), "mm");
  const auto bytes =
      stretch<std::uint8_t>(from_base64(element(page, "hyperex-binary")), map.at("values"));
  ASSERT_EQ(Eigen::Index(bytes.size()), vertices);
  for (std::size_t v = 0; v < bytes.size(); ++v)
    ASSERT_NEAR(map.at("greatest").get<double>() * bytes[v] / 255,
                input.uncertainty.values[Eigen::Index(v)], 0.01);
  input.uncertainty.values.conservativeResize(vertices - 1);
  EXPECT_THROW(write_html_report(file, input), std::invalid_argument);
}

TEST(HtmlReport, HoldsWhatMusclesDoBySide) {
  auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  const auto file = test_file("report_muscles_test.html");
  const auto manifest = [&] {
    write_html_report(file, input);
    return json::parse(element(read_file(file), "hyperex-manifest"));
  };
  EXPECT_FALSE(manifest().contains("muscles"));
  simulate::MuscleCourse& muscles = face.performance.muscles;
  muscles.names = {"zyg_major_L", "zyg_major_R"};
  muscles.time_s = {0, 0.1, 0.2};
  muscles.groups = {"eye closers_R", "elevators_L", "elevators_R"};
  muscles.group_activation.resize(3, 3);
  muscles.group_activation << 0, 9, 9, 0, 0.5, 0.25, 0, -0.12345, -0.5;
  muscles.group_sigma.resize(3, 3);
  muscles.group_sigma << 7, 8, 9, 1, 2, 3, 4, 5, 6;
  muscles.group_prior_sigma.resize(3, 3);
  muscles.group_prior_sigma << 8, 9, 10, 9, 9, 9, 7, 7, 7;
  muscles.activation.resize(2, 3);
  muscles.activation << 0, 0.5, 0.25, 0, 0.1, -0.5;
  muscles.sigma.setConstant(2, 3, 0.2);
  Points line(2, 3);
  line << 1, 2, 3, 4, 5, 6;
  Points sheet(3, 3);
  sheet << 7, 8, 9, 1, 1, 1, 2, 2, 2;
  input.muscles = {{"zyg_major_L", "zygomaticus major", line, sheet},
                   {"zyg_major_R", "zygomaticus major", line},
                   {"graft_L", "graft", line}};
  const json shown = manifest().at("muscles");
  EXPECT_EQ(shown.at("time_s").dump(), "[0.0,0.1,0.2]");
  EXPECT_EQ(shown.at("few_points"), true);
  ASSERT_EQ(shown.at("groups").size(), 1u) << "of both sides alone";
  const json& group = shown["groups"][0];
  EXPECT_EQ(group.at("name"), "elevators");
  EXPECT_EQ(group.at("left").dump(), "[0.0,0.5,0.25]");
  EXPECT_EQ(group.at("right").dump(), "[0.0,-0.1235,-0.5]");
  EXPECT_EQ(group.at("sigma_left"), 2) << "where it acts most";
  EXPECT_EQ(group.at("sigma_right"), 6);
  EXPECT_EQ(group.at("note_left"), "") << "2 of 9";
  EXPECT_EQ(group.at("note_right"), "mostly the prior's choice") << "6 of 7";
  EXPECT_EQ(shown.at("lines")[0].at("name"), "zyg_major_L");
  EXPECT_EQ(shown.at("lines")[0].at("latin"), "zygomaticus major");
  EXPECT_EQ(shown.at("lines")[0].at("points").dump(), "[[1.0,2.0,3.0],[4.0,5.0,6.0]]");
  EXPECT_EQ(shown.at("lines")[0].at("sheet").dump(), "[[7.0,8.0,9.0],[1.0,1.0,1.0],[2.0,2.0,2.0]]");
  EXPECT_FALSE(shown.at("lines")[1].contains("sheet"));
  EXPECT_EQ(shown.at("active"), json({"010", "001", ""}))
      << "0.5 is 2.5 standard deviations from 0, 0.25 is 1.25";
  const std::vector<PointsF> none(face.performance.skin_displacement_m.size(),
                                  PointsF::Zero(face.performance.skin_rest.points.rows(), 3));
  input.variants.push_back({.name = "weak",
                            .changes = {},
                            .performance = face.performance,
                            .difference = displacement_modes(none),
                            .tissue = {}});
  EXPECT_EQ(manifest().at("variants")[0].at("muscles").dump(), "[]") << "not known";
  input.variants[0].group_activation = Eigen::MatrixXd::Constant(3, 3, 0.5);
  input.variants[0].group_activation.row(1) << 0, 0.1, 0.2;
  EXPECT_EQ(manifest().at("variants")[0].at("muscles").dump(),
            "[{\"left\":[0.0,0.1,0.2],\"right\":[0.5,0.5,0.5]}]");
  EXPECT_EQ(manifest().at("variants")[0].at("active_muscles"), json({"010", "001", ""}));
  simulate::Performance other = face.performance;
  other.muscles.time_s.back() = 0.3;
  ReportInput with_other = input;
  with_other.variants.clear();
  with_other.variants.push_back({.name = "other times",
                                 .changes = {},
                                 .performance = other,
                                 .difference = displacement_modes(none),
                                 .tissue = {}});
  BinaryBlock block;
  EXPECT_EQ(replay_manifest(with_other, block, false).at("variants")[0].at("active_muscles"),
            json::array());
  face.performance.driven_names.assign(33, "p");
  face.performance.driven_points_rest = Points::Zero(33, 3);
  EXPECT_EQ(manifest().at("muscles").at("few_points"), true) << "as the fit took them";
  muscles.few_points = false;
  EXPECT_EQ(manifest().at("muscles").at("few_points"), false);
}

TEST(HtmlReport, HoldsTheUpperTeethWhereSurgeryPutThem) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const auto teeth = testing::made_up_teeth();
  auto variant = made_up_variant(face, 0);
  variant.face.performance.upper_teeth_now_from_rest.translation() = Vec3(0.001, -0.002, 0.005);
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  input.tissue = testing::made_up_tissue(face);
  input.variants.push_back(reported(face, variant));
  input.teeth = &teeth;
  BinaryBlock block;
  const json manifest = replay_manifest(input, block, false);
  EXPECT_TRUE(manifest.at("motion").at("upper_teeth").is_null());
  EXPECT_EQ(manifest.at("variants").at(0).at("upper_teeth"),
            json({0, 0, 0, 1, 0.001, -0.002, 0.005}));
}

TEST(HtmlReport, HoldsTheGazeInEachFrame) {
  auto face = made_up_face(Surface::plain);
  testing::add_inner_eye_corners(face.performance);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  BinaryBlock none;
  EXPECT_FALSE(replay_manifest(input, none, false).at("motion").contains("gaze"));
  face.performance.gaze.resize(face.performance.frame_time_s.size());
  face.performance.gaze[15].left.left_rad = 0.3;
  const auto file = test_file("report_gaze_test.html");
  write_html_report(file, input);
  const std::string page = read_file(file);
  const json manifest = json::parse(element(page, "hyperex-manifest"));
  const auto values = stretch<float>(from_base64(element(page, "hyperex-binary")),
                                     manifest.at("motion").at("gaze"));
  ASSERT_EQ(values.size(), 31u * 8);
  const auto turn = [&](std::size_t frame, std::size_t side) {
    const float* at = values.data() + 8 * frame + 4 * side;  // x y z w
    return Eigen::Quaternionf(at[3], at[0], at[1], at[2]);
  };
  const json& eye = manifest.at("eyeballs").at(1).at("gaze");
  const Eigen::Vector3f ahead(eye[0], eye[1], eye[2]);
  EXPECT_NEAR((turn(15, 1) * ahead).x(), std::sin(0.3), 1e-3) << "the subject's left is +x";
  EXPECT_NEAR(turn(15, 0).w(), 1, 1e-6) << "the right eye";
  EXPECT_NEAR(turn(14, 1).w(), 1, 1e-6) << "the frame before";
  face.performance.gaze.pop_back();
  EXPECT_THROW(write_html_report(file, input), std::invalid_argument);
}

TEST(HtmlReport, TakesTheBackingThatTheCallerHas) {
  auto face = made_up_face(Surface::plain);
  testing::add_inner_eye_corners(face.performance);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  const auto eyeballs = [&] {
    BinaryBlock block;
    return replay_manifest(input, block).at("eyeballs").size();
  };
  EXPECT_EQ(eyeballs(), 2u) << "it is made";
  const FaceBacking none;
  input.backing = &none;
  EXPECT_EQ(eyeballs(), 0u);
}

TEST(HtmlReport, HoldsTeethAndTheJawsPlaces) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const auto teeth = testing::made_up_teeth();
  const auto variant = made_up_variant(face, 0);
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  input.tissue = testing::made_up_tissue(face);
  input.variants.push_back(reported(face, variant));
  input.teeth = &teeth;
  const auto file = test_file("report_teeth_test.html");
  write_html_report(file, input);
  const std::string page = read_file(file);
  const json manifest = json::parse(element(page, "hyperex-manifest"));
  const auto bytes = from_base64(element(page, "hyperex-binary"));
  ASSERT_EQ(manifest.at("teeth").size(), 5u);
  EXPECT_EQ(manifest["teeth"][4].at("part"), "tongue");
  EXPECT_EQ(manifest["teeth"][4].at("jaw"), "lower");
  const json& row = manifest["teeth"][2];
  EXPECT_EQ(row.at("jaw"), "lower");
  EXPECT_EQ(row.at("part"), "crowns");
  const auto steps = stretch<std::int16_t>(bytes, row.at("points").at("values"));
  const Points& points = teeth.lower.crowns.points;
  ASSERT_EQ(steps.size(), std::size_t(points.size()));
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_NEAR(
        row["middle"][i % 3].get<double>() + row["points"]["step_m"].get<double>() * steps[i],
        points.data()[i], 1e-6);
  const auto corners = stretch<std::int16_t>(bytes, row.at("triangles"));
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), teeth.lower.crowns.triangles.data(),
                         teeth.lower.crowns.triangles.data() + corners.size()));
  for (const json* jaw : {&manifest["motion"]["jaw"], &manifest["variants"][0]["jaw"]}) {
    const auto values = stretch<float>(bytes, *jaw);
    ASSERT_EQ(values.size(), 31u * 7);
    const float* peak = values.data() + 7 * 15;
    const Eigen::Quaternionf turn(peak[3], peak[0], peak[1], peak[2]);
    const Eigen::Isometry3d& wanted = face.performance.jaw_now_from_rest[15];
    EXPECT_LT((turn.toRotationMatrix() - wanted.linear().cast<float>()).norm(), 1e-6);
    EXPECT_NEAR(peak[6], wanted.translation().z(), 1e-7);
  }
  const json without = json::parse(element(written(face, modes), "hyperex-manifest"));
  EXPECT_FALSE(without.contains("teeth"));
  EXPECT_FALSE(without.at("motion").contains("jaw"));
  auto torn = face.performance;
  torn.jaw_now_from_rest.pop_back();
  ReportInput bad{torn, face.scan, modes, &face.symmetry};
  bad.teeth = &teeth;
  EXPECT_THROW(write_html_report(file, bad), std::invalid_argument);
}

TEST(HtmlReport, DescribesThePocketsThatHangOnTheSkin) {
  const auto face = made_up_face(Surface::plain);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const auto teeth = testing::made_up_teeth();
  ReportInput input{face.performance, face.scan, modes, &face.symmetry};
  input.teeth = &teeth;
  const auto file = test_file("report_openings_test.html");
  write_html_report(file, input);
  const std::string page = read_file(file);
  const json manifest = json::parse(element(page, "hyperex-manifest"));
  const auto bytes = from_base64(element(page, "hyperex-binary"));
  const auto openings = face_backing(face.performance, &teeth).openings;
  ASSERT_EQ(manifest.at("openings").size(), openings.size());
  for (std::size_t o = 0; o < openings.size(); ++o) {
    const json& reported = manifest["openings"][o];
    const Opening& opening = openings[o];
    EXPECT_EQ(stretch<int>(bytes, reported.at("loop")), opening.loop);
    const auto steps = stretch<std::int16_t>(bytes, reported.at("points").at("values"));
    ASSERT_EQ(steps.size(), std::size_t(opening.rest.size()));
    for (std::size_t i = 0; i < steps.size(); ++i)
      EXPECT_NEAR(reported["middle"][i % 3].get<double>() +
                      reported["points"]["step_m"].get<double>() * steps[i],
                  opening.rest.data()[i], 2e-6);
    ASSERT_EQ(reported.at("rings").size(), opening.rings.size());
    for (std::size_t r = 0; r < opening.rings.size(); ++r) {
      EXPECT_EQ(reported["rings"][r][0], opening.rings[r].edge);
      EXPECT_EQ(reported["rings"][r][1], opening.rings[r].centre);
      EXPECT_EQ(reported["rings"][r][2], opening.rings[r].jaw);
    }
    const auto jaw = stretch<float>(bytes, reported.at("jaw"));
    EXPECT_LT((Eigen::Map<const Eigen::VectorXf>(jaw.data(), Eigen::Index(jaw.size())) -
               opening.jaw.cast<float>())
                  .norm(),
              1e-6);
    const auto colours = stretch<std::uint8_t>(bytes, reported.at("colours"));
    ASSERT_EQ(colours.size(), 3 * opening.colours.size());
    EXPECT_EQ(colours[4], opening.colours[1][1]);
    EXPECT_EQ(colours.back(), opening.colours.back()[2]);
  }
}

TEST(HtmlReport, CarriesPictureAndColours) {
  const auto textured = made_up_face(Surface::textured);
  auto modes = displacement_modes(textured.performance.skin_displacement_m);
  std::string page = written(textured, modes);
  json skin = json::parse(element(page, "hyperex-manifest")).at("skin");
  EXPECT_EQ(stretch<std::uint8_t>(from_base64(element(page, "hyperex-binary")),
                                  skin.at("texture").at("image")),
            textured.scan.texture->bytes);
  const auto coloured = made_up_face(Surface::coloured);
  modes = displacement_modes(coloured.performance.skin_displacement_m);
  page = written(coloured, modes);
  skin = json::parse(element(page, "hyperex-manifest")).at("skin");
  const auto colour =
      stretch<std::uint8_t>(from_base64(element(page, "hyperex-binary")), skin.at("colour"));
  EXPECT_EQ(colour.size(), 4u * coloured.performance.skin_rest.points.rows());
}

TEST(HtmlReport, TextCannotEndTheScriptElement) {
  const auto face = made_up_face(Surface::plain, 11);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const std::string title = "</script><b>\"&<!--\xff", clean = "</script><b>\"&<!--\uFFFD";
  const std::string page = written(face, modes, title, {{"scan", "</script>"}});
  const json manifest = json::parse(element(page, "hyperex-manifest"));
  EXPECT_EQ(manifest.at("title"), clean);
  EXPECT_EQ(manifest.at("summary").at("scan"), "</script>");
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
}

TEST(HtmlReport, LoadsNothingFromOutside) {
  const auto face = made_up_face(Surface::plain, 11);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  const std::string page = written(face, modes);
  EXPECT_THAT(page, ::testing::Not(::testing::ContainsRegex("(src|href)=\"(https?:)?//")));
  EXPECT_EQ(page.find("src=\"./"), std::string::npos);
}

TEST(HtmlReport, RefusesWhatDoesNotBelongTogetherAndUnwritablePlaces) {
  const auto face = made_up_face(Surface::plain, 11);
  const auto other = made_up_face(Surface::plain, 13);
  const auto modes = displacement_modes(face.performance.skin_displacement_m);
  EXPECT_THROW(written(other, modes), std::invalid_argument);
  EXPECT_THROW(write_html_report("/nowhere/r.html",
                                 {face.performance, face.scan, modes, nullptr, {}, {}, ""}),
               InputError);
}

}  // namespace
}  // namespace hyperex::report
