// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/glb.hpp"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <filesystem>

#include "hyperex/core/error.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/skin_view.hpp"
#include "support/test_file.hpp"
#include "unit/report/gltf_vectors.hpp"
#include "unit/report/made_up_face.hpp"

namespace hyperex::report {
namespace {

using testing::made_up_face;
using testing::Surface;
using testing::vectors_of;

std::filesystem::path scratch(const std::string& name) {
  return test_file(name);
}

tinygltf::Model read_back(const std::filesystem::path& file) {
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file.string()))
      << error << warning;
  return model;
}

template <typename T, int Columns>
auto rows_of(const tinygltf::Model& model, int accessor) {
  const auto& a = model.accessors.at(accessor);
  const auto& view = model.bufferViews.at(a.bufferView);
  const auto* data = reinterpret_cast<const T*>(model.buffers[0].data.data() + view.byteOffset);
  using Rows = Eigen::Matrix<T, Eigen::Dynamic, Columns, Columns == 1 ? 0 : Eigen::RowMajor>;
  return Rows(Eigen::Map<const Rows>(data, static_cast<Eigen::Index>(a.count), Columns));
}

/// What a player shows of a part of the skin's mesh in a frame, from the file alone.
PointsF played(const tinygltf::Model& model, const std::string& attribute, int frame,
               std::size_t part = 0) {
  const auto& skin = model.meshes[0].primitives[part];
  const auto& sampler = model.animations.at(0).samplers.at(0);
  const auto weights = rows_of<float, 1>(model, sampler.output);
  PointsF out = rows_of<float, 3>(model, skin.attributes.at(attribute));
  for (std::size_t k = 0; k < skin.targets.size(); ++k)
    out += weights[frame * static_cast<Eigen::Index>(skin.targets.size()) + k] *
           vectors_of(model, skin.targets[k].at(attribute));
  return out;
}

TEST(Glb, PlaysThePerformance) {
  const auto face = made_up_face(Surface::plain);
  const auto file = scratch("plays.glb");
  const GlbReport report = write_glb(file, face.performance, face.scan, {.tolerance_m = 2e-5});
  EXPECT_LE(report.max_error_m, 2e-5);
  EXPECT_EQ(report.bytes, double(std::filesystem::file_size(file)));
  const auto model = read_back(file);
  const auto times = rows_of<float, 1>(model, model.animations.at(0).samplers.at(0).input);
  ASSERT_EQ(times.size(), 31);
  EXPECT_FLOAT_EQ(times[30], 1.0f);
  for (const int f : {0, 7, 15, 30}) {
    const PointsF truth =
        face.performance.skin_rest.points.cast<float>() + face.performance.skin_displacement_m[f];
    EXPECT_LT((played(model, "POSITION", f) - truth).rowwise().norm().maxCoeff(), 2.1e-5) << f;
    const PointsF shown = played(model, "NORMAL", f).rowwise().normalized();
    const PointsF normals = vertex_normals(truth, face.performance.skin_rest.triangles);
    // Fitted normals: within 3 degrees of the true ones, where those at rest are off by 14.
    EXPECT_GT(shown.cwiseProduct(normals).rowwise().sum().minCoeff(), std::cos(0.052)) << f;
  }
}

TEST(Glb, KeysArePosesWithTheirTimesForNamesAndWeightsFromZeroToOne) {
  const auto face = made_up_face(Surface::plain);
  const auto file = scratch("keys.glb");
  const GlbReport report = write_glb(file, face.performance, face.scan);
  const auto model = read_back(file);
  const auto& names = model.meshes[0].extras.Get("targetNames");
  ASSERT_EQ(names.ArrayLen(), report.keys);
  const auto weights = rows_of<float, 1>(model, model.animations.at(0).samplers.at(0).output);
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_EQ(weights.maxCoeff(), 1);
  const auto keys = static_cast<Eigen::Index>(report.keys);
  for (Eigen::Index k = 0; k < keys; ++k) {
    const auto name = names.Get(int(k)).Get<std::string>();
    ASSERT_TRUE(name.starts_with("pose_") && name.ends_with("s")) << name;
    const auto frame = std::lround(30 * std::stod(name.substr(5)));  // frames come at 30 Hz
    EXPECT_EQ(weights[frame * keys + k], 1) << "the face in that frame is the key";
    const auto at = model.meshes[0].primitives[0].targets[std::size_t(k)].at("POSITION");
    const PointsF& pose = face.performance.skin_displacement_m[std::size_t(frame)];
    // What moves less than a twentieth of the tolerance may be left out.
    EXPECT_LE((vectors_of(model, at) - pose).rowwise().norm().maxCoeff(), 1e-4 / 20);
  }
}

