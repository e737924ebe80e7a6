// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/prepared_face.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/session/kept_order.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "support/test_file.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
namespace fs = std::filesystem;

class PreparedFaces : public testing::Test {
 protected:
  void SetUp() override {
    scene_.scan.source.embedded = true;
    scene_.motion.source.embedded = true;
    scene_.mesh.element_size_m = 0.009;
    scene_.kept = KeptResults(folder_);
  }

  PreparedFace prepared() {
    Inputs inputs = read_inputs(scene_);
    int times = 0;
    PreparedFace face = prepare_face(scene_, inputs, [&] { ++times; });
    EXPECT_EQ(times, 1);
    return face;
  }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("face-")) files.push_back(entry.path());
    return files;
  }

  const TestFolder folder_;
  Scene scene_;
};

TEST_F(PreparedFaces, AreTakenFromAnEarlierRunBitForBit) {
  const std::string made = bytes_of(prepared());
  ASSERT_EQ(kept().size(), 1u);
  const auto time = fs::last_write_time(kept().front());
  testing::internal::CaptureStdout();
  const std::string taken = bytes_of(prepared());
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(made, taken);
  EXPECT_NE(said.find("an earlier run"), std::string::npos) << said;
  EXPECT_GE(fs::last_write_time(kept().front()), time);
  scene_.kept = {};
  EXPECT_EQ(bytes_of(prepared()), made) << "made anew";
}

// Indices in the file may have been changed by others. Each of these would be read out of bounds
// and must not be used.
TEST_F(PreparedFaces, IndicesThatCountNothingAreRefused) {
  const PreparedFace face = prepared();
  const TriMesh scan = read_inputs(scene_).scan.mesh;
  ASSERT_TRUE(fits(face, scan));
  const auto fits_with = [&](const auto& change) {
    PreparedFace changed = face;
    auto mesh = std::make_shared<tissue::TissueMesh>(*face.mesh);
    change(*mesh, changed.at_rest);
    changed.mesh = mesh;
    return fits(changed, scan);
  };
  using Mesh = tissue::TissueMesh;
  using AtRest = metrics::RestAsymmetry;
  ASSERT_TRUE(fits_with([](Mesh&, AtRest&) {}));
  for (const int wrong : {-1, 1 << 28}) {
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.volume.tets(5, 2) = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.volume.outer.triangles(0, 1) = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.skin.triangles(7, 0) = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.source_triangle[3] = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.anchors[3].node[1] = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh& m, AtRest&) { m.rim.at(0).node.at(0) = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh&, AtRest& r) { r.pairs.vertices[9][2] = wrong; }));
    EXPECT_FALSE(fits_with([&](Mesh&, AtRest& r) { r.mouth.at(0) = wrong; }));
  }
  EXPECT_FALSE(fits_with([](Mesh& m, AtRest&) { m.volume.layers = 7; }));
  EXPECT_FALSE(fits_with([](Mesh& m, AtRest&) { m.anchors.pop_back(); }));
  EXPECT_FALSE(fits_with([](Mesh& m, AtRest&) { m.on_border.clear(); }));
  EXPECT_FALSE(order_from(bytes_of(simulate::EliminationOrder{
      {0, 1}, std::make_shared<fem::NodeOrder>(fem::NodeOrder{{0, 2, 2}, 1, 1})})));
  EXPECT_FALSE(order_from(bytes_of(simulate::EliminationOrder{
      {1, 0}, std::make_shared<fem::NodeOrder>(fem::NodeOrder{{0, 2, 1}, 1, 1})})));
}

TEST_F(PreparedFaces, OfOtherOptionsAreMadeAnew) {
  prepared();
  scene_.mesh.element_size_m = 0.0095;
  const PreparedFace other = prepared();
  EXPECT_EQ(kept().size(), 2u);
  scene_.mesh.depths = {{"pogonion", 0.02}};
  EXPECT_NE(bytes_of(prepared()), bytes_of(other));
  EXPECT_EQ(kept().size(), 3u);
}

