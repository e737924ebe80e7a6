// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/model/candide.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/tracking/model/face_model.hpp"

namespace hyperex::tracking {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const char* const kSmall =
    "# VERTEX LIST:\n3\n0 0 0\n1 0 0.5\n0 1 -0.25\n\n# FACE LIST:\n1\n0 1 2\n\n"
    "# ANIMATION UNITS LIST:\n1\n\n# Jaw drop\n2\n2 0 -1 0.125\n2 0.5 0 0\n\n"
    "# SHAPE UNITS LIST:\n1\n\n# Head height\n1\n0 0 0.1 0\n\n"
    "# ANIMATION PARAMETERS:\n0.5\n\n# SHAPE PARAMETERS:\n0\n\n# END OF FILE\n";

fs::path written(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "small.wfm";
  std::ofstream(file) << text;
  return file;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void expect_equal(const CandideFile& a, const CandideFile& b) {
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_EQ(a.animation_parameters, b.animation_parameters);
  EXPECT_EQ(a.shape_parameters, b.shape_parameters);
  for (auto units : {&CandideFile::animation_units, &CandideFile::shape_units}) {
    ASSERT_EQ((a.*units).size(), (b.*units).size());
    for (std::size_t k = 0; k < (a.*units).size(); ++k) {
      EXPECT_EQ((a.*units)[k].name, (b.*units)[k].name);
      EXPECT_EQ((a.*units)[k].vertices, (b.*units)[k].vertices);
      EXPECT_EQ((a.*units)[k].displacement, (b.*units)[k].displacement);
    }
  }
}

TEST(Candide, SmallFileIsReadAndComesBack) {
  const CandideFile file = read_candide(written(kSmall));
  EXPECT_EQ(file.mesh.points(1, 2), 0.5);
  ASSERT_EQ(file.animation_units.size(), 1u);
  EXPECT_EQ(file.animation_units[0].name, "Jaw drop");
  EXPECT_EQ(file.animation_units[0].vertices, (std::vector<int>{2, 2}));
  EXPECT_EQ(file.animation_parameters[0], 0.5);
  const fs::path again = fs::path(testing::TempDir()) / "again.wfm";
  write_candide(again, file);
  expect_equal(file, read_candide(again));
}

TEST(Candide, MalformedFilesAreRefusedByLine) {
  const std::vector<std::array<std::string, 3>> faults = {
      {"1 0 0.5", "1 0 half", ":4:"},         {"1 0 0.5", "1 0", ":4:"},
      {"0 1 2\n", "0 1 3\n", ":9:"},          {"0 1 2\n", "0 1 1\n", ":9:"},
      {"# FACE LIST:", "# FACES:", ":7:"},    {"2 0 -1 0.125", "3 0 -1 0.125", ":16:"},
      {"2 0.5 0 0", "2 0.5 0 nan", ":17:"},   {"# Jaw drop\n", "", ":14:"},
      {"# END OF FILE\n", "1 2 3\n", ":32:"}, {"0 1 -0.25\n", "", ":6:"}};
  for (const auto& [from, to, line] : faults) {
    try {
      read_candide(written(replaced(kSmall, from, to)));
      ADD_FAILURE() << from << " -> " << to << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("small.wfm" + line)) << from << " -> " << to;
    }
  }
  const std::string text = kSmall;
  for (std::size_t end = 0; end < text.find("# ANIMATION PARAMETERS") - 2; end += 7)
    EXPECT_THROW(read_candide(written(text.substr(0, end))), InputError) << end;
}

TEST(Candide, TheRealFileHasItsCountsAndComesBack) {
  const fs::path file = fs::path(HYPEREX_SHARED_DIR) / "data/candide/candide3.wfm";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
  const CandideFile candide = read_candide(file);
  EXPECT_EQ(candide.mesh.points.rows(), 113);
  EXPECT_EQ(candide.mesh.triangles.rows(), 184);
  EXPECT_EQ(candide.animation_units.size(), 14u);
  EXPECT_EQ(candide.shape_units.size(), 38u);
  const fs::path again = fs::path(testing::TempDir()) / "candide_again.wfm";
  write_candide(again, candide);
  expect_equal(candide, read_candide(again));

  const FaceModel model = candide_model(file.string());
  const auto check = [&](const std::vector<CandideUnit>& listed,
                         const std::vector<DeformationUnit>& units) {
    ASSERT_EQ(listed.size(), units.size());
    for (std::size_t k = 0; k < units.size(); ++k) {
      Eigen::VectorXd weights = Eigen::VectorXd::Zero(Eigen::Index(units.size()));
      weights[Eigen::Index(k)] = 0.7;
      const Points moved = deformed(model.mesh.points, units, weights) - model.mesh.points;
      const std::set<int> may(listed[k].vertices.begin(), listed[k].vertices.end());
      for (int v = 0; v < moved.rows(); ++v)
        if (!may.contains(v)) EXPECT_EQ(moved.row(v).norm(), 0) << units[k].name << " moves " << v;
      EXPECT_GT(moved.norm(), 1e-3) << units[k].name;
    }
  };
  check(candide.animation_units, model.animation_units);
  check(candide.shape_units, model.shape_units);
  EXPECT_EQ(model.animation_units[std::size_t(model.jaw_drop)].name, "Jaw drop");
}

}  // namespace
}  // namespace hyperex::tracking
