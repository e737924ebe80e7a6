// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/face_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/stopwatch.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::tracking {

namespace {

/// A frame that is not finished, and its measurements.
struct Waiting {
  TrackedFrame frame;
  std::optional<Observation> seen;
  bool found_anew = false;
};

// Largest distance between model and network points, relative to the face's size.
constexpr double kMostOff = 0.05;
// Least share of the network's points that lie within the picture.
constexpr double kLeastInside = 0.85;
constexpr double kRegionMargin = 0.15;  // margin around the points, relative to their extent

/// The options are those for the canonical face. A vertex of a coarser mesh represents a larger
/// part of the face. Its measurements therefore have the total weight of the canonical vertices in
/// its place, and its standard deviation from the mean of its neighbours increases with the square
/// of their distance.
TrackerOptions for_mesh_of(const expression::FaceModel& model, TrackerOptions options) {
  const double network = std::sqrt(double(model.pairs.size()) / face_point_count);
  const double surface = double(model.vertex_count()) / face_point_count;
  for (FitOptions* fit : {&options.fit, &options.neutral.fit}) {
    fit->network_px *= network;
    fit->network_outline_px *= network;
    fit->network_inner_lip_px *= network;
    fit->depth_m *= std::sqrt(surface);
    // With this bound, a hundred vertices are too few to separate pose and units (CANDIDE-3 on a
    // talking face: 0.6 instead of 0.5 degrees, 1.75 instead of 1.74 mm).
    if (surface < 0.5) fit->off_units_share = fit->off_units_lip_m = 0;
  }
  options.neutral.bend_m /= surface;
  return options;
}

double extent_px(const Points& px) {
  return (px.colwise().maxCoeff() - px.colwise().minCoeff()).head<2>().maxCoeff();
}

/// Keeps the frames in which the face is as in the first: after a similarity transform, their
/// network points differ from those of the first by at most the noise of the network
/// (`at_rest_px`).
void keep_resting(std::vector<Observation>& frames, double at_rest_px) {
  const Points first = frames.front().network_px;
  std::erase_if(frames, [&](const Observation& seen) {
    const Similarity onto = fit_similarity(seen.network_px, first);
    const Points off = onto.apply(seen.network_px) - first;
    return std::sqrt(off.leftCols<2>().rowwise().squaredNorm().mean()) > at_rest_px;
  });
}

cv::Rect region_around(const Points& px) {
  const Eigen::RowVector3d low = px.colwise().minCoeff(), high = px.colwise().maxCoeff();
  const double margin = kRegionMargin * std::max(high.x() - low.x(), high.y() - low.y());
  const int x = int(std::floor(low.x() - margin)), y = int(std::floor(low.y() - margin));
  return {x, y, int(std::ceil(high.x() + margin)) - x, int(std::ceil(high.y() + margin)) - y};
}

}  // namespace

struct FaceTracker::Impl {
  Impl(const expression::FaceModel& m, const capture::Intrinsics& c, const TrackerOptions& o)
      : model(m), camera(c), options(for_mesh_of(m, o)), network(o.network) {}

  const expression::FaceModel& model;
  capture::Intrinsics camera;
  TrackerOptions options;
  LandmarkTracker network;
  std::deque<Waiting> waiting;
  int faces = 0;
  std::optional<Neutral> neutral;
  std::unique_ptr<FrameFit> fit;
  std::optional<Skin> skin;
  std::optional<FaceState> before;
  TrackerTimes times;

  Waiting look(const capture::Frame& frame) {
    Waiting seen;
    seen.frame.index = frame.index;
    seen.frame.time_s = frame.time_s;
    if (!frame.valid || frame.colour.empty()) {
      seen.frame.fault = frame.fault.empty() ? "no picture" : frame.fault;
      return seen;
    }
    Stopwatch watch;
    const auto face = network.track(frame.colour);
    times.network_s += watch.lap();
    ++times.frames;
    if (!face) {
      seen.frame.fault = "no face found";
      return seen;
    }
    seen.frame.network_score = face->score;
    seen.frame.faces_in_view = face->faces_in_view;
    seen.found_anew = face->found_anew;
    Observation observation;
    observation.network_px = face->points_px;
    if (options.use_depth) observation.depth_m = frame.depth_m;
    observation.pictures =
        skin_pictures(frame.colour, region_around(observation.network_px), options.fit);
    times.picture_s += watch.lap();
    seen.seen = std::move(observation);
    return seen;
  }

