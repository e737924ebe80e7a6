// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/tracking_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "hyperex/io/csv.hpp"
#include "hyperex/tracking/output/arkit_weights.hpp"

namespace hyperex::tracking {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

motion::Motion motion_of(const expression::FaceModel& model, const Tracking& tracking,
                         bool with_vertices) {
  motion::Motion motion;
  for (const auto& [name, vertices] : model.landmarks) motion.names.push_back(name);
  const Eigen::Index landmarks = Eigen::Index(motion.names.size());
  if (with_vertices)
    for (Eigen::Index v = 0; v < model.vertex_count(); ++v)
      motion.names.push_back(fmt::format("vertex_{}", v));
  for (const TrackedFrame& frame : tracking.frames) {
    if (!motion.time_s.empty() && frame.time_s <= motion.time_s.back()) continue;
    Points sample = Points::Constant(Eigen::Index(motion.names.size()), 3, kNan);
    if (frame.valid) {
      sample.topRows(landmarks) = expression::landmarks_on(model, frame.vertices_m);
      if (with_vertices) sample.bottomRows(sample.rows() - landmarks) = frame.vertices_m;
    }
    motion.time_s.push_back(frame.time_s);
    motion.positions.push_back(std::move(sample));
    motion.head_pose.push_back(frame.camera_from_head);
  }
  if (with_vertices) motion.triangles = model.mesh.triangles.array() + int(landmarks);
  motion.unit_note = "m (tracked)";
  return motion;
}

void write_pose_csv(const std::filesystem::path& file, const Tracking& tracking) {
  std::vector<std::string> names = {"time_s", "valid"};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) names.push_back(fmt::format("T{}{}", r, c));
  for (const char* name : {"network_rms_px", "depth_rms_mm", "depth_share", "skin_share",
                           "network_score", "faces_in_view", "metric", "frame"})
    names.push_back(name);
  const bool metric = tracking.neutral && tracking.neutral->metric;
  const auto fill = [&](long k, std::vector<double>& row) {
    const TrackedFrame& frame = tracking.frames[std::size_t(k)];
    std::fill(row.begin(), row.end(), kNan);
    row[0] = frame.time_s;
    row[1] = frame.valid;
    row[row.size() - 3] = frame.faces_in_view;
    row[row.size() - 2] = metric;
    row.back() = double(frame.index);
    if (!frame.valid) return frame.fault;
    std::size_t at = 2;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) row[at++] = frame.camera_from_head.matrix()(r, c);
    const bool has_depth = frame.report.depth_share > 0;
    for (const double value :
         {frame.report.network_rms_px, has_depth ? frame.report.depth_rms_m * 1e3 : kNan,
          frame.report.depth_share, frame.report.photometric_share, frame.network_score})
      row[at++] = value;
    return frame.fault;
  };
  io::write_csv_with_text(file, names, "fault", long(tracking.frames.size()), fill);
}

void write_units_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking) {
  std::vector<std::string> names = {"time_s", "valid"};
  for (const auto& unit : model.animation_units)
    names.push_back(unit.facs.empty() ? unit.name : fmt::format("{} [{}]", unit.name, unit.facs));
  io::write_csv(file, names, long(tracking.frames.size()), [&](long k, std::vector<double>& row) {
    const TrackedFrame& frame = tracking.frames[std::size_t(k)];
    std::fill(row.begin(), row.end(), kNan);
    row[0] = frame.time_s;
    row[1] = frame.valid;
    if (frame.valid) std::copy(frame.weights.begin(), frame.weights.end(), row.begin() + 2);
  });
}

void write_arkit_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking) {
  const ArkitWeights weights(model);
  std::vector<std::string> names = weights.names();
  names.insert(names.begin(), "time_s");
  io::write_csv(file, names, long(tracking.frames.size()), [&](long k, std::vector<double>& row) {
    const TrackedFrame& frame = tracking.frames[std::size_t(k)];
    std::fill(row.begin(), row.end(), kNan);
    row[0] = frame.time_s;
    if (!frame.valid) return;
    std::size_t at = 1;
    for (const auto& [name, weight] : weights.of(frame)) row[at++] = weight;
  });
}

}  // namespace hyperex::tracking
