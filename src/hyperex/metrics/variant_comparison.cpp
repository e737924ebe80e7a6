// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/variant_comparison.hpp"

#include <algorithm>

#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/motion/lowpass.hpp"
#include "hyperex/motion/resample.hpp"

namespace hyperex::metrics {
namespace {

constexpr double kNearMouth_m = 0.025;

/// Positions of a landmark over time; empty if there is none with that name.
Points track_of(const motion::Motion& m, const std::string& name) {
  const int row = m.index_of(name);
  return row < 0 ? Points() : motion::track_of(m, row);
}

double farthest(const Points& track) {
  return track.rows() ? (track.rowwise() - track.row(0)).rowwise().norm().maxCoeff() : 0;
}

double integral(const std::vector<double>& time_s, const std::vector<double>& a,
                const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const double area =
        0.5 * (time_s[k] - time_s[k - 1]) * (std::abs(a[k] - b[k]) + std::abs(a[k - 1] - b[k - 1]));
    if (std::isfinite(area)) sum += area;
  }
  return sum;
}

/// The recorded motion of a driven point at the times of the run's frames.
Points driven_track(const simulate::Performance& base, const motion::Motion& recorded,
                    const std::string& name) {
  const int row = recorded.index_of(name);
  if (row < 0) return {};
  const motion::MotionCurve curve(recorded);
  const auto& time_s = base.frame_time_s;
  const double start_s = recorded.time_s.front();
  Points track(Eigen::Index(time_s.size()), 3);
  for (std::size_t k = 0; k < time_s.size(); ++k)
    track.row(Eigen::Index(k)) = curve.at(start_s + time_s[k]).row(row);
  return track;
}

double mean(const Eigen::VectorXd& values, const Eigen::VectorXd& weight) {
  return values.dot(weight) / weight.sum();
}

/// Displacements at the peak, averaged over the area of each side of the face.
void measure_sides(const Asymmetry& map, const TriMesh& rest, const PointsF& displacement,
                   const Eigen::VectorXd& area, VariantComparison& c) {
  double sum_mm[2] = {0, 0}, all[2] = {0, 0};
  for (const int v : map.face) {
    const Vec3 at = rest.points.row(v);
    const int right = map.plane.normal.dot(at) < map.plane.offset_m;
    sum_mm[right] += 1e3 * area[v] * double(displacement.row(v).norm());
    all[right] += area[v];
  }
  c.mean_displacement_left_mm = sum_mm[0] / all[0];
  c.mean_displacement_right_mm = sum_mm[1] / all[1];
}

/// The outer border of the lips including the corners, in the order of ibug68_48 to 59.
Points lip_outline(const io::Landmarks& landmarks) {
  Points outline(12, 3);
  for (int k = 0; k < 12; ++k) outline.row(k) = landmarks.at(face::ibug(48 + k)).transpose();
  return outline;
}

/// The value with the greatest absolute value; 0 if there is none.
double at_greatest(const std::vector<double>& values) {
  const int at = greatest_sample(values);
  return at < 0 ? 0 : values[std::size_t(at)];
}

bool comes_back(const std::vector<double>& input) {
  double most = 0;
  for (const double value : input) most = std::max(most, std::abs(value));
  return std::abs(input.back()) < 0.5 * most;
}

/// Finds the vertex with the greatest distance from base, and its displacements at the peak.
void measure_farthest(const simulate::Performance& own, const simulate::Performance& p,
                      const io::Landmarks& landmarks, VariantComparison& c) {
  const auto peak = std::size_t(own.peak_frame);
  Eigen::Index there = 0;
  c.greatest_distance_mm = 1e3 * c.difference.greatest_m.maxCoeff(&there);
  c.displacement_there_mm = c.base_displacement_there_mm = std::nan("");
  if (!(c.greatest_distance_mm > 0)) return;
  c.displacement_there_mm = 1e3 * double(p.skin_displacement_m[peak].row(there).norm());
  c.base_displacement_there_mm = 1e3 * double(own.skin_displacement_m[peak].row(there).norm());
  double nearest_m = INFINITY;
  for (const auto& [landmark, at] : landmarks)
    if (const double d = (at.transpose() - own.skin_rest.points.row(there)).norm(); d < nearest_m) {
      nearest_m = d;
      c.farthest_near = landmark;
    }
}

void measure_commissures(const ComparedRun& base, const ComparedRun& run, VariantComparison& c) {
  const ExcursionChange unknown{std::nan(""), std::nan(""), std::nan(""), std::nan("")};
  c.commissure_left = c.commissure_right = c.left_along_base = c.right_along_base = unknown;
  const Excursions& before = base.symmetry.excursions;
  const Excursions& excursions = run.symmetry.excursions;
  for (std::size_t i = 0; i < excursions.pairs.size(); ++i)
    if (const int left = excursions.pairs[i].left;
        left >= 0 && left == excursions.commissure.left) {
      const auto change = [&](Side side) {
        return change_of(before.pairs.at(i), excursions.pairs[i], side);
      };
      c.commissure_left = change(Side::left);
      c.commissure_right = change(Side::right);
      const motion::Motion own = motion::lowpassed(base.performance.landmarks, before.lowpass_hz),
                           run_own =
                               motion::lowpassed(run.performance.landmarks, excursions.lowpass_hz);
      c.left_from_base = distance_from_base(own, run_own, left);
      const int right = excursions.pairs[i].right;
      c.right_from_base = distance_from_base(own, run_own, right);
      const auto along = [&](int column, Points Commissure::*twin) {
        const Points &twin_base = before.commissure.*twin, &twin_run = excursions.commissure.*twin;
        return banded_change(
            along_base_mm(own, own, column), along_base_mm(own, run_own, column),
            along_base_mm(twin_base, twin_run) - along_base_mm(twin_base, twin_base),
            before.pairs.at(i), excursions.pairs[i]);
      };
      c.left_along_base = along(left, &Commissure::twin_left_track_mm);
      c.right_along_base = along(right, &Commissure::twin_right_track_mm);
      const PairExcursion& corners = excursions.pairs[i];
      if (!corners.left_recorded) c.left_from_base = {}, c.left_along_base = unknown;
      if (!corners.right_recorded) c.right_from_base = {}, c.right_along_base = unknown;
    }
}

/// Computes lag and hysteresis of the response relative to the driven point.
void measure_lag(const simulate::Performance& own, const simulate::Performance& p,
                 const motion::Motion& recorded, const ResponsePair& pair, VariantComparison& c) {
  c.lag.lag_s = c.lag.correlation = c.hysteresis = std::nan("");
  if (pair.driven.empty() || pair.response.empty()) return;
  const auto input = along_farthest(driven_track(own, recorded, pair.driven));
  const auto response = along_farthest(track_of(p.landmarks, pair.response));
  if (comes_back(input)) {
    c.lag = lag_of(p.frame_time_s, input, response);
    c.hysteresis = hysteresis_of(input, response);
  }
}

}  // namespace

