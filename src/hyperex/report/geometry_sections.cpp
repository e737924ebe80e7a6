// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/geometry_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "hyperex/render/sky_share.hpp"
#include "hyperex/report/border_fade.hpp"
#include "hyperex/report/complexion.hpp"
#include "hyperex/report/eye_model.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/jaw_turns.hpp"
#include "hyperex/report/mouth_colours.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {

using Eigen::Index;
using nlohmann::json;

namespace {

json points_at(const PointsF& points, BinaryBlock& block) {
  return block.add("float32", points.data(), points.size());
}

/// Shares from 0 to 1, a byte each.
template <class Shares>
json share_bytes(const Shares& shares, BinaryBlock& block) {
  std::vector<std::uint8_t> bytes;
  for (const auto share : shares)
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
  return block.add(bytes);
}

json triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// In steps such that the mode's largest component is the greatest number that T holds.
template <typename T>
json quantised(const PointsF& mode, float largest, const char* type, BinaryBlock& block) {
  const float step_m = largest > 0 ? largest / std::numeric_limits<T>::max() : 1;
  std::vector<T> steps(static_cast<std::size_t>(mode.size()));
  std::transform(mode.data(), mode.data() + mode.size(), steps.begin(),
                 [&](float value) { return static_cast<T>(std::lround(value / step_m)); });
  return {{"step_m", step_m}, {"values", block.add(type, steps.data(), steps.size())}};
}

/// {"middle": ..., "points": ...} of points in steps of a 32767th of their extent, from a middle.
json still_points(const Points& points, BinaryBlock& block) {
  const Vec3 low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const Vec3 middle = (low + high) / 2;
  const PointsF about = (points.rowwise() - middle.transpose()).cast<float>();
  return {{"middle", triple(middle)},
          {"points", quantised<std::int16_t>(about, about.cwiseAbs().maxCoeff(), "int16", block)}};
}

/// still_points() and "triangles" of a mesh that does not change its shape.
json rigid_mesh(const TriMesh& mesh, BinaryBlock& block) {
  json out = still_points(mesh.points, block);
  const bool few = mesh.points.rows() <= std::numeric_limits<std::int16_t>::max();
  if (few) {
    std::vector<std::int16_t> corners(mesh.triangles.data(),
                                      mesh.triangles.data() + mesh.triangles.size());
    out["triangles"] = block.add(corners);
  } else {
    out["triangles"] =
        block.add("int32", mesh.triangles.data(), std::size_t(mesh.triangles.size()));
  }
  return out;
}

}  // namespace

json skin_section(const ReportInput& input, BinaryBlock& block) {
  const auto& performance = input.performance;
  const SkinView view = skin_view(performance, input.scan);
  json skin = {{"points", points_at(performance.skin_rest.points.cast<float>(), block)},
               {"triangles", block.add("int32", performance.skin_rest.triangles.data(),
                                       performance.skin_rest.triangles.size())}};
  if (view.uv.rows() > 0) {
    skin["texture"] = {
        {"mime_type", input.scan.texture->mime_type},
        {"image", block.add(input.scan.texture->bytes)},
        {"uv", block.add("float32", view.uv.data(), view.uv.size())},
        {"skin_vertex", block.add(view.skin_vertex)},
        {"triangles", block.add("int32", view.triangles.data(), view.triangles.size())}};
  } else {
    auto colour = skin_colour(performance, input.scan);
    if (colour.rows() == 0) colour = complexion(performance, input.skin_tone);
    if (colour.rows() > 0) skin["colour"] = block.add("uint8", colour.data(), colour.size());
  }
  skin["light"] = share_bytes(render::sky_share(performance.skin_rest), block);
  skin["fade"] = share_bytes(border_fade(performance.skin_rest), block);
  return skin;
}

json modes_section(const DisplacementModes& motion, BinaryBlock& block) {
  constexpr float kByteStep_m = 2e-6F;
  json modes = json::array();
  for (const auto& mode : motion.modes) {
    const float largest = mode.cwiseAbs().maxCoeff();
    modes.push_back(largest <= kByteStep_m * std::numeric_limits<std::int8_t>::max()
                        ? quantised<std::int8_t>(mode, largest, "int8", block)
                        : quantised<std::int16_t>(mode, largest, "int16", block));
  }
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor weights = motion.weights;
  return {{"modes", modes},
          {"weights", block.add("float32", weights.data(), weights.size())},
          {"max_error_mm", 1e3 * motion.max_error_m}};
}

json positions_of(const motion::Motion& landmarks, BinaryBlock& block) {
  std::vector<float> values;  // N x P x 3
  for (const auto& frame : landmarks.positions)
    for (Index i = 0; i < frame.size(); ++i) values.push_back(static_cast<float>(frame.data()[i]));
  return block.add(values);
}

