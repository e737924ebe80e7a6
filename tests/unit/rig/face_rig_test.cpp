// SPDX-License-Identifier: GPL-3.0-or-later
// A rig of a coarse mesh of the embedded face: its shapes, and the file that is written.
#include "hyperex/rig/face_rig.hpp"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/rig_model.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/session/rig_face.hpp"
#include "unit/report/gltf_vectors.hpp"

namespace hyperex::rig {
namespace {

session::Face embedded() {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  session::Face out;
  out.scan.mesh = std::move(face.mesh);
  out.landmarks = std::move(face.landmarks);
  return out;
}

class RigOfAFace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig_ = std::make_unique<FaceRig>(make_rig(embedded(),
                                              {{"mesh.element_size_mm", 8}, {"mesh.layers", 1}},
                                              [](const Note& note) { notes_.push_back(note); }));
  }
  static void TearDownTestSuite() { rig_.reset(); }
  static const report::RigShape& shape(const std::string& name) {
    for (const report::RigShape& one : rig_->shapes)
      if (one.name == name) return one;
    throw std::out_of_range(name);
  }
  /// Displacement at weight 1 of the vertex next to a landmark, mm.
  static Vec3 moved_mm(const std::string& name, const std::string& landmark) {
    static const io::Landmarks landmarks = anatomy::embedded_face().landmarks;
    Eigen::Index vertex = 0;
    (skin().rowwise() - landmarks.at(landmark).transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&vertex);
    return 1e3 * shape(name).displacement_m.row(vertex).cast<double>().transpose();
  }
  static const Points& skin() { return rig_->performance.skin_rest.points; }
  static inline std::unique_ptr<FaceRig> rig_;
  static inline std::vector<Note> notes_;
};

TEST_F(RigOfAFace, NotesAreOfTheScanAlone) {
  EXPECT_TRUE(std::ranges::any_of(notes_, [](const Note& n) { return n.id == "teeth.average"; }));
  for (const Note& note : notes_) {
    for (const char* start : {"recording.", "drive."})
      EXPECT_FALSE(note.id.starts_with(start)) << note.text;
    EXPECT_EQ(note.text.find("drive.by"), std::string::npos) << note.text;
    EXPECT_EQ(note.text.find("tissue.strain"), std::string::npos) << note.text;
    EXPECT_EQ(note.text.find("contact.lips = true"), std::string::npos) << "it is on";
    if (note.id == "lips.pass_through" || note.id.ends_with("inverted")) {
      EXPECT_NE(note.text.find(" in the shape "), std::string::npos) << note.text;
    }
  }
}

TEST_F(RigOfAFace, HasAllNamesInOrderAndNothingAtTheTongue) {
  ASSERT_EQ(rig_->shapes.size(), 52u);
  for (std::size_t i = 0; i < 52; ++i) {
    const report::RigShape& one = rig_->shapes[i];
    EXPECT_EQ(one.name, expression::arkit_shapes()[i]);
    EXPECT_TRUE(one.displacement_m.allFinite()) << one.name;
    const double most_mm = 1e3 * double(one.displacement_m.rowwise().norm().maxCoeff());
    const bool eyes_alone = one.name.starts_with("eyeLookIn") || one.name.starts_with("eyeLookOut");
    if (eyes_alone || one.name == "tongueOut")
      EXPECT_EQ(most_mm, 0) << one.name;
    else
      EXPECT_GT(most_mm, 0.5) << one.name;
  }
}

TEST_F(RigOfAFace, MovesItsPlaces) {
  EXPECT_GT(moved_mm("mouthSmileLeft", "ibug68_54").y(), 3);
  EXPECT_GT(moved_mm("mouthSmileLeft", "ibug68_54").x(), 1);
  EXPECT_LT(moved_mm("mouthSmileLeft", "ibug68_48").norm(), 1.5);
  EXPECT_LT(moved_mm("jawOpen", "ibug68_8").y(), -15);
  EXPECT_GT(moved_mm("browInnerUp", "ibug68_21").y(), 2);
  EXPECT_GT(moved_mm("jawLeft", "ibug68_8").x(), 5);
}

