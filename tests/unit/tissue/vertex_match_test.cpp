// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/per_vertex/vertex_match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/per_vertex/per_vertex.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {
using testing::HasSubstr;

TriMesh face() {
  return embedded_face().mesh;
}

/// The new index of each vertex: 0, 7, 14, ... in a cycle (7 does not divide the number of
/// vertices).
std::vector<int> shuffled(Eigen::Index count) {
  std::vector<int> place(count);
  for (Eigen::Index v = 0; v < count; ++v) place[v] = int(7 * v % count);
  return place;
}

TriMesh reordered(const TriMesh& mesh, const std::vector<int>& place) {
  TriMesh out = mesh;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    out.points.row(place[v]) = mesh.points.row(v);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    out.triangles.data()[i] = place[mesh.triangles.data()[i]];
  return out;
}

/// A value that differs from vertex to vertex.
Eigen::VectorXd numbered(Eigen::Index count) {
  return Eigen::VectorXd::LinSpaced(count, 0, 1);
}

Eigen::VectorXd moved(const Eigen::VectorXd& values, const std::vector<int>& place) {
  Eigen::VectorXd out(values.size());
  for (Eigen::Index v = 0; v < values.size(); ++v) out[place[v]] = values[v];
  return out;
}

TEST(VertexMatch, KeepsTheOrderOfAMeshThatWasMovedTurnedAndScaled) {
  const TriMesh scan = face();
  TriMesh own = scan;
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  own.points =
      ((scan.points * turn.matrix().transpose()) * 1000).rowwise() + Eigen::RowVector3d(5, -900, 3);
  const VertexMatch match("own.ply", own, scan);
  EXPECT_TRUE(match.same_order());
  const Eigen::VectorXd values = numbered(scan.points.rows());
  EXPECT_EQ(match.on_scan(values, 0), values);
}

TEST(VertexMatch, FindsVerticesByPlaceInAnyUnitAndAxes) {
  const TriMesh scan = face();
  const std::vector<int> place = shuffled(scan.points.rows());
  TriMesh own = reordered(scan, place);
  // glTF's axes to Blender's (y up to z up), millimetres, written with four decimals.
  const Points at = own.points;
  own.points.col(0) = 1e3 * at.col(0);
  own.points.col(1) = -1e3 * at.col(2);
  own.points.col(2) = 1e3 * at.col(1);
  own.points = (own.points * 1e4).array().round() / 1e4;
  const VertexMatch match("own.ply", own, scan);
  EXPECT_FALSE(match.same_order());
  const Eigen::VectorXd values = numbered(scan.points.rows());
  const Eigen::VectorXd back = match.on_scan(moved(values, place), 0);
  EXPECT_EQ(back, values);
  EXPECT_EQ(match.disagreements(moved(values, place)), 0);
}

TEST(VertexMatch, TakesTheMeanWhereSplitVerticesDisagree) {
  const TriMesh scan = face();
  const Eigen::Index count = scan.points.rows();
  // Each vertex twice, as an export splits them along a seam.
  TriMesh own{Points(2 * count, 3), scan.triangles};
  own.points << scan.points, scan.points;
  Eigen::VectorXd values(2 * count);
  values << numbered(count), numbered(count);
  const VertexMatch match("own.ply", own, scan);
  EXPECT_EQ(match.on_scan(values, 0), numbered(count));
  EXPECT_EQ(match.disagreements(values), 0);
  values[10] += 0.5;
  EXPECT_DOUBLE_EQ(match.on_scan(values, 0)[10], numbered(count)[10] + 0.25);
  EXPECT_EQ(match.disagreements(values), 1);
}

TEST(VertexMatch, RefusesAnotherMeshWithCountAndDistance) {
  const TriMesh scan = face();
  TriMesh own = reordered(scan, shuffled(scan.points.rows()));
  own.points.row(0).x() += 0.004;
  const std::string said = test::refusal([&] { VertexMatch("own.ply", own, scan); });
  EXPECT_THAT(said, HasSubstr("own.ply: 1 of the scan's"));
  EXPECT_THAT(said, HasSubstr("vertex 0, counted from 0, is 1.2 mm from the nearest"));
}

class VertexFiles : public testing::Test {
 protected:
  const TestFolder folder_;
};

TEST_F(VertexFiles, PaintInAnotherOrderGoesWhereItWasPainted) {
  const TriMesh scan = face();
  const std::vector<int> place = shuffled(scan.points.rows());
  io::VertexColours colours(scan.points.rows(), 4);
  for (Eigen::Index v = 0; v < scan.points.rows(); ++v)
    colours.row(place[v]) << 255, std::uint8_t(scan.points(v, 0) > 0 ? 0 : 255),
        std::uint8_t(scan.points(v, 0) > 0 ? 0 : 255), 255;
  const auto file = folder_ / "painted.ply";
  io::write_ply(file, reordered(scan, place), io::LengthUnit::millimetre, {}, colours);
  std::vector<Note> notes;
  const Eigen::VectorXd share = read_paint(file, scan, notes);
  for (Eigen::Index v = 0; v < scan.points.rows(); ++v)
    EXPECT_EQ(share[v], scan.points(v, 0) > 0 ? 1 : 0) << "vertex " << v;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], test::is_note("tissue.matched_by_place"));
}

TEST_F(VertexFiles, ParametersInAnotherOrderToo) {
  const TriMesh scan = face();
  const std::vector<int> place = shuffled(scan.points.rows());
  const Eigen::VectorXd kpa = 100 + 50 * numbered(scan.points.rows()).array();
  const auto file = folder_ / "own.ply";
  io::write_ply(file, reordered(scan, place), io::LengthUnit::millimetre,
                {{"young_kpa", moved(kpa, place).cast<float>()}});
  std::vector<Note> notes;
  const PerVertex columns = read_per_vertex(file, scan, notes);
  EXPECT_LT((columns[young] - 1e3 * kpa).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_THAT(notes, testing::ElementsAre(test::is_note("tissue.matched_by_place")));
}

}  // namespace
}  // namespace hyperex::tissue