ResponsePair response_pair(const simulate::Performance& base, const motion::Motion& recorded,
                           double clear_m) {
  ResponsePair pair;
  double most = 0;
  for (const std::string& name : base.driven_names)
    if (const double moved = farthest(driven_track(base, recorded, name)); moved > most) {
      most = moved;
      pair.driven = name;
    }
  most = 0;
  for (const std::string& name : base.landmarks.names) {
    const Points track = track_of(base.landmarks, name);
    bool off = true;
    for (const auto at : base.driven_points_rest.rowwise())
      off = off && (at - track.row(0)).norm() > clear_m;
    if (const double moved = farthest(track); off && moved > most) {
      most = moved;
      pair.response = name;
    }
  }
  return pair;
}

DistanceFromBase distance_from_base(const motion::Motion& base, const motion::Motion& run,
                                    int column) {
  DistanceFromBase farthest;
  if (column < 0 || column >= int(base.names.size()) || run.positions.empty()) return farthest;
  const Eigen::RowVector3d at_rest =
      run.positions[0].row(column) - base.positions.at(0).row(column);
  for (std::size_t k = 0; k < run.positions.size(); ++k) {
    const double mm =
        1e3 * (run.positions[k].row(column) - base.positions.at(k).row(column) - at_rest).norm();
    if (!(mm <= farthest.most_mm)) farthest = {mm, run.time_s[k]};
  }
  return farthest;
}

double along_base_mm(const motion::Motion& base, const motion::Motion& run, int column) {
  if (column < 0 || column >= int(base.names.size())) return std::nan("");
  return along_base_mm(1e3 * motion::track_of(base, column), 1e3 * motion::track_of(run, column));
}

double along_base_mm(const Points& base_mm, const Points& run_mm) {
  constexpr double least_mm = 0.1;
  if (base_mm.rows() == 0 || run_mm.rows() == 0) return std::nan("");
  Eigen::RowVector3d way = Eigen::RowVector3d::Zero();
  for (const auto at : base_mm.rowwise())
    if (const Eigen::RowVector3d d = at - base_mm.row(0); d.norm() > way.norm()) way = d;
  if (!(way.norm() >= least_mm)) return std::nan("");
  double most = 0;
  for (const auto at : run_mm.rowwise())
    if (const double along = (at - run_mm.row(0)).dot(way.normalized());
        std::abs(along) > std::abs(most))
      most = along;
  return most;
}

VariantComparison compare_variant(const std::string& name, const ComparedRun& base,
                                  const ComparedRun& run, const ComparedInputs& inputs,
                                  const ResponsePair& pair) {
  const simulate::Performance &own = base.performance, &p = run.performance;
  VariantComparison c;
  c.name = name;
  c.greatest_displacement_mm = 1e3 * greatest_displacement_m(p.skin_displacement_m);
  c.difference = variant_difference(own.skin_displacement_m, p.skin_displacement_m, own.peak_frame);
  const io::Landmarks& landmarks = inputs.landmarks;
  const auto peak = std::size_t(own.peak_frame);
  const Eigen::VectorXd area = vertex_areas(own.skin_rest);
  c.rms_distance_mm = 1e3 * std::sqrt(mean(c.difference.at_peak_m.cwiseAbs2(), area));
  c.mean_change_mm = 1e3 * mean(c.difference.change_at_peak_m, area);
  measure_farthest(own, p, landmarks, c);
  measure_commissures(base, run, c);
  c.jitter_known = base.symmetry.excursions.known.jitter && run.symmetry.excursions.known.jitter;
  const Asymmetry& map = *run.symmetry.map;
  measure_sides(map, own.skin_rest, p.skin_displacement_m[peak], area, c);
  c.asymmetry_mm = map.frames[peak].face_rms_mm;
  const SymmetryCurve& s = run.symmetry.curve;
  const std::vector<double> added = added_difference(s, base.symmetry.curve);
  const bool measured = std::ranges::any_of(added, [](double xi) { return std::isfinite(xi); });
  c.added_xi_difference = measured ? at_greatest(added) : std::nan("");
  c.added_xi_floor = added_mesh_floor(s, base.symmetry.curve);
  c.share_near_mouth = share_within(c.difference.greatest_m, own.skin_rest.points,
                                    lip_outline(landmarks), kNearMouth_m, area);
  measure_lag(own, p, inputs.recorded, pair, c);
  c.symmetry_integral_s = measured ? integral(s.time_s, s.xi_left, s.xi_right) : std::nan("");
  return c;
}

}  // namespace hyperex::metrics