TEST(Glb, LeavesKeysOutWhereTheFileWouldBeTooLargeAndTellsTheError) {
  auto face = made_up_face(Surface::plain);
  auto& frames = face.performance.skin_displacement_m;
  for (std::size_t f = 0; f < frames.size(); ++f)  // jitter, which no other frame has
    for (Eigen::Index i = 0; i < frames[f].size(); ++i)
      frames[f].data()[i] += 5e-4F * float(std::sin(0.1 * double((f + 1) * (f + 7)) * double(i)));
  const auto file = scratch("small.glb");
  const GlbReport whole = write_glb(file, face.performance, face.scan, {2e-4, 1e9});
  EXPECT_LE(whole.max_error_m, 2e-4);
  const GlbReport small = write_glb(file, face.performance, face.scan, {2e-4, 3e5});
  EXPECT_LE(small.bytes, 3e5);
  EXPECT_GT(small.bytes, 2e5) << "as many as fit";
  EXPECT_LT(small.keys, whole.keys);
  EXPECT_GT(small.max_error_m, 2e-4);
}

TEST(Glb, StoresWhatMovesAndCountsTheRestAsError) {
  auto face = made_up_face(Surface::plain);
  constexpr double tolerance_m = 1e-4;
  Eigen::Index moving = 0, vertices = 0;
  for (PointsF& frame : face.performance.skin_displacement_m) {
    vertices = frame.rows();
    moving = vertices / 4;
    frame.bottomRows(vertices - moving).setConstant(2e-6F);  // 3.5 um: for no eye
  }
  const auto file = scratch("few_move.glb");
  const GlbReport report =
      write_glb(file, face.performance, face.scan, {.tolerance_m = tolerance_m});
  EXPECT_LE(report.max_error_m, tolerance_m);
  EXPECT_GE(report.max_error_m, 3.4e-6) << "the report includes what was left out";
  const auto model = read_back(file);
  for (const auto& target : model.meshes[0].primitives[0].targets) {
    const auto& position = model.accessors.at(std::size_t(target.at("POSITION")));
    ASSERT_TRUE(position.sparse.isSparse);
    EXPECT_LE(position.sparse.count, int(moving));
    const PointsF values = vectors_of(model, target.at("POSITION"));
    for (int k = 0; k < 3; ++k) {
      EXPECT_FLOAT_EQ(float(position.minValues.at(k)), values.col(k).minCoeff());
      EXPECT_FLOAT_EQ(float(position.maxValues.at(k)), values.col(k).maxCoeff());
    }
  }
}

TEST(Glb, SplitsVerticesAtSeamsAndKeepsThePicture) {
  const auto face = made_up_face(Surface::textured);
  const auto file = scratch("textured.glb");
  write_glb(file, face.performance, face.scan);
  const auto model = read_back(file);
  const auto& skin = model.meshes[0].primitives[0];
  const auto position = rows_of<float, 3>(model, skin.attributes.at("POSITION"));
  const auto uv = rows_of<float, 2>(model, skin.attributes.at("TEXCOORD_0"));
  const auto corner = rows_of<unsigned, 1>(model, skin.indices);
  EXPECT_GT(position.rows(), face.performance.skin_rest.points.rows());
  ASSERT_EQ(corner.size(), face.performance.skin_rest.triangles.size());
  for (Eigen::Index c = 0; c < corner.size(); ++c) {
    const int vertex = face.performance.skin_rest.triangles.data()[c];
    ASSERT_TRUE(position.row(corner[c]) ==
                face.performance.skin_rest.points.row(vertex).cast<float>());
    ASSERT_TRUE(uv.row(corner[c]) == face.scan.corner_uv.row(c));
  }
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].mimeType, "image/png");
  EXPECT_EQ(model.images[0].width, 64);  // decoded by the reader
}

