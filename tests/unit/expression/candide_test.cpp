// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/candide.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/expression/face_model.hpp"
#include "hyperex/geometry/transform.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::expression {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const char* const kSmall =
    "# VERTEX LIST:\n3\n0 0 0\n1 0 0.5\n0 1 -0.25\n\n# FACE LIST:\n1\n0 1 2\n\n"
    "# ANIMATION UNITS LIST:\n1\n\n# Jaw drop\n2\n2 0 -1 0.125\n2 0.5 0 0\n\n"
    "# SHAPE UNITS LIST:\n1\n\n# Head height\n1\n0 0 0.1 0\n\n"
    "# ANIMATION PARAMETERS:\n0.5\n\n# SHAPE PARAMETERS:\n0\n\n# END OF FILE\n";

fs::path written(const std::string& text) {
  const fs::path file = test_file("small.wfm");
  std::ofstream(file) << text;
  return file;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Candide, SmallFileIsRead) {
  const CandideFile file = read_candide(written(kSmall));
  EXPECT_EQ(file.mesh.points(1, 2), 0.5);
  ASSERT_EQ(file.animation_units.size(), 1u);
  EXPECT_EQ(file.animation_units[0].name, "Jaw drop");
  EXPECT_EQ(file.animation_units[0].vertices, (std::vector<int>{2, 2}));
  EXPECT_EQ(file.animation_units[0].displacement.row(0), Vec3(0, -1, 0.125).transpose());
  EXPECT_EQ(file.animation_units[0].displacement.row(1), Vec3(0.5, 0, 0).transpose());
  EXPECT_EQ(file.animation_parameters, Eigen::VectorXd::Constant(1, 0.5));
  ASSERT_EQ(file.shape_units.size(), 1u);
  EXPECT_EQ(file.shape_units[0].name, "Head height");
  EXPECT_EQ(file.shape_units[0].vertices, std::vector<int>{0});
  EXPECT_EQ(file.shape_parameters, Eigen::VectorXd::Zero(1));
}

TEST(Candide, MalformedFilesAreRefusedByLine) {
  const std::vector<std::array<std::string, 3>> faults = {
      {"1 0 0.5", "1 0 half", ":4:"},         {"1 0 0.5", "1 0", ":4:"},
      {"0 1 2\n", "0 1 3\n", ":9:"},          {"0 1 2\n", "0 1 1\n", ":9:"},
      {"# FACE LIST:", "# FACES:", ":7:"},    {"2 0 -1 0.125", "3 0 -1 0.125", ":16:"},
      {"2 0.5 0 0", "2 0.5 0 nan", ":17:"},   {"# Jaw drop\n", "", ":14:"},
      {"# END OF FILE\n", "1 2 3\n", ":32:"}, {"0 1 -0.25\n", "", ":6:"}};
  for (const auto& [from, to, line] : faults) {
    EXPECT_THAT(test::refusal([&] { read_candide(written(replaced(kSmall, from, to))); }),
                HasSubstr("small.wfm" + line))
        << from << " -> " << to;
  }
  EXPECT_THAT(
      test::refusal([&] {
        read_candide(written(replaced(kSmall, "Jaw drop\n2", std::string(300, 'x') + "\nx")));
      }),
      HasSubstr("unit '" + std::string(40, 'x') + "...' moves"));
  const std::string text = kSmall;
  for (std::size_t end = 0; end < text.find("# ANIMATION PARAMETERS") - 2; end += 7)
    EXPECT_THROW(read_candide(written(text.substr(0, end))), InputError) << end;
}

