// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/csv.hpp"

namespace hyperex::tracking {

namespace {

constexpr double kSameTime_s = 1e-3;
// Greatest distance of a true point from its position in frame 0.
constexpr double kAtRest_m = 2e-5;
constexpr std::size_t kLeastRestFrames = 5;

void check_times(const io::CsvTable& table, const std::vector<double>& time_s) {
  const int column = table.column("time_s");
  if (table.values.rows() != Eigen::Index(time_s.size()))
    throw InputError(table.file, fmt::format("{} rows, but truth_pose.csv has {}",
                                             table.values.rows(), time_s.size()));
  for (std::size_t k = 0; k < time_s.size(); ++k)
    if (std::abs(table.values(Eigen::Index(k), column) - time_s[k]) > kSameTime_s)
      throw InputError({table.file, table.lines[k], "time_s",
                        fmt::format("{}", table.values(Eigen::Index(k), column)),
                        fmt::format("the time of that row in truth_pose.csv, {}", time_s[k])});
}

/// NaN if there are no values.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, share);
}

Quantiles quantiles(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.95)};
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 3) return std::nullopt;
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), Eigen::Index(a.size())),
      y(b.data(), Eigen::Index(b.size()));
  const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
  const double norm = std::sqrt(dx.square().sum() * dy.square().sum());
  if (dy.abs().maxCoeff() < 1e-9 || norm <= 0) return std::nullopt;
  return (dx * dy).sum() / norm;
}

Points face_points(const expression::FaceModel& model, const Points& vertices) {
  Points points(Eigen::Index(score_points().size()), 3);
  for (std::size_t i = 0; i < score_points().size(); ++i) {
    const auto found = model.landmarks.find(face::ibug(score_points()[i]));
    if (found == model.landmarks.end())
      points.row(Eigen::Index(i)).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      points.row(Eigen::Index(i)) = expression::landmark_at(found->second, vertices).transpose();
  }
  return points;
}

Points moved(const Eigen::Isometry3d& b_from_a, const Points& a) {
  return (a * b_from_a.linear().transpose()).rowwise() + b_from_a.translation().transpose().eval();
}

Points truth_points(const Truth& truth, std::size_t k) {
  Points points(Eigen::Index(score_points().size()), 3);
  for (std::size_t i = 0; i < score_points().size(); ++i)
    points.row(Eigen::Index(i)) = truth.landmarks_m[k].row(score_points()[i]);
  return points;
}

std::optional<double> jitter(const std::vector<Points>& camera_points) {
  if (camera_points.size() < kLeastRestFrames) return std::nullopt;
  Points mean = Points::Zero(camera_points[0].rows(), 3);
  for (const Points& points : camera_points) mean += points;
  mean /= double(camera_points.size());
  double squares = 0;
  long count = 0;
  for (const Points& points : camera_points)
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double squared = (points.row(i) - mean.row(i)).squaredNorm();
      if (std::isnan(squared)) continue;
      squares += squared;
      ++count;
    }
  return count ? std::optional(1e3 * std::sqrt(squares / double(count))) : std::nullopt;
}

/// For each true time, the tracked frame at that time, or null.
std::vector<const TrackedFrame*> frames_at(const std::vector<double>& time_s,
                                           const std::vector<TrackedFrame>& tracked) {
  std::vector<const TrackedFrame*> match(time_s.size(), nullptr);
  for (const TrackedFrame& frame : tracked) {
    const auto near = std::lower_bound(time_s.begin(), time_s.end(), frame.time_s - kSameTime_s);
    if (near != time_s.end() && *near <= frame.time_s + kSameTime_s && frame.valid)
      match[std::size_t(near - time_s.begin())] = &frame;
  }
  return match;
}

}  // namespace

const std::vector<int>& score_points() {
  static const std::vector<int> points = [] {
    std::vector<int> made = {7, 8, 9};
    for (int k = 48; k < 68; ++k) made.push_back(k);
    return made;
  }();
  return points;
}

Truth read_truth(const std::filesystem::path& folder) {
  Truth truth;
  const io::CsvTable poses = io::read_csv(folder / "truth_pose.csv");
  const int time = poses.column("time_s");
  for (Eigen::Index k = 0; k < poses.values.rows(); ++k) {
    truth.time_s.push_back(poses.values(k, time));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c)
        pose.matrix()(r, c) = poses.values(k, poses.column(fmt::format("T{}{}", r, c)));
    truth.camera_from_face.push_back(pose);
  }
  const io::CsvTable points = io::read_csv(folder / "truth_landmarks68_camera_m.csv");
  check_times(points, truth.time_s);
  std::array<int, 204> columns;
  for (int i = 0; i < 68; ++i)
    for (int axis = 0; axis < 3; ++axis)
      columns[std::size_t(3 * i + axis)] = points.column(fmt::format("{}{}", "xyz"[axis], i));
  for (Eigen::Index k = 0; k < points.values.rows(); ++k) {
    Points68 sample;
    for (int i = 0; i < 204; ++i) sample.data()[i] = points.values(k, columns[std::size_t(i)]);
    truth.landmarks_m.push_back(sample);
  }
  const io::CsvTable weights = io::read_csv(folder / "truth_weights.csv");
  check_times(weights, truth.time_s);
  if (const auto jaw = weights.find("jawOpen"))
    for (Eigen::Index k = 0; k < weights.values.rows(); ++k)
      truth.jaw_open.push_back(weights.values(k, *jaw));
  return truth;
}

