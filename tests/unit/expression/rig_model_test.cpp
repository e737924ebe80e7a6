// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/rig_model.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/correctives.hpp"
#include "support/refusal.hpp"

namespace hyperex::expression {
namespace {

/// A square of two triangles with one shape.
io::ShapedMesh square(const std::string& shape) {
  io::ShapedMesh rig;
  rig.mesh.points.resize(4, 3);
  rig.mesh.points << 0, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0, 0, 0.1, 0;
  rig.mesh.triangles.resize(2, 3);
  rig.mesh.triangles << 0, 1, 2, 0, 2, 3;
  PointsF moved = PointsF::Zero(4, 3);
  moved.row(1) << 0, 0, 0.01F;
  moved.row(2) << 0, 0.02F, 0;
  rig.shapes.push_back({shape, moved});
  return rig;
}

TEST(RigModel, WeightsMoveALandmarkAsTheyMoveTheSkinBelowIt) {
  const io::Landmarks landmarks = {{"pogonion", {0.08, 0.04, 0.003}}, {"nasion", {0, 0, 0}}};
  const FaceModel model = rig_model(square("jawOpen"), landmarks, "rig.glb");
  BlendShapes weights;
  weights.names = {"jawOpen"};
  weights.time_s = {0, 1};
  weights.weights.resize(2, 1);
  weights.weights << 0, 0.5;
  std::vector<std::string> notes;
  const motion::Motion motion = motion_of(weights, model, notes);
  const int chin = motion.index_of("pogonion"), nose = motion.index_of("nasion");
  EXPECT_LT((motion.positions[0].row(chin).transpose() - Vec3(0.08, 0.04, 0)).norm(), 1e-12)
      << "on the skin";
  // Barycentric weights of the triangle's corners 0, 1, 2 there: 0.2, 0.4, 0.4.
  const Vec3 moved = 0.5 * (0.4 * Vec3(0, 0, 0.01) + 0.4 * Vec3(0, 0.02, 0));
  EXPECT_LT((motion.positions[1].row(chin).transpose() - Vec3(0.08, 0.04, 0) - moved).norm(), 1e-9);
  EXPECT_LT(motion.positions[1].row(nose).norm(), 1e-12);
}

TEST(RigModel, KnowsTheNamesThatRigsUse) {
  const io::Landmarks landmarks = {{"nasion", {0, 0, 0}}};
  const auto name = [&](const std::string& shape) {
    return rig_model(square(shape), landmarks, "rig.glb").recorded_units.at(0).arkit;
  };
  EXPECT_EQ(name("jawOpen"), "jawOpen");
  EXPECT_EQ(name("JawOpen"), "jawOpen");
  EXPECT_EQ(name("mouthSmile_L"), "mouthSmileLeft");
  EXPECT_EQ(name("EyeBlink_R"), "eyeBlinkRight");
  EXPECT_EQ(name("browInnerUp_L"), "browInnerUp") << "in which ARKit knows no sides";
  const auto refused = [&](const io::ShapedMesh& rig, const io::Landmarks& at) {
    return test::refusal<InputError>([&] { rig_model(rig, at, "rig.glb"); });
  };
  EXPECT_EQ(refused(square("PupilDilate_L"), landmarks),
            "rig.glb: has no morph target with a name of ARKit's, such as jawOpen");
  EXPECT_EQ(refused(square("jawOpen"), {}), "rig.glb: has no landmarks");
}

/// The square with more shapes: each lifts all by so many centimetres.
io::ShapedMesh lifting_square(const std::vector<std::pair<std::string, float>>& shapes) {
  io::ShapedMesh rig = square("");
  rig.shapes.clear();
  for (const auto& [name, by_cm] : shapes) {
    PointsF moved = PointsF::Zero(4, 3);
    moved.col(1).setConstant(0.01F * by_cm);
    rig.shapes.push_back({name, moved});
  }
  return rig;
}

/// How far up (cm) weights of jawOpen and mouthSmileLeft move the nasion.
double lifted_cm(const io::ShapedMesh& rig, double jaw, double smile) {
  const FaceModel model = rig_model(rig, {{"nasion", {0, 0, 0}}}, "rig.glb");
  BlendShapes weights;
  weights.names = {"jawOpen", "mouthSmileLeft"};
  weights.time_s = {0, 1};
  weights.weights.resize(2, 2);
  weights.weights << 0, 0, jaw, smile;
  std::vector<std::string> notes;
  return 100 * motion_of(weights, model, notes).positions[1](0, 1);
}

TEST(RigModel, ACorrectiveHasTheProductOfTwoWeights) {
  const io::ShapedMesh rig =
      lifting_square({{"jawOpen", 1}, {"mouthSmileLeft", 2}, {"jawOpen_mouthSmileLeft", 4}});
  EXPECT_NEAR(lifted_cm(rig, 1, 0), 1, 1e-6);
  EXPECT_NEAR(lifted_cm(rig, 0, 1), 2, 1e-6);
  EXPECT_NEAR(lifted_cm(rig, 1, 1), 1 + 2 + 4, 1e-6);
  EXPECT_NEAR(lifted_cm(rig, 0.5, 0.3), 0.5 + 0.6 + 0.15 * 4, 1e-6);
  EXPECT_NEAR(
      lifted_cm(lifting_square({{"JawOpen", 1}, {"MouthSmile_L", 2}, {"JawOpen_MouthSmile_L", 4}}),
                0.5, 0.3),
      0.5 + 0.6 + 0.15 * 4, 1e-6)
      << "as other rigs write them";
}

TEST(RigModel, ACorrectiveOfAShapeThatTheRigLacksIsPassedOver) {
  const io::ShapedMesh rig = lifting_square({{"jawOpen", 1}, {"jawOpen_mouthSmileLeft", 4}});
  EXPECT_NEAR(lifted_cm(rig, 1, 1), 1, 1e-6);
  EXPECT_EQ(rig_model(rig, {{"nasion", {0, 0, 0}}}, "rig.glb").recorded_units.size(), 1u);
}

TEST(RigModel, ACorrectiveRestsWhereTheRecordingLacksAShape) {
  const FaceModel model = rig_model(
      lifting_square({{"jawOpen", 1}, {"mouthSmileLeft", 2}, {"jawOpen_mouthSmileLeft", 4}}),
      {{"nasion", {0, 0, 0}}}, "rig.glb");
  BlendShapes weights;
  weights.names = {"jawOpen"};
  weights.time_s = {0, 1};
  weights.weights.resize(2, 1);
  weights.weights << 0, 1;
  std::vector<std::string> notes;
  EXPECT_NEAR(100 * motion_of(weights, model, notes).positions[1](0, 1), 1, 1e-6);
}

TEST(RigModel, KnowsTheNamesOfCorrectives) {
  const auto pair = [](const std::string& name) {
    const std::optional<ShapePair> found = corrected_pair(name);
    return found ? found->first + " " + found->second : "none";
  };
  EXPECT_EQ(corrective_name({"jawOpen", "mouthClose"}), "jawOpen_mouthClose");
  EXPECT_EQ(pair("jawOpen_mouthClose"), "jawOpen mouthClose");
  EXPECT_EQ(pair("MouthFunnel_MouthSmileRight"), "mouthFunnel mouthSmileRight");
  EXPECT_EQ(pair("mouthSmile_L_jawOpen"), "mouthSmileLeft jawOpen");
  for (const char* none : {"jawOpen", "mouthSmile_L", "jawOpen_", "_jawOpen", "jawOpen_jawOpen",
                           "jawOpen_smile", "jawOpen_mouthClose_mouthFunnel", "browInnerUp_L", ""})
    EXPECT_EQ(pair(none), "none") << none;
}

/// Two squares that touch along y = 0, as closed lips do; of the shape only the lower one moves.
io::ShapedMesh touching_lips() {
  io::ShapedMesh rig;
  rig.mesh.points.resize(8, 3);
  rig.mesh.points << 0, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0, 0, 0.1, 0,  // upper
      0, -0.1, 0, 0.1, -0.1, 0, 0.1, 0, 0, 0, 0, 0;
  rig.mesh.triangles.resize(4, 3);
  rig.mesh.triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  PointsF moved = PointsF::Zero(8, 3);
  moved.bottomRows(4).col(1).setConstant(-0.03F);
  rig.shapes.push_back({"jawOpen", moved});
  return rig;
}

TEST(RigModel, PointsOfALipMoveWithThatLipWhereTheOtherIsNearer) {
  const io::Landmarks landmarks = {{"ibug68_62", {0.05, -0.0004, 0}},  // on the lower lip's side
                                   {"ibug68_66", {0.05, 0.0004, 0}},
                                   {"cheek_L", {0.05, -0.0004, 0}}};
  const RigLips lips = {{1, 1, 1, 1, -1, -1, -1, -1}, {{"ibug68_62", 1}, {"ibug68_66", -1}}};
  const FaceModel model = rig_model(touching_lips(), landmarks, "rig.glb", lips);
  const auto down_mm = [&](const char* name) {
    return -1e3 * model.recorded_units.at(0).displacement_m(model.landmarks.at(name).at(0), 1);
  };
  EXPECT_NEAR(down_mm("ibug68_62"), 0, 1e-6);
  EXPECT_NEAR(down_mm("ibug68_66"), 30, 1e-5);
  EXPECT_NEAR(down_mm("cheek_L"), 30, 1e-5) << "of no lip: the nearest";
}

}  // namespace
}  // namespace hyperex::expression
