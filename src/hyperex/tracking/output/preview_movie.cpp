// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/preview_movie.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"

namespace hyperex::tracking {

namespace {

constexpr std::size_t kFirst = 12;    // number of frames from which the rate is estimated
constexpr double kLongestGap_s = 10;  // longer gaps are shortened to this

}  // namespace

double frame_rate_hz(const std::vector<double>& time_s) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time_s.size(); ++k)
    if (time_s[k] > time_s[k - 1]) steps.push_back(time_s[k] - time_s[k - 1]);
  if (steps.empty()) return 30;
  const double rate = std::clamp(1 / median(steps), 1.0, 120.0);
  // If times are written with few digits, 30.0003 means 30.
  return std::abs(rate - std::round(rate)) < 0.01 * rate ? std::round(rate) : rate;
}

PreviewMovie::PreviewMovie(std::filesystem::path file, const expression::FaceModel& model,
                           const capture::Intrinsics& camera)
    : file_(std::move(file)), painter_(model, camera) {
  capture::VideoWriter::check_name(file_);
}

void PreviewMovie::add(const TrackedFrame& frame, const cv::Mat& bgr) {
  Drawn drawn{frame.time_s, painter_.draw(frame, bgr)};
  if (writer_) return show(std::move(drawn));
  first_.push_back(std::move(drawn));
  if (first_.size() == kFirst) begin();
}

void PreviewMovie::begin() {
  std::vector<double> time_s;
  for (const Drawn& drawn : first_) time_s.push_back(drawn.time_s);
  rate_hz_ = frame_rate_hz(time_s);
  start_s_ = time_s.front();
  last_s_ = start_s_ - 1 / rate_hz_;
  writer_.emplace(file_, painter_.width_px(), painter_.height_px(), rate_hz_);
  for (Drawn& drawn : first_) show(std::move(drawn));
  first_.clear();
}

void PreviewMovie::show(Drawn drawn) {
  // The time of frames that are not valid may stay constant or decrease; these follow the last
  // frame.
  const double time_s = drawn.time_s > last_s_ ? drawn.time_s : last_s_ + 1 / rate_hz_;
  if (time_s > last_s_ + kLongestGap_s) start_s_ += time_s - last_s_ - kLongestGap_s;
  last_s_ = time_s;
  const long due = std::lround((time_s - start_s_) * rate_hz_);
  for (; shown_ < due && !standing_.empty(); ++shown_) writer_->add(standing_);
  standing_ = std::move(drawn.picture);
  if (shown_ > due) return;
  writer_->add(standing_);
  ++shown_;
}

void PreviewMovie::finish() {
  if (!writer_ && !first_.empty()) begin();
  if (writer_) writer_->finish();
}

}  // namespace hyperex::tracking