  double share_inside(const Points& px) const {
    const auto x = px.col(0).array(), y = px.col(1).array();
    return (x >= 0 && y >= 0 && x <= camera.width_px - 1 && y <= camera.height_px - 1)
        .cast<double>()
        .mean();
  }

  void find_neutral() {
    std::vector<Observation> frames;
    for (const Waiting& one : waiting)
      if (one.seen) frames.push_back(*one.seen);
    if (frames.empty()) return;
    keep_resting(frames, options.at_rest_px);
    Stopwatch watch;
    neutral = estimate_neutral(model, camera, frames, options.neutral);
    check_size(model, *neutral);
    fit = std::make_unique<FrameFit>(model, camera, neutral->points_m, neutral->scale, options.fit);
    times.neutral_s += watch.lap();
  }

  TrackedFrame track(Waiting& one) {
    TrackedFrame frame = std::move(one.frame);
    if (!one.seen || !fit) {
      if (one.seen) frame.fault = "the person's shape is not known";
      before.reset();
      return frame;
    }
    Stopwatch watch;
    const Observation& seen = *one.seen;
    FaceState start = fit->at_rest();
    const bool anew = !before || one.found_anew;
    if (anew)
      start.camera_from_head = fit->first_pose(seen);
    else
      start = *before;
    const Skin* compared = skin ? &*skin : nullptr;
    FaceState state = fit->fit(seen, start, anew ? nullptr : &*before, compared, &frame.report);
    const double most_px = kMostOff * extent_px(seen.network_px);
    if (!anew && !(frame.report.network_rms_px <= most_px)) {
      start = fit->at_rest();
      start.camera_from_head = fit->first_pose(seen);
      state = fit->fit(seen, start, nullptr, compared, &frame.report);
    }
    if (!(frame.report.network_rms_px <= most_px) || share_inside(seen.network_px) < kLeastInside) {
      frame.fault = "the face is cut off or the model does not meet it";
      before.reset();
      times.fit_s += watch.lap();
      return frame;
    }
    frame.valid = true;
    frame.camera_from_head = state.camera_from_head;
    frame.weights = state.weights;
    frame.vertices_m = fit->vertices(state);
    if (!skin) skin = fit->skin_of(seen, state);
    before = std::move(state);
    times.fit_s += watch.lap();
    return frame;
  }

  std::vector<TrackedFrame> give() {
    std::vector<TrackedFrame> given;
    for (; !waiting.empty(); waiting.pop_front()) given.push_back(track(waiting.front()));
    return given;
  }
};

FaceTracker::FaceTracker(const expression::FaceModel& model, const capture::Intrinsics& camera,
                         const TrackerOptions& options)
    : impl_(std::make_unique<Impl>(model, camera, options)) {}
FaceTracker::~FaceTracker() = default;

std::vector<TrackedFrame> FaceTracker::feed(const capture::Frame& frame) {
  Waiting seen = impl_->look(frame);
  if (seen.seen) ++impl_->faces;
  impl_->waiting.push_back(std::move(seen));
  if (!impl_->neutral && impl_->faces > 0) {
    if (impl_->faces < impl_->options.neutral_frames) return {};
    impl_->find_neutral();
  }
  return impl_->give();
}

std::vector<TrackedFrame> FaceTracker::finish() {
  if (!impl_->neutral) impl_->find_neutral();
  return impl_->give();
}

const std::optional<Neutral>& FaceTracker::neutral() const {
  return impl_->neutral;
}
const TrackerTimes& FaceTracker::times() const {
  return impl_->times;
}

}  // namespace hyperex::tracking
