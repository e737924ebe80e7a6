// SPDX-License-Identifier: GPL-3.0-or-later
// A rig's file with a corrective: the sum of its targets and those of its two shapes is the face
// that shows both.
#include "hyperex/report/rig_glb.hpp"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/skin_view.hpp"
#include "support/test_file.hpp"
#include "unit/report/gltf_vectors.hpp"
#include "unit/report/made_up_face.hpp"

namespace hyperex::report {
namespace {

/// Shapes are frames of the made-up face, twice as far, so that normals turn by half a radian.
class RigGlb : public ::testing::Test {
 protected:
  static constexpr std::size_t kOpen = 15, kClose = 12, kBoth = 14;

  RigGlb() {
    RigShape open{.name = "jawOpen"}, close{.name = "mouthClose"};
    open.displacement_m = moved(kOpen);
    open.jaw_now_from_rest = jaw(kOpen);
    close.displacement_m = moved(kClose);
    RigShape both{.name = "jawOpen_mouthClose"};
    both.displacement_m = moved(kBoth) - moved(kOpen) - moved(kClose);
    both.jaw_now_from_rest.matrix() += jaw(kBoth).matrix() - jaw(kOpen).matrix();
    both.corrects = std::array<std::size_t, 2>{0, 1};
    shapes_ = {open, close, both};
  }
  PointsF moved(std::size_t frame) const {
    return 2 * face_.performance.skin_displacement_m[frame];
  }
  const Eigen::Isometry3d& jaw(std::size_t frame) const {
    return face_.performance.jaw_now_from_rest[frame];
  }
  tinygltf::Model written(const std::vector<RigShape>& shapes) const {
    const auto file = test_file("rig_glb_pair.glb");
    write_rig_glb(file, face_.performance, face_.scan, &teeth_, axis_m_, shapes);
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file.string()))
        << error << warning;
    return model;
  }
  static const tinygltf::Mesh& mesh_of(const tinygltf::Model& model, const std::string& node) {
    for (const tinygltf::Node& one : model.nodes)
      if (one.name == node) return model.meshes.at(std::size_t(one.mesh));
    throw std::out_of_range(node);
  }
  static std::vector<std::string> target_names(const tinygltf::Mesh& mesh) {
    std::vector<std::string> names;
    const tinygltf::Value& list = mesh.extras.Get("targetNames");
    for (std::size_t i = 0; i < list.ArrayLen(); ++i)
      names.push_back(list.Get(int(i)).Get<std::string>());
    return names;
  }
  /// At rest plus all targets: every weight is 1.
  static PointsF with_all(const tinygltf::Model& model, const tinygltf::Primitive& part,
                          const std::string& attribute) {
    PointsF sum = testing::vectors_of(model, part.attributes.at(attribute));
    for (const auto& target : part.targets) sum += testing::vectors_of(model, target.at(attribute));
    return sum;
  }

  testing::MadeUpFace face_ = testing::made_up_face(testing::Surface::plain);
  anatomy::Teeth teeth_ = testing::made_up_teeth();
  Vec3 axis_m_ = {0, 0.02, -0.05};
  std::vector<RigShape> shapes_;
};

constexpr float kLeftOut_m = 5e-5F;  // of each target
constexpr float kNormalLeftOut = 0.02F;

TEST_F(RigGlb, SkinAndNormalsOfAPairAreThoseOfTheFaceThatShowsBoth) {
  const tinygltf::Model model = written(shapes_);
  const tinygltf::Mesh& skin = mesh_of(model, "face");
  EXPECT_EQ(target_names(skin),
            (std::vector<std::string>{"jawOpen", "mouthClose", "jawOpen_mouthClose"}));
  EXPECT_EQ(skin.weights, std::vector<double>(3, 0));
  const TriMesh& rest = face_.performance.skin_rest;
  const PointsF truth = rest.points.cast<float>() + moved(kBoth);
  EXPECT_LT((with_all(model, skin.primitives[0], "POSITION") - truth).rowwise().norm().maxCoeff(),
            3.01F * kLeftOut_m);
  EXPECT_LT((with_all(model, skin.primitives[0], "NORMAL") - vertex_normals(truth, rest.triangles))
                .rowwise()
                .norm()
                .maxCoeff(),
            3.01F * kNormalLeftOut);
}

TEST_F(RigGlb, TeethAndLiningOfAPairFollowItsJaw) {
  const tinygltf::Model model = written(shapes_);
  const auto openings = face_backing(face_.performance, &teeth_).openings;
  ASSERT_EQ(openings.size(), 1u);
  const Points skin = face_.performance.skin_rest.points + moved(kBoth).cast<double>();
  const PointsF lining = with_all(model, mesh_of(model, "face").primitives.at(1), "POSITION");
  EXPECT_LT((lining.cast<double>() - pocket(openings[0], skin, jaw(kBoth)).points)
                .rowwise()
                .norm()
                .maxCoeff(),
            6.1 * kLeftOut_m);
  const tinygltf::Mesh& teeth = mesh_of(model, "lower_teeth");
  EXPECT_EQ(target_names(teeth), (std::vector<std::string>{"jawOpen", "jawOpen_mouthClose"}));
  for (const tinygltf::Primitive& part : teeth.primitives) {
    const Points rest =
        testing::vectors_of(model, part.attributes.at("POSITION")).cast<double>().rowwise() +
        axis_m_.transpose();
    const Points now =
        with_all(model, part, "POSITION").cast<double>().rowwise() + axis_m_.transpose();
    double off_m = 0, turned_m = 0;
    for (Eigen::Index v = 0; v < rest.rows(); ++v) {
      const Vec3 there = jaw(kBoth) * rest.row(v).transpose();
      off_m = std::max(off_m, (now.row(v).transpose() - there).norm());
      turned_m = std::max(turned_m, (now.row(v) - rest.row(v)).norm());
    }
    EXPECT_LT(off_m, 1e-6);
    EXPECT_GT(turned_m, 1e-3);
  }
}

TEST_F(RigGlb, OtherShapesAreAsWithoutCorrectives) {
  const tinygltf::Model with = written(shapes_);
  const tinygltf::Model without = written({shapes_[0], shapes_[1]});
  const tinygltf::Mesh &skin = mesh_of(with, "face"), &plain = mesh_of(without, "face");
  EXPECT_EQ(target_names(plain), (std::vector<std::string>{"jawOpen", "mouthClose"}));
  ASSERT_EQ(skin.primitives.size(), plain.primitives.size());
  for (std::size_t i = 0; i < plain.primitives.size(); ++i) {
    ASSERT_EQ(plain.primitives[i].targets.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k)
      for (const auto& [attribute, accessor] : plain.primitives[i].targets[k])
        EXPECT_EQ(testing::vectors_of(with, skin.primitives[i].targets[k].at(attribute)),
                  testing::vectors_of(without, accessor))
            << attribute;
  }
}

TEST_F(RigGlb, ACorrectiveStandsBehindItsShapes) {
  std::swap(shapes_[1], shapes_[2]);
  EXPECT_THROW(written(shapes_), std::invalid_argument);
  std::swap(shapes_[1], shapes_[2]);
  shapes_[2].corrects = std::array<std::size_t, 2>{0, 2};
  EXPECT_THROW(written(shapes_), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::report
