// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/correctives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/rig_model.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/rig/face_rig.hpp"

namespace hyperex::rig {
namespace {

std::vector<std::string> names_of_correctives() {
  std::vector<std::string> names;
  for (const expression::ShapePair& pair : clashing_pairs())
    names.push_back(expression::corrective_name(pair));
  return names;
}

TEST(Correctives, AreOfSevenPairsInTheOrderOfARKitsShapes) {
  EXPECT_EQ(
      names_of_correctives(),
      (std::vector<std::string>{"jawOpen_mouthClose", "jawOpen_mouthFunnel", "jawOpen_mouthPucker",
                                "jawOpen_mouthSmileLeft", "jawOpen_mouthSmileRight",
                                "mouthFunnel_mouthSmileLeft", "mouthFunnel_mouthSmileRight"}));
  const auto& all = expression::arkit_shapes();
  const auto place = [&](const std::string& name) {
    const auto at = std::ranges::find(all, name);
    EXPECT_NE(at, all.end()) << name;
    return at - all.begin();
  };
  for (const expression::ShapePair& pair : clashing_pairs())
    EXPECT_LT(place(pair.first), place(pair.second));
}

TEST(Correctives, HaveTheProductOfTwoWeights) {
  std::vector<report::RigShape> shapes;
  for (const auto& [name, by_m] :
       {std::pair{"jawOpen", 1.0F}, {"mouthClose", 2.0F}, {"both", 4.0F}}) {
    report::RigShape shape{.name = name};
    shape.displacement_m = PointsF::Constant(2, 3, by_m);
    shapes.push_back(shape);
  }
  shapes[2].corrects = std::array<std::size_t, 2>{0, 1};
  const auto moved = [&](const std::map<std::string, double>& weights) {
    return skin_at(shapes, weights)(1, 2);
  };
  EXPECT_FLOAT_EQ(moved({{"jawOpen", 0.5}}), 0.5F);
  EXPECT_FLOAT_EQ(moved({{"mouthClose", 1}, {"both", 1}}), 2) << "no weight of its own";
  EXPECT_FLOAT_EQ(moved({{"jawOpen", 0.5}, {"mouthClose", 0.3}}), 0.5F + 0.6F + 0.15F * 4);
  EXPECT_FLOAT_EQ(moved({}), 0);
}

FaceRig rig_of_embedded(Correctives correctives) {
  anatomy::EmbeddedFace from = anatomy::embedded_face();
  session::Face face;
  face.scan.mesh = std::move(from.mesh);
  face.landmarks = std::move(from.landmarks);
  return make_rig(std::move(face), {{"mesh.element_size_mm", 8}, {"mesh.layers", 1}}, {},
                  correctives);
}

/// The frame at the end of a pose's hold; there is one pose a second (shape_motion.hpp).
std::size_t frame_of_pose(const simulate::Performance& performance, std::size_t pose) {
  const double at_s = performance.frame_time_s.front() + double(pose) + 0.8;
  std::size_t nearest = 0;
  for (std::size_t f = 0; f < performance.frame_time_s.size(); ++f)
    if (std::abs(performance.frame_time_s[f] - at_s) <
        std::abs(performance.frame_time_s[nearest] - at_s))
      nearest = f;
  return nearest;
}

/// Poses before those of pairs: the shapes without five that move no skin, and a second one for
/// mouthClose.
constexpr std::size_t kPosesOfShapes = 52 - 5 + 1;

TEST(RigWithCorrectives, WithBothShapesIsTheSimulatedPair) {
  const FaceRig rig = rig_of_embedded(Correctives::of_clashing_pairs);
  ASSERT_EQ(rig.shapes.size(), 59u);
  for (std::size_t k = 0; k < 52; ++k) {
    EXPECT_EQ(rig.shapes[k].name, expression::arkit_shapes()[k]);
    EXPECT_FALSE(rig.shapes[k].corrects);
  }
  for (std::size_t i = 0; i < clashing_pairs().size(); ++i) {
    const report::RigShape& shape = rig.shapes[52 + i];
    EXPECT_EQ(shape.name, names_of_correctives()[i]);
    ASSERT_TRUE(shape.corrects) << shape.name;
    const auto& [first, second] = *shape.corrects;
    EXPECT_EQ(rig.shapes[first].name, clashing_pairs()[i].first);
    EXPECT_EQ(rig.shapes[second].name, clashing_pairs()[i].second);
    const std::size_t frame = frame_of_pose(rig.performance, kPosesOfShapes + i);
    const PointsF& simulated = rig.performance.skin_displacement_m.at(frame);
    const PointsF played =
        skin_at(rig.shapes, {{rig.shapes[first].name, 1}, {rig.shapes[second].name, 1}});
    EXPECT_LT((played - simulated).rowwise().norm().maxCoeff(), 1e-6) << shape.name;
    if (rig.shapes[first].name == "jawOpen") {
      const Eigen::Matrix4d jaw = rig.shapes[first].jaw_now_from_rest.matrix() +
                                  rig.shapes[second].jaw_now_from_rest.matrix() +
                                  shape.jaw_now_from_rest.matrix() -
                                  2 * Eigen::Matrix4d::Identity();
      EXPECT_LT((jaw - rig.performance.jaw_now_from_rest.at(frame).matrix()).norm(), 1e-12)
          << shape.name;
    }
  }
  const auto file = std::filesystem::path(testing::TempDir()) / "rig_with_correctives.glb";
  report::write_rig_glb(file, rig.performance, *rig.scan, rig.teeth.get(), rig.jaw_axis_m,
                        rig.shapes);
  const io::ShapedMesh read = io::read_gltf_shapes(file);
  std::filesystem::remove(file);
  ASSERT_EQ(read.shapes.size(), 59u);
  EXPECT_EQ(read.shapes[52].name, "jawOpen_mouthClose");
  const expression::FaceModel model = expression::rig_model(read, read.landmarks, file);
  EXPECT_EQ(model.recorded_units.at(52).arkit, "jawOpen");
  EXPECT_EQ(model.recorded_units.at(52).arkit_factor, "mouthClose");
}

TEST(RigWithCorrectives, LeavesTheShapesAsTheyAre) {
  const FaceRig plain = rig_of_embedded(Correctives::none);
  ASSERT_EQ(plain.shapes.size(), 52u);
  const FaceRig rig = rig_of_embedded(Correctives::of_clashing_pairs);
  for (std::size_t k = 0; k < plain.shapes.size(); ++k) {
    EXPECT_FALSE(plain.shapes[k].corrects);
    EXPECT_LT(
        (plain.shapes[k].displacement_m - rig.shapes[k].displacement_m).rowwise().norm().maxCoeff(),
        8e-5)
        << plain.shapes[k].name;
  }
}

}  // namespace
}  // namespace hyperex::rig
