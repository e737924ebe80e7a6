// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/compare_visits.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <utility>

#include "hyperex/core/progress.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/motion/uncertain_pose.hpp"
#include "hyperex/visits/scan_measures.hpp"

namespace hyperex::visits {
namespace {

constexpr double kStep = 1e-6;  // of central differences, m and rad

using metrics::ErrorPart;
using Row3 = Eigen::RowVector3d;

/// Central difference of a measure for a change of the face by +-kStep along each axis.
template <typename Moved>
Eigen::RowVectorXd derivative(const Measure& measure, const MeasuredFace& face, int count,
                              const Moved& moved) {
  Eigen::RowVectorXd out(count);
  for (int i = 0; i < count; ++i) {
    FaceState forth = face.state, back = face.state;
    moved(forth, i, kStep);
    moved(back, i, -kStep);
    out[i] = (measure.value(forth) - measure.value(back)) / (2 * kStep);
  }
  return out;
}

Row3 by_point(const Measure& measure, const MeasuredFace& face,
              ByFacePoint<Vec3> FaceState::*points, std::size_t point) {
  if (!(face.state.*points)[point].allFinite()) return Row3::Zero();
  return derivative(measure, face, 3, [&](FaceState& state, int i, double step) {
    (state.*points)[point][i] += step;
  });
}

Eigen::RowVectorXd by_pose(const Measure& measure, const MeasuredFace& face) {
  return derivative(measure, face, 6, [&](FaceState& state, int i, double step) {
    Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
    error[i] = step;
    for (Vec3& p : state.peak) p += motion::pose_derivative(p - face.pose_centre) * error;
  });
}

Eigen::RowVectorXd by_axes(const Measure& measure, const MeasuredFace& face) {
  return derivative(measure, face, 3, [](FaceState& state, int i, double step) {
    state.axes = state.axes * Eigen::AngleAxisd(step, Vec3::Unit(i)).toRotationMatrix();
  });
}

double quadratic(const Eigen::RowVectorXd& row, const Eigen::MatrixXd& covariance) {
  return std::max(0.0, (row * covariance * row.transpose()).value());
}

/// Half the width of the 95 % interval without a person's own variation.
double measurement_half_width(const metrics::ErrorBudget& errors) {
  return errors.without(ErrorPart::repetition).half_width_95();
}

/// The mean of the recordings of one visit; nothing if none measures it.
struct VisitEstimates {
  std::vector<Estimate> each;
  bool known = true;      ///< whether jitter and head pose of all are known
  bool one_scale = true;  ///< whether all faces have the scale of the first recording
};

VisitEstimates estimates_of(const Measure& measure, const std::vector<MeasuredFace>& faces,
                            double repetition_m) {
  VisitEstimates out;
  for (const MeasuredFace& face : faces) {
    out.one_scale = out.one_scale && !face.other_scale;
    const Estimate one = estimate(measure, face, repetition_m);
    if (std::isnan(one.value)) continue;
    out.each.push_back(one);
    out.known = out.known && face.jitter_known && face.head_known;
  }
  return out;
}

std::optional<VisitValue> mean_of(const VisitEstimates& estimates) {
  if (estimates.each.empty()) return std::nullopt;
  const double count = double(estimates.each.size());
  VisitValue mean;
  mean.recordings = int(estimates.each.size());
  for (const Estimate& one : estimates.each) {
    mean.value += one.value / count;
    mean.errors += one.errors;
  }
  mean.errors *= 1 / (count * count);
  const double half = measurement_half_width(mean.errors);
  if (estimates.known) mean.measured = Interval{mean.value - half, mean.value + half};
  return mean;
}

/// The scatter of recordings about the means of their visits.
struct Scatter {
  double squares = 0;
  int freedom = 0;