TEST_F(RigOfAFace, ShapesOfTheLeftLeaveTheRightStill) {
  // These move lips or nose across the middle, in the public rig too (docs/rig.md).
  const std::map<std::string, double> wider = {{"mouthLowerDownLeft", 0.35},
                                               {"mouthPressLeft", 0.3},
                                               {"mouthUpperUpLeft", 0.2},
                                               {"noseSneerLeft", 0.2}};
  for (const report::RigShape& one : rig_->shapes) {
    if (!one.name.ends_with("Left") || one.name == "jawLeft" || one.name == "mouthLeft") continue;
    double left = 0, right = 0;
    for (Eigen::Index v = 0; v < skin().rows(); ++v)
      if (const double x = skin()(v, 0); std::abs(x) > 0.003)
        (x > 0 ? left : right) += double(one.displacement_m.row(v).norm());
    if (left == 0) continue;
    const auto own = wider.find(one.name);
    EXPECT_LT(right / left, own == wider.end() ? 0.12 : own->second) << one.name;
  }
}

TEST_F(RigOfAFace, MouthCloseClosesAnOpenMouth) {
  const io::Landmarks landmarks = anatomy::embedded_face().landmarks;
  const auto gap_mm = [&](double jaw, double close) {
    const auto height = [&](const char* landmark) {
      return 1e3 * landmarks.at(landmark).y() + jaw * moved_mm("jawOpen", landmark).y() +
             close * moved_mm("mouthClose", landmark).y();
    };
    return height("ibug68_62") - height("ibug68_66");
  };
  EXPECT_NEAR(gap_mm(0, 0), 0.2, 0.1);
  EXPECT_GT(gap_mm(0.7, 0), 9);
  EXPECT_NEAR(gap_mm(0.7, 0.7), 0, 0.5);
}

