// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/text_table.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visit_figures.hpp"
#include "hyperex/visits/visit_picture.hpp"
#include "hyperex/visits/visits_page.hpp"
#include "hyperex/visits/visits_table.hpp"
#include "smiling_face.hpp"
#include "support/test_file.hpp"

namespace hyperex::visits {
namespace {

Comparison two_visits() {
  VisitsFile file = visits_of(2);
  file.patient = "P-017 </script>";
  for (VisitEntry& visit : file.visits) visit.recordings = {"some/smile.csv"};
  const MeasuredFace first = measure(recording_of({}), file, 0.0, nullptr);
  const MeasuredFace second = measure(recording_of({.right = 0.6}), file, 0.0, &first);
  return compare(file, {{first}, {second}});
}

TEST(VisitsOutputs, TheTableHasEachMeasureOfEachVisit) {
  const TestFolder folder;
  const Comparison two = two_visits();
  write_visits_table(folder / "t.csv", two);
  const io::TextTable table = io::read_text_table(folder / "t.csv");
  EXPECT_EQ(table.rows.size(), 2 * two.measures.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    EXPECT_EQ(table.rows[r].size(), 16u);
    EXPECT_EQ(table.rows[r][7].empty(), r < two.measures.size()) << "changes since the first";
  }
  const auto& right = table.rows[two.measures.size()];
  EXPECT_EQ(right[1], "corner_excursion");
  EXPECT_EQ(right[2], "R");
  EXPECT_NEAR(std::stod(right[7]), -0.4e3 * kWholeSmile.norm(), 0.05);
  EXPECT_EQ(right[12], "yes");
  EXPECT_EQ(right[15], "no") << "nothing doubts it";
  EXPECT_EQ(table.names[15], "doubtful");
}

/// Where a measure stands among all.
std::size_t place_of(const Comparison& comparison, const std::string& key,
                     const std::string& side) {
  const auto place = std::ranges::find_if(comparison.measures, [&](const auto& one) {
    return one.measure.key == key && one.measure.side == side;
  });
  return std::size_t(place - comparison.measures.begin());
}

/// The cells `doubtful` of the table, for the visits after the first.
std::vector<std::string> doubtful_cells(const Comparison& comparison) {
  const TestFolder folder;
  write_visits_table(folder / "t.csv", comparison);
  std::vector<std::string> cells;
  for (const auto& row : io::read_text_table(folder / "t.csv").rows)
    if (!row[7].empty()) cells.push_back(row[15]);
  return cells;
}

TEST(VisitsOutputs, AComparisonOfADoubtedVisitIsMarkedInEachTable) {
  Comparison two = two_visits();
  MeasureOverVisits of_scans = two.measures[place_of(two, "corner_excursion", "R")];
  of_scans.measure.value = {};
  two.measures.push_back(of_scans);
  EXPECT_THAT(doubtful_cells(two), testing::Each("no"));
  for (const std::size_t doubted : {0u, 1u}) {
    Comparison one_doubted = two;
    one_doubted.faces[doubted][0].doubts = {"it may be another person"};
    std::vector<std::string> cells = doubtful_cells(one_doubted);
    ASSERT_EQ(cells.size(), two.measures.size());
    EXPECT_EQ(cells.back(), "no") << "a recording does not doubt a scan";
    cells.pop_back();
    EXPECT_THAT(cells, testing::Each("yes")) << doubted;
    const auto& right = one_doubted.measures[place_of(two, "corner_excursion", "R")];
    EXPECT_EQ(verdict_words(one_doubted, right, 1), "yes, doubtful");
    EXPECT_EQ(verdict_words(two, right, 1), "yes");
  }
}

TEST(VisitsOutputs, AVisitBetweenThatIsDoubtedDoubtsItsOwnChangeAlone) {
  VisitsFile file = visits_of(3);
  const MeasuredFace first = measure(recording_of({}), file, 0.0, nullptr);
  MeasuredFace between = measure(recording_of({.right = 0.6}), file, 0.0, &first);
  const MeasuredFace last = between;
  between.doubts = {"it may be another person"};
  const Comparison three = compare(file, {{first}, {between}, {last}});
  const auto& right = three.measures[place_of(three, "corner_excursion", "R")];
  EXPECT_TRUE(is_doubtful(three, right, 1));
  EXPECT_FALSE(is_doubtful(three, right, 2));
}

nlohmann::json page_of(const Comparison& comparison) {
  const TestFolder folder;
  write_visits_page(folder / "v.html", comparison);
  const std::string page = read_file(folder / "v.html");
  const std::string begin = "id=\"hyperex-manifest\" type=\"application/json\">";
  const auto at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(VisitsOutputs, ThePageHasTheSameFigures) {
  const Comparison two = two_visits();
  const nlohmann::json manifest = page_of(two);
  EXPECT_EQ(manifest["patient"], "P-017 </script>");
  ASSERT_EQ(manifest["measures"].size(), two.measures.size());
  EXPECT_NEAR(manifest["measures"][0]["changes"][1]["value"].get<double>(),
              two.measures[0].changes[1]->value, 1e-12)
      << "the page rounds it, once";
  EXPECT_NEAR(manifest["measures"][0]["values"][1]["high"].get<double>(),
              two.measures[0].values[1]->measured->high, 1e-12);
  EXPECT_EQ(manifest["measures"][0]["changes"][1]["beyond"], "yes");
  EXPECT_EQ(manifest["measures"][0]["changes"][1]["doubtful"], false);
  EXPECT_TRUE(manifest["measures"][0]["changes"][0].is_null());
  EXPECT_EQ(manifest["curves"].size(), 2u);
  EXPECT_EQ(manifest["visits"][1]["recordings"][0], "smile.csv");
  EXPECT_TRUE(manifest["visits"][0]["picture"].get<std::string>().starts_with(
      "data:image/png;base64,iVBOR"));
  EXPECT_EQ(manifest["visits"][0]["no_picture"], "");
}

TEST(VisitsOutputs, ThePageHasDoubtsBesideTheHeadlineAndOtherRemarksBelow) {
  Comparison two = two_visits();
  two.faces[1][0].doubts = {"it may be another person"};
  two.faces[1][0].choices = {"the head is held by a band"};
  two.faces[1][0].remarks = {"a point jumps"};
  const nlohmann::json manifest = page_of(two);
  EXPECT_EQ(manifest["summary"][2], "Doubtful: it may be another person.");
  EXPECT_EQ(manifest["measures"][0]["changes"][1]["doubtful"], true);
  EXPECT_EQ(manifest["notes"], nlohmann::json::array({"a point jumps"}));
  EXPECT_EQ(manifest["choices"], nlohmann::json::array({"the head is held by a band"}))
      << "which warns of nothing";
}

TEST(VisitsOutputs, ThePageSaysWhatAPictureLacks) {
  VisitsFile file = visits_of(2);
  for (VisitEntry& visit : file.visits) visit.recordings = {"smile.csv"};
  motion::Motion without_corner = recording_of({});
  for (std::string& name : without_corner.names)
    if (name == "ibug68_36") name = "marker";
  const MeasuredFace first = measure(without_corner, file, std::nullopt, nullptr);
  const MeasuredFace second = measure(recording_of({.right = 0.6}), file, std::nullopt, &first);
  const nlohmann::json manifest = page_of(compare(file, {{first}, {second}}));
  const std::string lacks = "the outer corner of the right eye is not recorded";
  EXPECT_EQ(manifest["visits"][0]["picture"], "");
  EXPECT_EQ(manifest["visits"][0]["no_picture"], lacks);
  EXPECT_EQ(manifest["visits"][1]["no_picture"], lacks + " at the first visit");
  for (const char* bound : {"low", "high"})
    EXPECT_TRUE(manifest["measures"][0]["changes"][1][bound].is_null()) << "an unknown jitter";
}

TEST(VisitsOutputs, TheCornersOfTheMouthAreNotMissingWhereTheyAreRecorded) {
  VisitsFile file = visits_of(1);
  file.visits[0].recordings = {"smile.csv"};
  const auto lacks = [&](const std::vector<std::string>& missing) {
    motion::Motion some = recording_of({});
    for (std::string& name : some.names)
      if (std::ranges::count(missing, name) > 0) name = "marker_" + name;
    const MeasuredFace face = measure(some, file, 0.0, nullptr);
    return page_of(compare(file, {{face}}))["visits"][0]["no_picture"].get<std::string>();
  };
  EXPECT_EQ(lacks({"ibug68_36", "ibug68_45"}),
            "the outer corner of the right eye and the outer corner of the left eye are not "
            "recorded");
  EXPECT_EQ(lacks({"ibug68_54"}), "the left corner of the mouth is not recorded");
}

TEST(VisitFigures, AreRoundedOnce) {
  EXPECT_EQ(figure(3.7489), "3.7");
  EXPECT_EQ(figure(-17.3486), "-17.3");
  EXPECT_EQ(figure(-0.0484), "0.0");
  EXPECT_EQ(signed_figure(-0.0484), "0.0");
  EXPECT_EQ(signed_figure(0.0484), "0.0");
  EXPECT_EQ(signed_figure(5.5547), "+5.6");
  EXPECT_EQ(signed_figure(-0.06), "-0.1");
}

/// A mouth that opens: the points of the upper lip go up, those of the lower lip down, by these
/// lengths (m), less beside the corners. The corners may smile meanwhile.
MeasuredFace parted_lips(double up_m, double down_m, const Smile& smile) {
  motion::Motion opening = recording_of(smile);
  const std::map<int, double> shares = {
      {49, 0.6},  {50, 1},  {51, 1},  {52, 1},  {53, 0.6},  {61, 1},  {62, 1},  {63, 1},
      {55, -0.6}, {56, -1}, {57, -1}, {58, -1}, {59, -0.6}, {65, -1}, {66, -1}, {67, -1}};
  const double whole = std::max(1, int(opening.positions.size()) - 1);
  for (std::size_t k = 0; k < opening.positions.size(); ++k)
    for (const auto& [point, share] : shares)
      opening.positions[k](point, 1) +=
          share * (share > 0 ? up_m : down_m) * std::sin(std::numbers::pi * double(k) / whole);
  VisitsFile file = visits_of(1);
  file.expression = *expression_named("mouth open");
  return measure(opening, file, 0.0, nullptr);
}

double distance_to(const Points& surface, const std::vector<int>& vertices,
                   const Eigen::RowVector3d& p) {
  double least = 1;
  for (const int v : vertices) least = std::min(least, (surface.row(v) - p).norm());
  return least;
}

int flipped_triangles(const anatomy::EmbeddedFace& average, const Points& at_rest,
                      const Points& moved) {
  const auto normal = [](const Points& points, const auto& triangle) {
    const Vec3 a = points.row(triangle[0]), b = points.row(triangle[1]),
               c = points.row(triangle[2]);
    return Vec3((b - a).cross(c - a));
  };
  int count = 0;
  for (const auto triangle : average.mesh.triangles.rowwise())
    count += normal(at_rest, triangle).dot(normal(moved, triangle)) <= 0;
  return count;
}

/// Each vertex of the border between the lips, with its lip.
struct LipBorders {
  std::vector<int> upper, lower;

  explicit LipBorders(const anatomy::EmbeddedFace& average) {
    const std::vector<double> margin = anatomy::upper_lip_margin(average.mesh, average.landmarks);
    constexpr double sure_m = 0.004;  // at the corners it is 0
    for (const int v : anatomy::mouth_border(average.mesh, average.landmarks))
      if (std::abs(margin[std::size_t(v)]) > sure_m)
        (margin[std::size_t(v)] > 0 ? upper : lower).push_back(v);
  }
};

TEST(PeakSurface, ThePartedLipsLieApartEverywhere) {
  const anatomy::EmbeddedFace average = anatomy::embedded_face();
  const Points at_rest = *peak_surface(parted_lips(0, 0, {.right = 0, .left = 0}));
  const LipBorders lips(average);
  ASSERT_GT(lips.upper.size(), 30u);
  const double inner_m = std::abs(average.landmarks.at("ibug68_61").x());
  for (const double smile : {0.0, 1.0}) {
    const Points moved = *peak_surface(parted_lips(0.003, 0.007, {.right = smile, .left = smile}));
    EXPECT_EQ(flipped_triangles(average, at_rest, moved), 0) << smile;
    int between = 0;
    for (const int v : lips.upper) {
      const double apart = distance_to(moved, lips.lower, moved.row(v));
      EXPECT_GT(apart, 0.0005) << v;
      // Between the outer ones of the inner points the opening is that of the points.
      if (std::abs(average.mesh.points(v, 0)) > inner_m) continue;
      EXPECT_NEAR(apart, 0.010, 0.0015) << v;
      ++between;
    }
    EXPECT_GT(between, 10);
  }
}

TEST(PeakSurface, LipsThatCloseMeetHalfWay) {
  const Points closed = *peak_surface(parted_lips(-0.002, -0.002, {.right = 0, .left = 0}));
  const anatomy::EmbeddedFace average = anatomy::embedded_face();
  const LipBorders lips(average);
  for (const int v : lips.upper) {
    int nearest = lips.lower.front();
    for (const int other : lips.lower)
      if (std::abs(closed(other, 0) - closed(v, 0)) < std::abs(closed(nearest, 0) - closed(v, 0)))
        nearest = other;
    EXPECT_GT(closed(v, 1) - closed(nearest, 1), -0.001) << "by 4 mm where nothing holds them";
  }
}

TEST(PeakSurface, ThePointBetweenTheLipsHoldsNeither) {
  MeasuredFace face = parted_lips(0.003, 0.007, {.right = 0, .left = 0});
  const Points moved = *peak_surface(face);
  face.rest["stomion"] = face.peak["stomion"] = face.rest.at("ibug68_62");
  EXPECT_LT((*peak_surface(face) - moved).norm(), 1e-12);
}

/// Sum of differences over the pixels of the left or right half of two pictures.
double difference(const render::Image& a, const render::Image& b, bool right_half) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = right_half ? a.width / 2 : 0; x < (right_half ? a.width : a.width / 2); ++x)
      for (int c = 0; c < 3; ++c) sum += std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]);
  return sum;
}

TEST(VisitsOutputs, ThePictureShowsTheSideThatMoved) {
  const Comparison two = two_visits();
  const auto first = draw_peak(two.faces[0][0]), second = draw_peak(two.faces[1][0]);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->width, 300);
  // The subject's right is on the left of the picture.
  EXPECT_GT(difference(*first, *second, false), 5 * difference(*first, *second, true));
}

}  // namespace
}  // namespace hyperex::visits
