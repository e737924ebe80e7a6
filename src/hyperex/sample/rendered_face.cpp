// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/rendered_face.hpp"

#include <numbers>
#include <opencv2/core.hpp>

#include "hyperex/sample/camera_view.hpp"

namespace hyperex::sample {
namespace {

void add_sensor_noise(capture::Frame& frame, const ClipOptions& options) {
  cv::RNG random(frame.index + 1);
  cv::Mat colour(frame.colour.size(), CV_16SC3), depth(frame.depth_m.size(), CV_32F);
  random.fill(colour, cv::RNG::NORMAL, 0, options.colour_noise);
  random.fill(depth, cv::RNG::NORMAL, 0, options.depth_noise_m);
  cv::add(frame.colour, colour, frame.colour, cv::noArray(), CV_8UC3);
  cv::add(frame.depth_m, depth, frame.depth_m, frame.depth_m > 0);
}

}  // namespace

RenderedFace::RenderedFace(Person person, std::vector<Moment> moments, const ClipOptions& options)
    : person_(std::move(person)), moments_(std::move(moments)), options_(options) {}

std::optional<capture::Frame> RenderedFace::next() {
  if (next_ == moments_.size()) return std::nullopt;
  const Moment& now = moments_[next_];
  const Points skin = person_.skin(now.pose);
  std::vector<Person::Part> parts = person_.behind(skin);
  parts.insert(parts.begin(), {{skin, person_.triangles()}, person_.colours()});
  capture::Frame frame;
  std::vector<SeenMesh> seen;
  for (Person::Part& part : parts) {
    part.mesh.points = in_camera(now.camera_from_head, part.mesh.points);
    const cv::Mat depth_m = depth_of(part.mesh, options_.camera);
    if (frame.depth_m.empty())
      frame.depth_m = depth_m;
    else
      take_nearer(frame.depth_m, depth_m);
    seen.push_back({part.mesh, part.colours});
  }
  frame.index = next_++;
  frame.time_s = double(frame.index) / options_.rate_hz;
  frame.colour =
      colour_of(seen, options_.camera, moments_.front().camera_from_head.translation().z());
  add_sensor_noise(frame, options_);
  return frame;
}

tracking::Truth RenderedFace::truth() const {
  tracking::Truth truth;
  for (std::size_t k = 0; k < moments_.size(); ++k) {
    const Moment& then = moments_[k];
    truth.time_s.push_back(double(k) / options_.rate_hz);
    truth.camera_from_face.push_back(then.camera_from_head);
    truth.landmarks_m.push_back(in_camera(then.camera_from_head, person_.landmarks(then.pose)));
    truth.jaw_open.push_back(then.pose.jaw_open);
  }
  return truth;
}

Eigen::Isometry3d camera_from_head(const HeadPlace& place) {
  constexpr double degree = std::numbers::pi / 180;
  return Eigen::Translation3d(place.right_m, 0, place.distance_m + place.back_m) *
         Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()) *
         Eigen::AngleAxisd(place.yaw_deg * degree, Vec3::UnitY()) *
         Eigen::AngleAxisd(place.nod_deg * degree, Vec3::UnitX());
}

}  // namespace hyperex::sample