TEST_F(RigOfAFace, EyesAndJawTurn) {
  EXPECT_GT(shape("eyeLookUpLeft").left_eye->up_rad, 0.2);
  EXPECT_FALSE(shape("eyeLookUpLeft").right_eye);
  EXPECT_GT(shape("eyeLookOutLeft").left_eye->left_rad, 0.2) << "to the subject's left";
  EXPECT_LT(shape("eyeLookInLeft").left_eye->left_rad, -0.2);
  EXPECT_GT(shape("eyeLookInRight").right_eye->left_rad, 0.2);
  EXPECT_GT(Eigen::AngleAxisd(shape("jawOpen").jaw_now_from_rest.linear()).angle(), 0.15);
  EXPECT_TRUE(shape("browInnerUp").jaw_now_from_rest.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(rig_->closed_eyes.empty());
}

TEST_F(RigOfAFace, ItsLidsFollowTheIrisDownAndUp) {
  const double opening_mm = 1e3 * (anatomy::embedded_face().landmarks.at("ibug68_43") -
                                   anatomy::embedded_face().landmarks.at("ibug68_47"))
                                      .norm();
  const Vec3 upper = moved_mm("eyeLookDownLeft", "ibug68_43"),
             lower = moved_mm("eyeLookDownLeft", "ibug68_47");
  EXPECT_NEAR(upper.y(), moved_mm("eyeBlinkLeft", "ibug68_43").y(), 1) << "as in a blink";
  EXPECT_LT(lower.y(), -1.5) << "the lower lid makes room for the iris";
  EXPECT_GT(opening_mm + upper.y() - lower.y(), 2);
  EXPECT_GT(moved_mm("eyeLookUpLeft", "ibug68_43").y(), 2);
}

TEST_F(RigOfAFace, IsWrittenWithNamedTargets) {
  const auto file = std::filesystem::path(testing::TempDir()) / "face_rig_test.glb";
  const double bytes = report::write_rig_glb(file, rig_->performance, *rig_->scan,
                                             rig_->teeth.get(), rig_->jaw_axis_m, rig_->shapes);
  EXPECT_EQ(bytes, double(std::filesystem::file_size(file)));
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file)) << error;
  std::map<std::string, const tinygltf::Mesh*> meshes;
  for (const tinygltf::Node& node : model.nodes)
    meshes[node.name] = &model.meshes[std::size_t(node.mesh)];
  const auto names = [&](const std::string& node) {
    std::vector<std::string> out;
    const tinygltf::Value& list = meshes.at(node)->extras.Get("targetNames");
    for (std::size_t i = 0; i < list.ArrayLen(); ++i)
      out.push_back(list.Get(int(i)).Get<std::string>());
    return out;
  };
  EXPECT_EQ(names("face"), expression::arkit_shapes());
  for (const tinygltf::Primitive& part : meshes.at("face")->primitives)
    EXPECT_EQ(part.targets.size(), 52u) << "the pockets move along";
  EXPECT_EQ(names("eye_L"), (std::vector<std::string>{"eyeLookDownLeft", "eyeLookInLeft",
                                                      "eyeLookOutLeft", "eyeLookUpLeft"}));
  const auto of_jaw = names("lower_teeth");
  const auto place_of = [&](const char* name) {
    return std::size_t(std::find(of_jaw.begin(), of_jaw.end(), name) - of_jaw.begin());
  };
  // Places of the list above: down, in, out, up.
  const auto mean_mm = [&](const std::string& node, Eigen::Index first,
                           std::size_t target) -> Vec3 {
    const tinygltf::Primitive& crowns_or_eye = meshes.at(node)->primitives.at(0);
    const PointsF moved =
        report::testing::vectors_of(model, crowns_or_eye.targets.at(target).at("POSITION"));
    return 1e3 * moved.topRows(first > 0 ? first : moved.rows())
                     .cast<double>()
                     .colwise()
                     .mean()
                     .transpose();
  };
  // The eye's rows begin at the middle of its pupil; those of its back move the other way.
  constexpr Eigen::Index iris = 11 * 64, crowns = 0;
  EXPECT_LT(mean_mm("eye_L", iris, 0).y(), -2);
  EXPECT_LT(mean_mm("eye_L", iris, 1).x(), -2) << "in: to the subject's right";
  EXPECT_GT(mean_mm("eye_L", iris, 2).x(), 2);
  EXPECT_GT(mean_mm("eye_L", iris, 3).y(), 2);
  EXPECT_GT(mean_mm("eye_R", iris, 1).x(), 2);
  EXPECT_GT(mean_mm("lower_teeth", crowns, place_of("jawForward")).z(), 3);
  EXPECT_GT(mean_mm("lower_teeth", crowns, place_of("jawLeft")).x(), 3);
  EXPECT_LT(mean_mm("lower_teeth", crowns, place_of("jawOpen")).y(), -5);
  for (const tinygltf::Node& node : model.nodes)
    if (node.name == "eye_L") {
      ASSERT_EQ(node.translation.size(), 3u);
      EXPECT_GT(node.translation[0], 0.02) << "turned about its own middle";
    }
  std::filesystem::remove(file);
}

TEST_F(RigOfAFace, IsReadBackAndWeightsMoveItsLandmarks) {
  const auto file = std::filesystem::path(testing::TempDir()) / "face_rig_read_back.glb";
  report::write_rig_glb(file, rig_->performance, *rig_->scan, rig_->teeth.get(), rig_->jaw_axis_m,
                        rig_->shapes);
  const io::ShapedMesh read = io::read_gltf_shapes(file);
  std::filesystem::remove(file);
  ASSERT_EQ(read.shapes.size(), 52u);
  EXPECT_EQ(read.mesh.points.rows(), skin().rows()) << "the skin alone";
  for (std::size_t k = 0; k < read.shapes.size(); ++k) {
    EXPECT_EQ(read.shapes[k].name, rig_->shapes[k].name);
    EXPECT_LT((read.shapes[k].displacement_m - rig_->shapes[k].displacement_m)
                  .rowwise()
                  .norm()
                  .maxCoeff(),
              5.1e-5)
        << read.shapes[k].name << ": less is left out";
  }
  const expression::FaceModel model = expression::rig_model(read, read.landmarks, file);
  expression::BlendShapes weights;
  weights.names = {"mouthSmileLeft"};
  weights.time_s = {0, 1};
  weights.weights.resize(2, 1);
  weights.weights << 0, 1;
  std::vector<std::string> notes;
  const motion::Motion motion = expression::motion_of(weights, model, notes);
  const auto moved = [&](const char* name) -> Vec3 {
    const int row = motion.index_of(name);
    return 1e3 * (motion.positions[1].row(row) - motion.positions[0].row(row)).transpose();
  };
  for (const char* corner : {"ibug68_54", "ibug68_48"})
    EXPECT_LT((moved(corner) - moved_mm("mouthSmileLeft", corner)).norm(), 0.3) << corner;
  EXPECT_GT(moved("ibug68_54").norm(), 5);
}

