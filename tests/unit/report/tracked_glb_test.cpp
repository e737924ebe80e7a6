// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/tracked_glb.hpp"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <filesystem>

#include "hyperex/core/error.hpp"
#include "support/test_file.hpp"
#include "unit/report/gltf_vectors.hpp"
#include "unit/report/made_up_tracking.hpp"

namespace hyperex::report {
namespace {

constexpr capture::Intrinsics kCamera{500, 500, 320, 240, 640, 480};

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A GLB and what a player makes of it.
class Player {
 public:
  explicit Player(const std::filesystem::path& file) {
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file.string()))
        << error << warning;
  }

  Rows rows(int accessor) const {
    const auto& a = model.accessors.at(accessor);
    const auto& view = model.bufferViews.at(a.bufferView);
    const auto* data =
        reinterpret_cast<const float*>(model.buffers[0].data.data() + view.byteOffset);
    return Eigen::Map<const Rows>(data, Eigen::Index(a.count),
                                  tinygltf::GetNumComponentsInType(a.type));
  }

  bool has(const std::string& path) const { return find(path) != nullptr; }

  /// The value at a key, or the last one before `time_s`.
  Eigen::VectorXf at(const std::string& path, double time_s) const {
    const auto& sampler = model.animations.at(0).samplers.at(find(path)->sampler);
    const Rows times = rows(sampler.input), values = rows(sampler.output);
    Eigen::Index key = 0;
    while (key + 1 < times.rows() && times(key + 1, 0) <= time_s + 1e-4) ++key;
    const Eigen::Index width = values.size() / times.rows();
    return Eigen::Map<const Eigen::VectorXf>(values.data() + key * width, width);
  }

  /// Where the vertices are in the scene, by the tree of nodes.
  Points vertices(double time_s) const {
    const auto& face = model.meshes.at(0).primitives.at(0);
    Rows at_rest = rows(face.attributes.at("POSITION"));
    const Eigen::VectorXf weights = at("weights", time_s);
    for (std::size_t k = 0; k < face.targets.size(); ++k)
      at_rest +=
          weights[Eigen::Index(k)] * testing::vectors_of(model, face.targets[k].at("POSITION"));
    const Eigen::Vector4f q = at("rotation", time_s);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    const Vec3 shift = at("translation", time_s).cast<double>();
    const auto& up = model.nodes.at(1).rotation;
    const Eigen::Quaterniond scene_from_camera(up[3], up[0], up[1], up[2]);
    Points out = at_rest.cast<double>();
    for (Eigen::Index v = 0; v < out.rows(); ++v)
      out.row(v) = (scene_from_camera * (turn * Vec3(out.row(v)) + shift)).transpose();
    return out;
  }

  tinygltf::Model model;

 private:
  const tinygltf::AnimationChannel* find(const std::string& path) const {
    for (const auto& channel : model.animations.at(0).channels)
      if (channel.target_path == path && model.nodes.at(channel.target_node).name == "head")
        return &channel;
    return nullptr;
  }
};

std::filesystem::path write(const tracking::Tracking& tracking) {
  const auto file = test_file("tracked.glb");
  write_tracked_glb(file, expression::canonical_model(), tracking, kCamera);
  return file;
}

TEST(TrackedGlb, PlaysTheFaceWhereTheCameraSawIt) {
  const auto tracking = testing::made_up_tracking(90);
  const Player player(write(tracking));
  for (const int k : {0, 11, 39, 50, 89}) {
    const auto& frame = tracking.frames[std::size_t(k)];
    const Points shown = player.vertices(frame.time_s - tracking.frames[0].time_s);
    for (Eigen::Index v = 0; v < shown.rows(); ++v) {
      const Vec3 seen = frame.camera_from_head * Vec3(frame.vertices_m.row(v));
      // y up, and the camera looks along -z.
      EXPECT_LT((Vec3(shown.row(v)) - Vec3(seen.x(), -seen.y(), -seen.z())).norm(), 3.2e-4)
          << k << ' ' << v;
    }
  }
  ASSERT_EQ(player.model.cameras.size(), 1u);
  EXPECT_NEAR(std::tan(player.model.cameras[0].perspective.yfov / 2), 0.48, 1e-6);
}

TEST(TrackedGlb, ShowsNothingWhereFramesAreNotValid) {
  const Player player(write(testing::made_up_tracking(90)));
  for (int k = 0; k < 90; ++k) {
    const bool valid = !((k >= 40 && k < 50) || k == 60);
    EXPECT_TRUE(player.at("scale", k / 30.0) == Eigen::Vector3f::Constant(valid ? 1 : 0)) << k;
  }
  EXPECT_FALSE(Player(write(testing::made_up_tracking(40))).has("scale"));
}

TEST(TrackedGlb, TurnsTheShortWay) {
  auto tracking = testing::made_up_tracking(40);
  for (std::size_t k = 0; k < 40; ++k)  // across the half turn, where quaternions flip
    tracking.frames[k].camera_from_head.linear() =
        Eigen::AngleAxisd(3.0 + 0.01 * double(k), Vec3::UnitX()).toRotationMatrix();
  const Player player(write(tracking));
  for (int k = 1; k < 40; ++k)
    EXPECT_GT(player.at("rotation", k / 30.0).dot(player.at("rotation", (k - 1) / 30.0)), 0.99)
        << k;
}

TEST(TrackedGlb, RefusesWhatItCannotWrite) {
  auto tracking = testing::made_up_tracking(5);
  EXPECT_THROW(
      write_tracked_glb("/nowhere/x.glb", expression::canonical_model(), tracking, kCamera),
      InputError);
  tracking.neutral->points_m.conservativeResize(100, 3);
  EXPECT_THROW(write(tracking), std::invalid_argument);
  tracking.neutral.reset();
  EXPECT_THROW(write(tracking), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::report
