// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/contact_frames.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hyperex::simulate {
namespace {

/// Places that are never as near to an obstacle without contact (m) are left out of the problem.
constexpr double kMayTouch_m = 0.0015;

}  // namespace

double ContactDepths::most() const {
  return std::max({lips, teeth, eyes});
}

ContactFrames::ContactFrames(const LipSurfaces* lips, const Places& places,
                             const std::vector<FrameTime>& frame_times, const Solution& solution,
                             const SimulationResult& result,
                             const Eigen::Isometry3d& upper_teeth_now_from_rest)
    : lips_(lips && !lips->empty() ? lips : nullptr),
      places_(places),
      frame_times_(frame_times),
      solution_(solution),
      result_(result),
      upper_teeth_(upper_teeth_now_from_rest),
      at_sides_(frame_times.size()),
      depths_(frame_times.size()) {}

const PointsF& ContactFrames::skin(std::size_t i) const {
  const FrameTime& at = frame_times_[i];
  return at.is_still() ? result_.still_displacement_m[at.index()]
                       : result_.performance.skin_displacement_m[at.index()];
}

Eigen::Map<const Points> ContactFrames::nodes(std::size_t i) const {
  const auto column = solution_.displacement.col(Eigen::Index(i));
  return {column.data(), column.size() / 3, 3};
}

const Eigen::Isometry3d& ContactFrames::jaw(std::size_t i) const {
  const FrameTime& at = frame_times_[i];
  return at.is_still() ? result_.still_jaw_now_from_rest[at.index()]
                       : result_.performance.jaw_now_from_rest[at.index()];
}

Eigen::Isometry3d ContactFrames::pose(const ObstaclePlaces& side, std::size_t i) const {
  return side.obstacle().now_from_rest(jaw(i), upper_teeth_);
}

ContactDepths ContactFrames::depths(std::size_t i, const PointsF& skin,
                                    const std::vector<Points>& at_sides) const {
  ContactDepths out;
  if (lips_) out.lips = lips_->depth(skin);
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const ObstaclePlaces& side = *places_[s];
    double& most = side.obstacle().kind == Obstacle::Kind::teeth ? out.teeth : out.eyes;
    most = std::max(most, side.depth(at_sides[s], pose(side, i)));
  }
  return out;
}

void ContactFrames::measure(const std::vector<std::size_t>& which, RunProgress& progress) {
  progress.for_frames(which.size(), [&](std::size_t at) {
    const std::size_t i = which[at];
    at_sides_[i].resize(places_.size());
    for (std::size_t s = 0; s < places_.size(); ++s)
      at_sides_[i][s] = places_[s]->moved(skin(i), nodes(i));
    depths_[i] = depths(i, skin(i), at_sides_[i]);
  });
}

ContactDepths ContactFrames::greatest() const {
  ContactDepths out;
  for (const ContactDepths& one : depths_) {
    out.lips = std::max(out.lips, one.lips);
    out.teeth = std::max(out.teeth, one.teeth);
    out.eyes = std::max(out.eyes, one.eyes);
  }
  return out;
}

std::vector<std::size_t> ContactFrames::touching() const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < depths_.size(); ++i)
    if (depths_[i].most() >= MouthContact::kFelt_m) out.push_back(i);
  return out;
}

std::vector<std::vector<char>> ContactFrames::near_places(
    const std::vector<std::size_t>& which) const {
  std::vector<std::vector<char>> near(places_.size());
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const ObstaclePlaces& side = *places_[s];
    near[s].assign(std::size_t(side.count()), 0);
    tbb::parallel_for(Eigen::Index(0), side.count(), [&](Eigen::Index k) {
      Vec3 outward;
      near[s][std::size_t(k)] = std::any_of(which.begin(), which.end(), [&](std::size_t i) {
        return side.gap_m(k, at_sides_[i][s].row(k), pose(side, i), outward) < kMayTouch_m;
      });
    });
  }
  return near;
}

}  // namespace hyperex::simulate