json mirror_section(const metrics::RestAsymmetry& at_rest, BinaryBlock& block) {
  const metrics::Counterparts& pairs = at_rest.pairs;
  std::vector<int> vertices;
  std::vector<std::uint8_t> weights;
  for (std::size_t i = 0; i < pairs.found.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      vertices.push_back(pairs.found[i] ? pairs.vertices[i][k] : -1);
      const double weight = std::clamp(pairs.weights[i][Index(k)], 0., 1.);
      weights.push_back(static_cast<std::uint8_t>(std::lround(255 * weight)));
    }
  const Vec3& n = at_rest.plane.normal;
  return {{"normal", {n.x(), n.y(), n.z()}},
          {"vertices", block.add(vertices)},
          {"weights", block.add(weights)}};
}

json teeth_section(const anatomy::Teeth& teeth, const Vec3& forward, BinaryBlock& block) {
  json section = json::array();
  const auto add = [&](const char* jaw, const char* part, const TriMesh& mesh,
                       const TriMesh& crowns, const Srgb& colour) {
    if (mesh.triangles.rows() == 0) return;
    json one = rigid_mesh(mesh, block);
    one["light"] = share_bytes(light_in_mouth(mesh, crowns, forward), block);
    one["jaw"] = jaw;
    one["part"] = part;
    one["colour"] = colour;
    section.push_back(std::move(one));
  };
  add("upper", "crowns", teeth.upper.crowns, teeth.upper.crowns, kCrownColour);
  add("upper", "gum", teeth.upper.gum, teeth.upper.crowns, kGumColour);
  add("lower", "crowns", teeth.lower.crowns, teeth.lower.crowns, kCrownColour);
  add("lower", "gum", teeth.lower.gum, teeth.lower.crowns, kGumColour);
  add("lower", "tongue", teeth.tongue, teeth.lower.crowns, kTongueColour);
  return section;
}

json upper_teeth_section(const simulate::Performance& performance) {
  const Eigen::Isometry3d& moved = performance.upper_teeth_now_from_rest;
  if (moved.isApprox(Eigen::Isometry3d::Identity(), 1e-9)) return nullptr;
  const Eigen::Quaterniond turn(moved.linear());
  const Vec3 by = moved.translation();
  return {turn.x(), turn.y(), turn.z(), turn.w(), by.x(), by.y(), by.z()};
}

json gaze_section(const simulate::Performance& performance, BinaryBlock& block) {
  const auto corners = anatomy::face_corners(landmarks_at_rest(performance));
  if (performance.gaze.empty() || !corners) return nullptr;
  const auto eyes = anatomy::eyeballs_behind(performance.skin_rest.points, *corners);
  if (eyes.empty()) return nullptr;
  std::vector<float> values;
  for (const expression::EyesGaze& gaze : performance.gaze)
    for (const Eigen::Quaterniond& turn : turns_of(gaze, eyes))
      for (const double value : {turn.x(), turn.y(), turn.z(), turn.w()})
        values.push_back(static_cast<float>(value));
  return block.add(values);
}

json jaw_section(const simulate::Performance& performance, BinaryBlock& block) {
  std::vector<float> values;
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (const Eigen::Isometry3d& jaw : performance.jaw_now_from_rest) {
    const Eigen::Quaterniond turn = near_to(before, jaw.linear());
    before = turn;
    for (const double value : {turn.x(), turn.y(), turn.z(), turn.w()})
      values.push_back(static_cast<float>(value));
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(jaw.translation()[k]));
  }
  return block.add(values);
}

namespace {

json opening_section(const Opening& opening, BinaryBlock& block) {
  json rings = json::array();
  for (const PocketRing& ring : opening.rings) rings.push_back({ring.edge, ring.centre, ring.jaw});
  std::vector<std::uint8_t> colours;
  for (const Srgb& colour : opening.colours)
    colours.insert(colours.end(), colour.begin(), colour.end());
  const std::vector<float> jaw(opening.jaw.begin(), opening.jaw.end());
  json out = still_points(opening.rest, block);
  out["loop"] = block.add(opening.loop);
  out["rings"] = rings;
  out["jaw"] = block.add(jaw);
  out["colours"] = block.add(colours);
  return out;
}

}  // namespace

Vec3 add_backing(const ReportInput& input, BinaryBlock& block, json& manifest) {
  std::optional<FaceBacking> made;
  if (!input.backing) made = face_backing(input.performance, input.teeth);
  const FaceBacking& backing = made ? *made : *input.backing;
  manifest["openings"] = json::array();
  for (const Opening& opening : backing.openings)
    manifest["openings"].push_back(opening_section(opening, block));
  manifest["eyeballs"] = json::array();
  const auto lights = light_on_eyes(backing.eyeballs, input.performance.skin_rest);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Eyeball& eyeball = backing.eyeballs[i];
    manifest["eyeballs"].push_back({{"centre", triple(eyeball.centre)},
                                    {"gaze", triple(eyeball.gaze)},
                                    {"radius_m", eyeball.radius_m},
                                    {"light", share_bytes(lights[i], block)}});
  }
  if (!backing.eyeballs.empty()) {
    const EyeModel& eye = eye_model();
    manifest["eye_model"] = rigid_mesh(eye.mesh, block);
    manifest["eye_model"]["colours"] =
        block.add("uint8", eye.colours.data(), std::size_t(eye.colours.size()));
  }
  return backing.forward;
}

}  // namespace hyperex::report