TEST(Glb, KeepsVertexColoursAlsoOnTheCut) {
  const auto face = made_up_face(Surface::coloured);
  const auto file = scratch("coloured.glb");
  write_glb(file, face.performance, face.scan);
  const auto model = read_back(file);
  const auto colour =
      rows_of<std::uint16_t, 4>(model, model.meshes[0].primitives[0].attributes.at("COLOR_0"));
  ASSERT_EQ(colour.rows(), face.performance.skin_rest.points.rows());
  EXPECT_EQ(colour(0, 0), 37852);  // sRGB 200 is 0.577580 in linear light
  const auto cut = face.performance.appended.at(2).a;
  EXPECT_TRUE(colour.row(face.performance.scan_vertices + 2) == colour.row(cut));
}

TEST(Glb, TeethAreNodesOfWhichTheLowerMoveWithTheJaw) {
  const auto face = made_up_face(Surface::plain);
  const auto teeth = testing::made_up_teeth();
  const auto file = scratch("teeth.glb");
  const GlbReport with = write_glb(file, face.performance, face.scan, {.teeth = &teeth});
  const auto model = read_back(file);
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.scenes[0].nodes.size(), 3u);
  EXPECT_EQ(model.nodes[0].name, "face");
  EXPECT_EQ(model.nodes[1].name, "upper_teeth");
  EXPECT_EQ(model.nodes[2].name, "lower_teeth");
  EXPECT_TRUE(model.nodes[1].translation.empty()) << "no surgery";
  const auto& lower = model.meshes[std::size_t(model.nodes[2].mesh)];
  ASSERT_EQ(lower.primitives.size(), 3u) << "crowns, gum and tongue";
  ASSERT_EQ(model.meshes[std::size_t(model.nodes[1].mesh)].primitives.size(), 2u);
  EXPECT_EQ(model.materials[std::size_t(lower.primitives[0].material)].name, "teeth");
  EXPECT_EQ(model.materials[std::size_t(lower.primitives[1].material)].name, "gum");
  EXPECT_EQ(model.materials[std::size_t(lower.primitives[2].material)].name, "tongue");
  EXPECT_EQ((rows_of<float, 3>(model, lower.primitives[2].attributes.at("POSITION"))),
            PointsF(teeth.tongue.points.cast<float>()));
  const auto crowns = rows_of<float, 3>(model, lower.primitives[0].attributes.at("POSITION"));
  EXPECT_EQ(crowns, teeth.lower.crowns.points.cast<float>());
  int moving = 0;
  for (const auto& channel : model.animations.at(0).channels) {
    if (channel.target_node == 0) continue;
    ++moving;
    ASSERT_EQ(channel.target_node, 2) << "the upper teeth stand";
    const auto& sampler = model.animations[0].samplers[std::size_t(channel.sampler)];
    for (const int f : {0, 7, 15}) {
      const Eigen::Isometry3d& jaw = face.performance.jaw_now_from_rest[std::size_t(f)];
      if (channel.target_path == "rotation") {
        const auto turns = rows_of<float, 4>(model, sampler.output);
        ASSERT_EQ(turns.rows(), 31);
        const Eigen::Quaternionf turn(turns(f, 3), turns(f, 0), turns(f, 1), turns(f, 2));
        EXPECT_LT((turn.toRotationMatrix() - jaw.linear().cast<float>()).norm(), 1e-6) << f;
      } else {
        EXPECT_EQ(channel.target_path, "translation");
        const Eigen::RowVector3f shift = rows_of<float, 3>(model, sampler.output).row(f);
        EXPECT_LT((shift.transpose() - jaw.translation().cast<float>()).norm(), 1e-7) << f;
      }
    }
  }
  EXPECT_EQ(moving, 2);
  const GlbReport without = write_glb(scratch("no_teeth.glb"), face.performance, face.scan);
  EXPECT_EQ(with.keys, without.keys);
  EXPECT_GT(with.bytes, without.bytes + 1e5);
}