TEST(Candide, TheRealFileHasItsCounts) {
  const fs::path file = fs::path(HYPEREX_SHARED_DIR) / "data/candide/candide3.wfm";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
  const CandideFile candide = read_candide(file);
  EXPECT_EQ(candide.mesh.points.rows(), 113);
  EXPECT_EQ(candide.mesh.triangles.rows(), 184);
  EXPECT_EQ(candide.animation_units.size(), 14u);
  EXPECT_EQ(candide.shape_units.size(), 38u);
  const FaceModel model = candide_model(file.string());
  const double metres_per_unit = (model.mesh.points.row(20) - model.mesh.points.row(53)).norm() /
                                 (candide.mesh.points.row(20) - candide.mesh.points.row(53)).norm();
  const auto check = [&](const std::vector<CandideUnit>& listed,
                         const std::vector<DeformationUnit>& units) {
    ASSERT_EQ(listed.size(), units.size());
    for (std::size_t k = 0; k < units.size(); ++k) {
      Eigen::VectorXd weights = Eigen::VectorXd::Zero(Eigen::Index(units.size()));
      weights[Eigen::Index(k)] = 0.7;
      Points expected = Points::Zero(113, 3);  // 0 of what the unit does not list
      for (std::size_t i = 0; i < listed[k].vertices.size(); ++i)
        expected.row(listed[k].vertices[i]) +=
            0.7 * metres_per_unit * listed[k].displacement.row(Eigen::Index(i));
      const Points moved = deformed(model.mesh.points, units, weights) - model.mesh.points;
      EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 1e-12) << units[k].name;
      EXPECT_GT(moved.norm(), 1e-3) << units[k].name;
    }
  };
  check(candide.animation_units, model.animation_units);
  check(candide.shape_units, model.shape_units);
  EXPECT_EQ(model.animation_units[std::size_t(model.jaw_drop)].name, "Jaw drop");
}

/// The triangles in candide3.wfm run clockwise.
TEST(Candide, TheModelsTrianglesFaceOutwardsAndItsVerticesArePairedAlikeOnBothSides) {
  const fs::path file = fs::path(HYPEREX_SHARED_DIR) / "data/candide/candide3.wfm";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
  const FaceModel model = candide_model(file.string());
  int towards_front = 0;
  for (const auto t : model.mesh.triangles.rowwise()) {
    const Vec3 a = model.mesh.points.row(t[0]).transpose(),
               b = model.mesh.points.row(t[1]).transpose(),
               c = model.mesh.points.row(t[2]).transpose();
    if ((b - a).cross(c - a).z() > 0) ++towards_front;
  }
  EXPECT_GT(towards_front, 170);  // of 184; a few at the lids are folded over
  // Laid over the canonical face, each vertex is where the network's point is that it is paired
  // with, and its mirror image is paired with that point's mirror image.
  const Points& canonical = canonical_model().mesh.points;
  const auto nearest = [](const Points& points, Vec3 at) {
    Eigen::Index found;
    (points.rowwise() - at.transpose()).rowwise().squaredNorm().minCoeff(&found);
    return int(found);
  };
  const auto mirrored = [](const Points& points, int v) -> Vec3 {
    return points.row(v).transpose().cwiseProduct(Vec3(-1, 1, 1));
  };
  std::map<int, int> pairs;
  Points from(Eigen::Index(model.pairs.size()), 3), to(from.rows(), 3);
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    pairs[model.pairs[i].vertex] = model.pairs[i].network;
    from.row(Eigen::Index(i)) = model.mesh.points.row(model.pairs[i].vertex);
    to.row(Eigen::Index(i)) = canonical.row(model.pairs[i].network);
  }
  EXPECT_EQ(pairs.size(), model.pairs.size());
  const Eigen::VectorXd off = (fit_similarity(from, to).apply(from) - to).rowwise().norm();
  EXPECT_LT(off.maxCoeff(), 0.04);
  std::vector<double> errors(off.begin(), off.end());
  EXPECT_LT(median(errors), 0.008);
  for (const auto& [vertex, network] : pairs) {
    const Vec3 other = mirrored(model.mesh.points, vertex);
    // Upper and lower lip meet: of vertices in one place any will do.
    bool found = false;
    for (const auto& [v, n] : pairs)
      found |= (model.mesh.points.row(v).transpose() - other).norm() < 1e-9 &&
               n == nearest(canonical, mirrored(canonical, network));
    EXPECT_TRUE(found) << vertex << " " << network;
  }
}

}  // namespace
}  // namespace hyperex::expression
