// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>

namespace hyperex::capture {

/// One picture of one sensor, with the time of the device's clock.
struct TimedPicture {
  double time_s = 0;
  cv::Mat picture;
};

/// Pairs the pictures of two streams as they arrive. Times must increase in each stream. The two
/// pictures of a pair are at most `longest_gap_s` apart. A picture without a partner is discarded
/// and counted.
class Pairing {
 public:
  explicit Pairing(double longest_gap_s = 0.02) : longest_gap_s_(longest_gap_s) {}

  void add_colour(TimedPicture picture) { put(colour_, std::move(picture)); }
  void add_depth(TimedPicture picture) { put(depth_, std::move(picture)); }

  /// The next pair of colour and depth, if both have arrived.
  std::optional<std::pair<TimedPicture, TimedPicture>> take() {
    if (!colour_ || !depth_) return std::nullopt;
    if (std::abs(colour_->time_s - depth_->time_s) > longest_gap_s_) {
      ++unpaired_;
      (colour_->time_s < depth_->time_s ? colour_ : depth_).reset();
      return std::nullopt;
    }
    auto pair = std::pair(std::move(*colour_), std::move(*depth_));
    colour_.reset();
    depth_.reset();
    return pair;
  }
  std::size_t unpaired() const { return unpaired_; }

 private:
  void put(std::optional<TimedPicture>& slot, TimedPicture picture) {
    if (slot) ++unpaired_;
    slot = std::move(picture);
  }

  double longest_gap_s_;
  std::optional<TimedPicture> colour_, depth_;
  std::size_t unpaired_ = 0;
};

}  // namespace hyperex::capture