/// The rotation of a node in each frame, as x y z w; no rows where it does not turn.
Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> turns_of_node(const tinygltf::Model& model,
                                                                       const std::string& name) {
  for (const auto& channel : model.animations.at(0).channels)
    if (channel.target_path == "rotation" &&
        model.nodes[std::size_t(channel.target_node)].name == name)
      return rows_of<float, 4>(model,
                               model.animations[0].samplers[std::size_t(channel.sampler)].output);
  return {};
}

TEST(Glb, EyesTurnWithTheGaze) {
  auto face = made_up_face(Surface::plain);
  testing::add_inner_eye_corners(face.performance);
  const FaceBacking none;
  write_glb(scratch("no_backing.glb"), face.performance, face.scan, {.backing = &none});
  EXPECT_EQ(read_back(scratch("no_backing.glb")).nodes.size(), 1u) << "the caller's is taken";
  const auto file = scratch("gaze.glb");
  write_glb(file, face.performance, face.scan);
  EXPECT_EQ(turns_of_node(read_back(file), "eye_L").rows(), 0);
  face.performance.gaze.resize(face.performance.frame_time_s.size());
  face.performance.gaze[15] = {.right = {.up_rad = 0.2}, .left = {.left_rad = 0.3}};
  write_glb(file, face.performance, face.scan);
  const auto model = read_back(file);
  const auto right = turns_of_node(model, "eye_R"), left = turns_of_node(model, "eye_L");
  ASSERT_EQ(right.rows(), 31);
  ASSERT_EQ(left.rows(), 31);
  const Vec3 ahead = face_backing(face.performance).forward;
  const auto looking = [&](const auto& turns, int frame) -> Vec3 {
    const Eigen::Quaternionf turn(turns(frame, 3), turns(frame, 0), turns(frame, 1),
                                  turns(frame, 2));
    return turn.cast<double>() * ahead;
  };
  EXPECT_LT((looking(left, 14) - ahead).norm(), 1e-6);
  EXPECT_NEAR(looking(left, 15).x(), std::sin(0.3), 1e-3) << "the subject's left is +x";
  EXPECT_NEAR(looking(right, 15).x(), 0, 1e-6);
  EXPECT_GT(looking(right, 15).y(), ahead.y() + 0.15);
  const auto darkest_white = [](const tinygltf::Model& of) {
    const auto& eye = of.meshes[1].primitives[0];
    return rows_of<std::uint16_t, 4>(of, eye.attributes.at("COLOR_0")).bottomRows(64).minCoeff();
  };
  EXPECT_GT(darkest_white(model), 6000) << "linear, of 65535: no black part comes into sight";
  face.performance.gaze.pop_back();
  EXPECT_THROW(write_glb(file, face.performance, face.scan), std::invalid_argument);
}