void write_truth(const std::filesystem::path& folder, const Truth& truth) {
  std::string poses = "time_s", points = "time_s", weights = "time_s";
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) poses += fmt::format(",T{}{}", r, c);
  for (int i = 0; i < 68; ++i) points += fmt::format(",x{0},y{0},z{0}", i);
  if (!truth.jaw_open.empty()) weights += ",jawOpen";
  for (std::size_t k = 0; k < truth.time_s.size(); ++k) {
    const std::string time = fmt::format("\n{:.6f}", truth.time_s[k]);
    poses += time, points += time, weights += time;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c)
        poses += fmt::format(",{:.9f}", truth.camera_from_face[k].matrix()(r, c));
    for (int i = 0; i < 204; ++i) points += fmt::format(",{:.6f}", truth.landmarks_m[k].data()[i]);
    if (!truth.jaw_open.empty()) weights += fmt::format(",{:.6f}", truth.jaw_open[k]);
  }
  const std::pair<const char*, const std::string&> files[] = {
      {"truth_pose.csv", poses},
      {"truth_landmarks68_camera_m.csv", points},
      {"truth_weights.csv", weights}};
  for (const auto& [name, text] : files)
    write_file_atomically(folder / name, [&](std::ostream& out) { out << text << '\n'; });
}

Score score(const expression::FaceModel& model, const std::vector<TrackedFrame>& tracked,
            const Truth& truth) {
  Score result;
  result.frames = truth.time_s.size();
  const std::vector<const TrackedFrame*> match = frames_at(truth.time_s, tracked);
  std::optional<std::size_t> first;
  std::vector<double> rotation, translation, deformation, jaw, true_jaw;
  std::vector<std::vector<double>> by_point(score_points().size());
  std::vector<Points> resting;
  Points face_0, true_0;
  Eigen::Matrix3d face_from_head = Eigen::Matrix3d::Identity();
  for (std::size_t k = 0; k < match.size(); ++k) {
    if (!match[k]) {
      ++result.lost;
      continue;
    }
    const TrackedFrame& frame = *match[k];
    const Points points = face_points(model, frame.vertices_m);
    const Eigen::Isometry3d& t_k = truth.camera_from_face[k];
    const Points true_points = moved(t_k.inverse(), truth_points(truth, k));
    if (!truth.jaw_open.empty() && model.jaw_drop >= 0) {
      jaw.push_back(frame.weights[model.jaw_drop]);
      true_jaw.push_back(truth.jaw_open[k]);
    }
    if (!first) {
      first = k;
      face_0 = points;
      true_0 = true_points;
      face_from_head = t_k.linear().transpose() * frame.camera_from_head.linear();
    }
    if ((truth_points(truth, k) - truth_points(truth, *first)).rowwise().norm().maxCoeff() <
        kAtRest_m)
      resting.push_back(moved(frame.camera_from_head, points));
    if (k == *first) continue;
    const Eigen::Isometry3d& t_0 = truth.camera_from_face[*first];
    const Eigen::Isometry3d motion =
        t_0.inverse() * frame.camera_from_head * match[*first]->camera_from_head.inverse() * t_0;
    const Eigen::Isometry3d error = (t_0.inverse() * t_k).inverse() * motion;
    rotation.push_back(Eigen::AngleAxisd(error.linear()).angle() * 180 / std::numbers::pi);
    translation.push_back(error.translation().norm() * 1e3);
    const Points off = (points - face_0) * face_from_head.transpose() - (true_points - true_0);
    for (Eigen::Index i = 0; i < off.rows(); ++i) {
      const double distance_mm = off.row(i).norm() * 1e3;
      if (std::isnan(distance_mm)) continue;  // the model has no such point
      deformation.push_back(distance_mm);
      by_point[std::size_t(i)].push_back(distance_mm);
    }
  }
  result.rotation_deg = quantiles(rotation);
  result.translation_mm = quantiles(translation);
  result.deformation_mm = quantiles(deformation);
  result.jaw_correlation = correlation(jaw, true_jaw);
  result.rest_jitter_mm = jitter(resting);
  for (const auto& values : by_point) result.by_point_mm.push_back(quantile(values, 0.5));
  return result;
}

}  // namespace hyperex::tracking
