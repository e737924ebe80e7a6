// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/teeth.hpp"

#include <gmock/gmock.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
using namespace scene;
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The middles of the lips' inner edges.
const io::Landmarks kLips = {{face::ibug(62), {0, 0, 0.05}}, {face::ibug(66), {0, -0.001, 0.05}}};

/// A box of 40 x 10 x 40 mm behind them, or the same without its lid.
TriMesh box(bool open) {
  TriMesh mesh{Points(8, 3), {}};
  for (int c = 0; c < 8; ++c)
    mesh.points.row(c) << (c & 1 ? 0.02 : -0.02), (c & 2 ? 0.01 : 0), (c & 4 ? 0.04 : 0);
  Triangles all(12, 3);
  all << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
      2, 6, 7, 2, 7, 3;
  mesh.triangles = all.topRows(open ? 10 : 12);
  return mesh;
}

class GivenTeeth : public testing::Test {
 protected:
  Scene scene(const std::string& keys) const {
    return read_scene(folder_.write("a.toml", smallest + ("[teeth]\n" + keys)));
  }
  void store(const std::string& name, const TriMesh& mesh,
             io::LengthUnit unit = io::LengthUnit::millimetre) const {
    io::write_ply(folder_ / name, mesh, unit);
  }
  std::string problem(const std::string& keys, const io::Landmarks& landmarks = kLips) const {
    return test::refusal([&] {
      std::vector<Note> notes;
      read_teeth(scene(keys), io::LengthUnit::millimetre, landmarks, notes);
    });
  }
  SceneFolder folder_;
};

TEST_F(GivenTeeth, AreReadInTheirUnitAndClosed) {
  store("upper.ply", box(false));
  store("lower.ply", box(true), io::LengthUnit::centimetre);
  std::vector<Note> notes;
  const anatomy::Teeth upper =
      read_teeth(scene("upper = \"upper.ply\""), io::LengthUnit::millimetre, kLips, notes);
  EXPECT_TRUE(notes.empty());
  EXPECT_LT((upper.upper.crowns.points - box(false).points).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_TRUE(upper.lower.empty());
  const anatomy::Teeth lower = read_teeth(scene("lower = \"lower.ply\"\nunit = \"cm\""),
                                          io::LengthUnit::millimetre, kLips, notes);
  EXPECT_TRUE(boundary_loops(lower.lower.crowns.triangles).empty());
  EXPECT_NEAR(lower.lower.crowns.points.maxCoeff(), 0.04, 1e-6);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], AllOf(test::is_note("teeth.closed"), test::is_about("teeth.lower"),
                              test::says("1 border"), test::says("160 mm")));
}

TEST_F(GivenTeeth, AreRefusedInOneLineWithFileAndKey) {
  store("upper.ply", box(false));
  const std::string large = problem("upper = \"upper.ply\"\nunit = \"m\"");
  EXPECT_THAT(large, AllOf(HasSubstr("a.toml"), HasSubstr("teeth.upper"), HasSubstr("upper.ply"),
                           HasSubstr("10 to 150 mm across"), HasSubstr("teeth.unit")));
  EXPECT_EQ(large.find('\n'), std::string::npos);
  io::Landmarks elsewhere = kLips;
  for (auto& [name, at] : elsewhere) at.x() += 0.5;
  EXPECT_THAT(problem("upper = \"upper.ply\"", elsewhere),
              AllOf(HasSubstr("teeth.upper"), HasSubstr("in the frame of the scan")));
  EXPECT_THAT(problem("upper = \"missing.ply\""), HasSubstr("missing.ply"));
  folder_.write("text.stl", "no mesh");
  EXPECT_THAT(problem("upper = \"text.stl\""), HasSubstr("text.stl"));
}

class TeethOfAFace : public testing::Test {
 protected:
  TeethOfAFace() {
    const anatomy::EmbeddedFace face = anatomy::embedded_face();
    inputs_.landmarks = face.landmarks;
    mesh_ = tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded");
  }
  Inputs inputs_;
  tissue::TissueMesh mesh_;
  std::vector<Note> notes_;
};

TEST_F(TeethOfAFace, AreAverageOnesNoneOrTheUsersOwn) {
  Scene scene;
  const auto average = teeth_of(scene, inputs_, mesh_, notes_);
  ASSERT_TRUE(average);
  EXPECT_FALSE(average->upper.empty());
  EXPECT_FALSE(average->lower.empty());
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_THAT(notes_[0], AllOf(test::is_note("teeth.average"), test::is_about("teeth.shape")));
  EXPECT_THAT(notes_[0].text, HasSubstr("mm behind the line where the lips meet"));

  inputs_.teeth.upper.crowns = box(false);
  const auto mixed = teeth_of(scene, inputs_, mesh_, notes_);
  EXPECT_EQ(mixed->upper.crowns.triangles.rows(), 12);
  EXPECT_EQ(mixed->lower.crowns.points, average->lower.crowns.points);

  scene.teeth.shape = TeethShape::none;
  notes_.clear();
  const auto own = teeth_of(scene, inputs_, mesh_, notes_);
  EXPECT_EQ(own->upper.crowns.triangles.rows(), 12);
  EXPECT_TRUE(own->lower.empty());
  inputs_.teeth = {};
  EXPECT_EQ(teeth_of(scene, inputs_, mesh_, notes_), nullptr);
  EXPECT_TRUE(notes_.empty());
}

TEST_F(TeethOfAFace, AreMissedWithANoteWhereLipsAreJoined) {
  mesh_.volume.outer = anatomy::canonical_face().mesh;
  EXPECT_EQ(teeth_of(Scene{}, inputs_, mesh_, notes_), nullptr);
  EXPECT_THAT(notes_, testing::ElementsAre(
                          AllOf(test::is_note("teeth.none"), test::says("lips are joined"))));
}

}  // namespace
}  // namespace hyperex::session