TEST(Glb, EyesAreThoseOfTheReport) {
  auto face = made_up_face(Surface::plain);
  const auto teeth = testing::made_up_teeth();
  write_glb(scratch("no_eyes.glb"), face.performance, face.scan);
  EXPECT_EQ(read_back(scratch("no_eyes.glb")).nodes.size(), 1u) << "inner corners are not known";
  testing::add_inner_eye_corners(face.performance);
  const auto file = scratch("eyes.glb");
  write_glb(file, face.performance, face.scan, {.teeth = &teeth});
  const auto model = read_back(file);
  const auto eyeballs = face_backing(face.performance).eyeballs;
  ASSERT_EQ(eyeballs.size(), 2u);
  ASSERT_EQ(model.nodes.size(), 5u);
  const char* names[] = {"eye_R", "eye_L"};
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& node = model.nodes[1 + side];
    EXPECT_EQ(node.name, names[side]);
    ASSERT_EQ(node.translation.size(), 3u) << "it turns about its middle";
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(node.translation[std::size_t(k)], eyeballs[side].centre[k]);
    const auto& mesh = model.meshes[std::size_t(node.mesh)];
    ASSERT_EQ(mesh.primitives.size(), 1u);
    const auto& primitive = mesh.primitives[0];
    EXPECT_EQ(model.materials[std::size_t(primitive.material)].name, "eye");
    const PointsF points = rows_of<float, 3>(model, primitive.attributes.at("POSITION"));
    const PointsF normals = rows_of<float, 3>(model, primitive.attributes.at("NORMAL"));
    EXPECT_LT((points - float(eyeballs[side].radius_m) * normals).norm(), 1e-5);
    // The pupil's colours are darker than those of the white, which the lids shade.
    const auto colours = rows_of<std::uint16_t, 4>(model, primitive.attributes.at("COLOR_0"));
    ASSERT_EQ(colours.rows(), points.rows());
    const Eigen::VectorXf ahead = normals * eyeballs[side].gaze.cast<float>();
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      if (ahead[v] > 0.99F) {
        EXPECT_LT(colours(v, 1), 700) << "linear, of 65535";
      }
  }
  const auto& crowns = model.meshes[std::size_t(model.nodes[3].mesh)].primitives[0];
  EXPECT_EQ(model.materials[std::size_t(crowns.material)].name, "teeth");
  for (const auto& channel : model.animations.at(0).channels)
    EXPECT_TRUE(channel.target_node == 0 || channel.target_node == 4) << channel.target_node;
}

/// Lit, a corner beside an eyeball would be black; what lies behind a mouth must not let light in.
TEST(Glb, PocketsOfEyesAreUnlitAndStandApart) {
  const auto face = made_up_face(Surface::plain);
  FaceBacking backing = face_backing(face.performance);
  ASSERT_EQ(backing.openings.size(), 1u);
  backing.openings.push_back(backing.openings[0]);
  backing.openings[1].mouth = false;
  backing.openings[1].eye = true;
  const auto file = scratch("lid_pocket.glb");
  write_glb(file, face.performance, face.scan, {.backing = &backing});
  const auto model = read_back(file);
  ASSERT_EQ(model.meshes[0].primitives.size(), 3u);
  const auto material = [&](std::size_t part) {
    return model.materials[std::size_t(model.meshes[0].primitives[part].material)];
  };
  EXPECT_EQ(material(1).name, "cavity");
  EXPECT_TRUE(material(1).extensions.empty());
  EXPECT_EQ(material(2).name, "lid_pocket");
  EXPECT_TRUE(material(2).extensions.contains("KHR_materials_unlit"));
  for (std::size_t part : {1u, 2u})
    EXPECT_EQ(model.meshes[0].primitives[part].targets.size(),
              model.meshes[0].primitives[0].targets.size());
  EXPECT_NEAR((played(model, "POSITION", 1, 1) - played(model, "POSITION", 1, 2)).norm(), 0, 1e-6);
}

TEST(Glb, PocketsBehindOpeningsHangOnTheMovingSkin) {
  const auto face = made_up_face(Surface::plain);
  const auto teeth = testing::made_up_teeth();
  const auto openings = face_backing(face.performance, &teeth).openings;
  ASSERT_EQ(openings.size(), 1u) << "the cut";
  ASSERT_TRUE(openings[0].mouth);
  const auto file = scratch("pocket.glb");
  write_glb(file, face.performance, face.scan, {.teeth = &teeth});
  const auto model = read_back(file);
  ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
  const auto& cavity = model.meshes[0].primitives[1];
  const auto& material = model.materials[std::size_t(cavity.material)];
  EXPECT_EQ(material.name, "cavity");
  EXPECT_TRUE(material.extensions.empty()) << "unlit, it would let light through in Blender";
  EXPECT_TRUE(cavity.attributes.contains("NORMAL"));
  const auto colours = rows_of<std::uint16_t, 4>(model, cavity.attributes.at("COLOR_0"));
  ASSERT_EQ(colours.rows(), openings[0].rest.rows());
  for (Eigen::Index v = 0; v < colours.rows(); v += 7)
    EXPECT_NEAR(colours(v, 0) / 65535.0,
                std::pow((openings[0].colours[std::size_t(v)][0] / 255.0 + 0.055) / 1.055, 2.4),
                2e-3);
  double moved_m = 0, by_jaw_m = 0;
  const auto frames = int(face.performance.frame_time_s.size());
  for (int f = 0; f < frames; ++f) {
    const Points skin = played(model, "POSITION", f).cast<double>();
    const Eigen::Isometry3d& jaw = face.performance.jaw_now_from_rest[std::size_t(f)];
    const Points expected = pocket(openings[0], skin, jaw).points;
    // What moves less than a twentieth of the tolerance stands still; between keys a turning jaw is
    // no sum of theirs.
    EXPECT_LT((played(model, "POSITION", f, 1).cast<double>() - expected).cwiseAbs().maxCoeff(),
              2e-4)
        << f;
    moved_m = std::max(moved_m, (expected - openings[0].rest).rowwise().norm().maxCoeff());
    by_jaw_m = std::max(by_jaw_m,
                        (expected - pocket(openings[0], skin).points).rowwise().norm().maxCoeff());
  }
  EXPECT_GT(moved_m, 1e-3);
  EXPECT_GT(by_jaw_m, 1e-3);
}

