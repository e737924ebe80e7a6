// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "hyperex/simulate/contact/mouth_contact.hpp"
#include "hyperex/simulate/run/frame_time.hpp"
#include "hyperex/simulate/run/run_progress.hpp"
#include "hyperex/simulate/run/solve.hpp"

namespace hyperex::simulate {

/// Greatest depths beyond rest (m): of the lips in each other, of tissue in teeth, of lids in
/// eyeballs.
struct ContactDepths {
  double lips = 0, teeth = 0, eyes = 0;
  double most() const;
};

/// The frames and stills of a run, for the detection of contact. They are numbered as in
/// `frame_times`.
class ContactFrames {
 public:
  using Places = std::vector<std::shared_ptr<const ObstaclePlaces>>;
  /// Everything must outlive this. `lips`: null where they may pass through each other.
  ContactFrames(const LipSurfaces* lips, const Places& places,
                const std::vector<FrameTime>& frame_times, const Solution& solution,
                const SimulationResult& result, const Eigen::Isometry3d& upper_teeth_now_from_rest);

  std::size_t count() const { return frame_times_.size(); }
  const FrameTime& time_of(std::size_t i) const { return frame_times_[i]; }
  const PointsF& skin(std::size_t i) const;
  Eigen::Map<const Points> nodes(std::size_t i) const;
  const Eigen::Isometry3d& jaw(std::size_t i) const;
  /// Where surgery put the upper teeth.
  const Eigen::Isometry3d& upper_teeth() const { return upper_teeth_; }
  /// Displacements of the places of each obstacle, as last measured.
  const std::vector<Points>& at_sides(std::size_t i) const { return at_sides_[i]; }
  const Places& places() const { return places_; }

  /// Measures the current depths in some frames, in parallel.
  void measure(const std::vector<std::size_t>& which, RunProgress& progress);
  /// The greatest of all frames as last measured.
  ContactDepths greatest() const;
  /// The frames in which a depth is large enough to be corrected.
  std::vector<std::size_t> touching() const;
  /// Which places of each obstacle come near it in some of the frames.
  std::vector<std::vector<char>> near_places(const std::vector<std::size_t>& which) const;
  /// Depths of a face that is displaced in this way, the jaw being as in frame `i`.
  ContactDepths depths(std::size_t i, const PointsF& skin,
                       const std::vector<Points>& at_sides) const;

 private:
  Eigen::Isometry3d pose(const ObstaclePlaces& side, std::size_t i) const;

  const LipSurfaces* lips_;
  const Places& places_;
  const std::vector<FrameTime>& frame_times_;
  const Solution& solution_;
  const SimulationResult& result_;
  Eigen::Isometry3d upper_teeth_;
  std::vector<std::vector<Points>> at_sides_;
  std::vector<ContactDepths> depths_;
};

}  // namespace hyperex::simulate