TEST_F(PreparedFaces, OfOtherPaintInTheSameFilesAreMadeAnew) {
  const std::string plain = bytes_of(prepared());
  const fs::path file = fs::path(testing::TempDir()) / ("painted_" + std::to_string(getpid()));
  const Eigen::Index vertices = read_inputs(scene_).scan.mesh.points.rows();
  const auto paint = [&](const char* column, double value, const char* ending) {
    std::ofstream out(file.string() + ending);
    out << column << "\n";
    for (Eigen::Index v = 0; v < vertices; ++v) out << value << "\n";
    return file.string() + ending;
  };
  scene_.mesh.depth_per_vertex = paint("thickness_mm", 9, ".csv");
  const std::string nine = bytes_of(prepared());
  EXPECT_NE(nine, plain);
  EXPECT_EQ(bytes_of(prepared()), nine);
  EXPECT_EQ(kept().size(), 2u);
  paint("thickness_mm", 8, ".csv");
  EXPECT_NE(bytes_of(prepared()), nine) << "another file of the same name";
  EXPECT_EQ(kept().size(), 3u);
  scene_.mesh.depth_regions = {{paint("weight", 0.5, "_region.csv"), 0.007}};
  const std::string region = bytes_of(prepared());
  scene_.mesh.depth_regions[0].depth_m = 0.01;
  EXPECT_NE(bytes_of(prepared()), region);
  paint("weight", 1, "_region.csv");
  prepared();
  EXPECT_EQ(kept().size(), 6u);
  for (const char* ending : {".csv", "_region.csv"}) fs::remove(file.string() + ending);
}

TEST_F(PreparedFaces, ATornOneIsMadeAnew) {
  const std::string made = bytes_of(prepared());
  fs::resize_file(kept().front(), 1000);
  EXPECT_EQ(bytes_of(prepared()), made);
}

// Written by others, with a sound checksum: its sizes are those of another scan.
TEST_F(PreparedFaces, OneThatDoesNotFitItsScanIsMadeAnew) {
  const PreparedFace face = prepared();
  const std::string made = bytes_of(face), key = kept().front().stem().string();
  PreparedFace other = face;
  auto mesh = std::make_shared<tissue::TissueMesh>(*face.mesh);
  mesh->anchors.pop_back();
  other.mesh = mesh;
  ASSERT_TRUE(prepared_face_from(bytes_of(other)));
  scene_.kept.keep(key, bytes_of(other));
  ASSERT_EQ(scene_.kept.find(key).value_or(""), bytes_of(other));
  EXPECT_EQ(bytes_of(prepared()), made);
  EXPECT_EQ(scene_.kept.find(key).value_or(""), made) << "and kept in its place";
}

TEST_F(PreparedFaces, BytesThatEndTooSoonOrTooLateAreNone) {
  const std::string bytes = bytes_of(prepared());
  ASSERT_TRUE(prepared_face_from(bytes));
  EXPECT_FALSE(prepared_face_from(""));
  EXPECT_FALSE(prepared_face_from(bytes + "x"));
  for (std::size_t size = 1; size < bytes.size(); size += bytes.size() / 50)
    EXPECT_FALSE(prepared_face_from(bytes.substr(0, size))) << size;
}

TEST_F(PreparedFaces, TheThinnedSkinOfALargeScanToo) {
  PreparedFace face = prepared();
  tissue::TissueMesh mesh = *face.mesh;
  auto full = std::make_shared<tissue::FullSkin>();
  full->skin = mesh.skin;
  full->scan_vertices = 7;
  full->appended = {{1, 2, 0.25}};
  full->source_triangle = {3, 1};
  full->kept = {4};
  full->kept_triangle = {5, 6};
  full->places = {{{1, 2, 3}, Vec3(0.5, 0.25, 0.25)}};
  mesh.full = full;
  face.mesh = std::make_shared<const tissue::TissueMesh>(mesh);
  const auto back = prepared_face_from(bytes_of(face));
  ASSERT_TRUE(back);
  ASSERT_TRUE(back->mesh->full);
  EXPECT_EQ(back->mesh->full->scan_vertices, 7);
  EXPECT_EQ(back->mesh->full->places[0].weight, full->places[0].weight);
  EXPECT_EQ(bytes_of(*back), bytes_of(face));
}

TEST_F(PreparedFaces, TheirOrderOfEliminationIsKeptToo) {
  const auto order_and_bytes = [&] {
    Inputs inputs = read_inputs(scene_);
    const PreparedFace face = prepare_face(scene_, inputs, [] {});
    simulate::Simulator simulator(face.mesh, inputs.landmarks, inputs.motion,
                                  simulation_options(scene_, inputs));
    prepare_with_kept_order(scene_, inputs, simulator);
    return bytes_of(*simulator.elimination_order());
  };
  const std::string found = order_and_bytes();
  const auto files = [&] {
    return std::count_if(
        fs::directory_iterator(folder_), fs::directory_iterator(),
        [](const auto& entry) { return entry.path().filename().string().starts_with("order-"); });
  };
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(order_and_bytes(), found);
  EXPECT_EQ(files(), 1);
  scene_.drive.patch_radius_m *= 2;
  EXPECT_NE(order_and_bytes(), found);
  EXPECT_EQ(files(), 2);
  EXPECT_FALSE(order_from(found.substr(1)));
  EXPECT_FALSE(order_from(""));
}

}  // namespace
}  // namespace hyperex::session
