// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/io/text_table.hpp"
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
    EXPECT_EQ(table.rows[r].size(), 15u);
    EXPECT_EQ(table.rows[r][7].empty(), r < two.measures.size()) << "changes since the first";
  }
  const auto& right = table.rows[two.measures.size()];
  EXPECT_EQ(right[1], "corner_excursion");
  EXPECT_EQ(right[2], "R");
  EXPECT_NEAR(std::stod(right[7]), -0.4e3 * kWholeSmile.norm(), 0.05);
  EXPECT_EQ(right[12], "yes");
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
              two.measures[0].changes[1]->value, 0.006);
  EXPECT_EQ(manifest["measures"][0]["changes"][1]["beyond"], "yes");
  EXPECT_TRUE(manifest["measures"][0]["changes"][0].is_null());
  EXPECT_EQ(manifest["curves"].size(), 2u);
  EXPECT_EQ(manifest["visits"][1]["recordings"][0], "smile.csv");
  EXPECT_TRUE(manifest["visits"][0]["picture"].get<std::string>().starts_with(
      "data:image/png;base64,iVBOR"));
  EXPECT_EQ(manifest["visits"][0]["no_picture"], "");
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
  const std::string lacks =
      "the outer corners of the eyes or the corners of the mouth are not recorded";
  EXPECT_EQ(manifest["visits"][0]["picture"], "");
  EXPECT_EQ(manifest["visits"][0]["no_picture"], lacks);
  EXPECT_EQ(manifest["visits"][1]["no_picture"], lacks + " at the first visit");
  for (const char* bound : {"low", "high"})
    EXPECT_TRUE(manifest["measures"][0]["changes"][1][bound].is_null()) << "an unknown jitter";
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