/// Puts vertices of the lower lip within half a millimetre of the upper one onto it, as where a
/// closed mouth was cut open. Returns how many.
int close_mouth(TriMesh& skin) {
  const std::vector<double> margin =
      anatomy::upper_lip_margin(skin, anatomy::embedded_face().landmarks);
  int closed = 0;
  for (Eigen::Index v = 0; v < skin.points.rows(); ++v) {
    if (margin[std::size_t(v)] >= 0) continue;
    for (Eigen::Index u = 0; u < skin.points.rows(); ++u)
      if (margin[std::size_t(u)] > 0 && (skin.points.row(u) - skin.points.row(v)).norm() < 0.0005) {
        skin.points.row(v) = skin.points.row(u).eval();
        ++closed;
        break;
      }
  }
  return closed;
}

class RigWithAMouth : public RigOfAFace, public testing::WithParamInterface<bool> {};

/// Landmarks of a closed mouth lie on either lip by tenths of a millimetre.
TEST_P(RigWithAMouth, ItsLipsMoveApartThoughTheirPointsLieOnTheOtherLip) {
  simulate::Performance swapped = rig_->performance;
  if (GetParam()) {
    ASSERT_GT(close_mouth(swapped.skin_rest), 10);
  }
  motion::Motion& tracks = swapped.landmarks;
  const auto row = [&](const char* name) {
    return tracks.positions.front().row(tracks.index_of(name));
  };
  const Points upper = row("ibug68_62");
  row("ibug68_62") = row("ibug68_66").eval();
  row("ibug68_66") = upper;
  const auto file = std::filesystem::path(testing::TempDir()) / "face_rig_lips.glb";
  report::write_rig_glb(file, swapped, *rig_->scan, nullptr, rig_->jaw_axis_m, rig_->shapes);
  const expression::FaceModel model = session::rig_face(file, KeptResults());
  std::filesystem::remove(file);
  const auto moved_up_mm = [&](const char* name) -> double {
    for (const expression::DeformationUnit& unit : model.recorded_units)
      if (unit.arkit == "jawOpen")
        return 1e3 * unit.displacement_m(model.landmarks.at(name).at(0), 1);
    throw std::out_of_range("jawOpen");
  };
  EXPECT_GT(moved_up_mm("ibug68_62"), -8) << "the upper lip stays";
  EXPECT_LT(moved_up_mm("ibug68_66"), -15) << "the lower one goes with the jaw";
}

INSTANTIATE_TEST_SUITE_P(OpenOrOfOnePlace, RigWithAMouth, testing::Bool());

TEST_F(RigOfAFace, ShapesOfAnotherSkinAreRefused) {
  auto shapes = rig_->shapes;
  shapes[3].displacement_m.conservativeResize(10, 3);
  EXPECT_THROW(report::write_rig_glb("never.glb", rig_->performance, *rig_->scan, nullptr,
                                     rig_->jaw_axis_m, shapes),
               std::invalid_argument);
}

TEST(Rig, RefusesKeysThatAreNone) {
  EXPECT_THROW(make_rig(embedded(), {{"tissue.yung_kpa", 3}}), InputError);
  for (const char* key : {"time.frame_rate_hz", "time.end_s", "motion.gain", "drive.gain"})
    EXPECT_THROW(make_rig(embedded(), {{key, 2}}), InputError) << key << " would spoil the shapes";
}

}  // namespace
}  // namespace hyperex::rig