TEST(Glb, UpperTeethLieWhereSurgeryPutThem) {
  auto face = made_up_face(Surface::plain);
  const auto teeth = testing::made_up_teeth();
  Eigen::Isometry3d& moved = face.performance.upper_teeth_now_from_rest;
  moved.linear() = Eigen::AngleAxisd(0.1, Vec3::UnitX()).toRotationMatrix();
  moved.translation() = Vec3(0.001, 0.002, 0.005);
  const auto file = scratch("moved_teeth.glb");
  write_glb(file, face.performance, face.scan, {.teeth = &teeth});
  const auto model = read_back(file);
  const tinygltf::Node& upper = model.nodes.at(1);
  ASSERT_EQ(upper.name, "upper_teeth");
  ASSERT_EQ(upper.rotation.size(), 4u);
  ASSERT_EQ(upper.translation.size(), 3u);
  const Eigen::Quaterniond turn(upper.rotation[3], upper.rotation[0], upper.rotation[1],
                                upper.rotation[2]);
  EXPECT_LT((turn.toRotationMatrix() - moved.linear()).norm(), 1e-6);
  EXPECT_LT((Vec3(upper.translation.data()) - moved.translation()).norm(), 1e-9);
}

TEST(Glb, WithoutTeethThePocketHangsOnTheSkinAlone) {
  const auto face = made_up_face(Surface::plain);
  const auto openings = face_backing(face.performance).openings;
  ASSERT_EQ(openings.size(), 1u);
  const auto file = scratch("pocket_alone.glb");
  write_glb(file, face.performance, face.scan);
  const auto model = read_back(file);
  for (int f = 0; f < int(face.performance.frame_time_s.size()); ++f) {
    const Points skin = played(model, "POSITION", f).cast<double>();
    EXPECT_LT((played(model, "POSITION", f, 1).cast<double>() - pocket(openings[0], skin).points)
                  .cwiseAbs()
                  .maxCoeff(),
              2e-5)
        << f;
  }
}

TEST(Glb, StillSkinHasNoAnimation) {
  auto face = made_up_face(Surface::plain);
  for (auto& frame : face.performance.skin_displacement_m) frame.setZero();
  const auto file = scratch("still.glb");
  write_glb(file, face.performance, face.scan);
  EXPECT_TRUE(read_back(file).animations.empty());
}

TEST(Glb, RefusesWhatDoesNotBelongTogetherAndUnwritablePlaces) {
  const auto face = made_up_face(Surface::plain);
  auto other = made_up_face(Surface::plain, 21);
  other.performance.skin_displacement_m.back() = PointsF::Zero(2, 3);
  EXPECT_THROW(write_glb(scratch("x.glb"), other.performance, other.scan), std::invalid_argument);
  EXPECT_THROW(write_glb("/nowhere/x.glb", face.performance, face.scan), InputError);
  EXPECT_THROW(write_glb(scratch("x.txt"), face.performance, face.scan), InputError);
  EXPECT_FALSE(std::filesystem::exists(scratch("x.txt")));
}

}  // namespace
}  // namespace hyperex::report