  double deviation() const { return freedom > 0 ? std::sqrt(squares / freedom) : 0; }
};

Scatter scatter_of(const std::vector<VisitEstimates>& visits) {
  Scatter scatter;
  for (const VisitEstimates& visit : visits) {
    if (!visit.one_scale) continue;
    double mean = 0;
    for (const Estimate& one : visit.each) mean += one.value / double(visit.each.size());
    for (const Estimate& one : visit.each) scatter.squares += std::pow(one.value - mean, 2);
    if (!visit.each.empty()) scatter.freedom += int(visit.each.size()) - 1;
  }
  return scatter;
}

Change change_between(const VisitValue& first, const VisitValue& now, const Scatter& scatter) {
  Change change;
  change.value = now.value - first.value;
  metrics::ErrorBudget both = first.errors;
  both += now.errors;
  const double measured = measurement_half_width(both);
  double repeated = kWithin95 * std::sqrt(both.variance(ErrorPart::repetition));
  double all = both.half_width_95();
  if (scatter.freedom >= kLeastFreedom) {
    const double t = boost::math::quantile(boost::math::students_t(scatter.freedom), 0.975);
    repeated = t * scatter.deviation() * std::sqrt(1.0 / first.recordings + 1.0 / now.recordings);
    all = std::max(repeated, measured);
    both = both.without(ErrorPart::repetition);
    both.add(ErrorPart::repetition, std::max(0.0, std::pow(all / kWithin95, 2) - both.variance()));
  }
  const bool known = first.measured && now.measured;
  // Without the error of measurement an interval would be too narrow.
  if (known) {
    change.measured = Interval{change.value - measured, change.value + measured};
    change.all = Interval{change.value - all, change.value + all};
  }
  change.within_repetition = std::abs(change.value) <= repeated;
  if (std::abs(change.value) > all) change.beyond = known ? Beyond::yes : Beyond::cannot_tell;
  change.largest = name_of(both.largest());
  return change;
}

MeasureOverVisits over_visits(const Measure& measure, const std::vector<VisitEstimates>& visits) {
  MeasureOverVisits out;
  out.measure = measure;
  const Scatter scatter = scatter_of(visits);
  if (scatter.freedom >= kLeastFreedom) out.recorded_repetition = scatter.deviation();
  for (const VisitEstimates& visit : visits) {
    out.values.push_back(mean_of(visit));
    out.changes.emplace_back();
    if (out.values.size() > 1 && out.values.front() && out.values.back() &&
        visits.front().one_scale && visit.one_scale)
      out.changes.back() = change_between(*out.values.front(), *out.values.back(), scatter);
  }
  return out;
}

/// Read and cleaned, by visit and recording.
using Recordings = std::vector<std::vector<session::CleanedRecording>>;

Recordings cleaned_recordings(const VisitsFile& file) {
  Recordings out;
  for (const VisitEntry& visit : file.visits) {
    out.emplace_back();
    for (const auto& recording : visit.recordings)
      out.back().push_back(read_recording(recording, visit, file));
  }
  return out;
}

/// One set of points for all recordings where the file names none: a pose by other points would
/// differ by more than the expression does.
motion::StillPoints still_points_of(const VisitsFile& file, const Recordings& recordings) {
  if (!file.rigid_points.empty()) return {};
  std::vector<const motion::Motion*> motions;
  for (const auto& visit : recordings)
    for (const session::CleanedRecording& recording : visit) motions.push_back(&recording.motion);
  return motion::points_to_hold_the_head(motions);
}

}  // namespace

Estimate estimate(const Measure& measure, const MeasuredFace& face, double repetition_m) {
  Estimate out;
  out.value = measure.value(face.state);
  if (std::isnan(out.value)) return out;
  const double own = repetition_m / (kWithin95 * std::sqrt(2.0));  // of one point and direction
  double rest_squares = 0, peak_squares = 0;
  for (std::size_t p = 0; p < kFacePoints; ++p) {
    const double rest = by_point(measure, face, &FaceState::rest, p).squaredNorm(),
                 peak = by_point(measure, face, &FaceState::peak, p).squaredNorm();
    out.errors.add(ErrorPart::jitter, rest * std::pow(face.rest_jitter_m[p], 2) +
                                          peak * std::pow(face.peak_jitter_m[p], 2));
    rest_squares += rest;
    peak_squares += peak;
  }
  out.errors.add(ErrorPart::repetition,
                 own * own * (peak_squares > 0 ? peak_squares : rest_squares));
  out.errors.add(ErrorPart::head_pose, quadratic(by_pose(measure, face), face.pose_covariance));
  const Eigen::RowVectorXd axes = by_axes(measure, face);
  if (axes.allFinite()) out.errors.add(ErrorPart::axes, quadratic(axes, face.axes_covariance));
  return out;
}

MeasureOverVisits over_visits(const Measure& measure,
                              const std::vector<std::optional<Estimate>>& visits) {
  std::vector<VisitEstimates> each;
  for (const auto& visit : visits) {
    each.emplace_back();
    if (visit && !std::isnan(visit->value)) each.back().each = {*visit};
  }
  return over_visits(measure, each);
}

Comparison compare(const VisitsFile& file, std::vector<std::vector<MeasuredFace>> faces) {
  Comparison out;
  out.file = file;
  out.faces = std::move(faces);
  out.repetition_m = file.repetition_m.value_or(kUsualRepetition_m);
  for (const Measure& measure : measures()) {
    std::vector<VisitEstimates> visits;
    for (const auto& visit : out.faces)
      visits.push_back(estimates_of(measure, visit, out.repetition_m));
    MeasureOverVisits one = over_visits(measure, visits);
    out.repetition_measured = out.repetition_measured || one.recorded_repetition > 0;
    if (std::ranges::any_of(one.values, [](const auto& value) { return value.has_value(); }))
      out.measures.push_back(std::move(one));
  }
  return out;
}

Comparison compare_visits(const VisitsFile& file,
                          const std::function<void(std::size_t)>& progress) {
  const Recordings recordings = cleaned_recordings(file);
  const motion::StillPoints still_points = still_points_of(file, recordings);
  std::vector<std::vector<MeasuredFace>> faces;
  std::size_t done = 0;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    faces.emplace_back();
    for (const session::CleanedRecording& recording : recordings[i]) {
      const MeasuredFace* first = done == 0 ? nullptr : &faces.front().front();
      faces.back().push_back(
          measure_recording(recording, file.visits[i], file, first, still_points, done));
      ++done;
      if (progress) progress(done);
    }
  }
  Comparison out = compare(file, std::move(faces));
  if (has_scans(file)) {
    const Progress searching("measuring scans", 0);
    add_scan_measures(out);
  }
  return out;
}

std::string words_of(Beyond beyond) {
  if (beyond == Beyond::yes) return "yes";
  return beyond == Beyond::no ? "no" : "cannot tell";
}

}  // namespace hyperex::visits
