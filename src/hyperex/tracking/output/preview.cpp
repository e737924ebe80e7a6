// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "hyperex/face/ibug.hpp"
#include "hyperex/render/hidden.hpp"
#include "hyperex/render/side_marks.hpp"
#include "hyperex/tracking/fit/depth_view.hpp"

namespace hyperex::tracking {

namespace {

using render::Canvas;
using render::Colour;

constexpr int kLongerSide = 960;  // of the drawn picture
constexpr int kPanelWidth = 230, kStatusHeight = 28, kBannerHeight = 30;
constexpr int kRowHeight = 27, kBarWidth = 150, kMostRows = 16;
constexpr double kFade = 0.93;  // factor of a unit's strength from frame to frame
constexpr double kAxisLength_m = 0.09;
constexpr double kBehind_m = 0.002;  // edges up to this distance below the surface are still drawn

constexpr Colour kPanel{0.11, 0.12, 0.14}, kInk{0.92, 0.93, 0.94}, kFaint{0.60, 0.62, 0.65};
constexpr Colour kTrack{0.22, 0.23, 0.26}, kPositive{0.98, 0.66, 0.16}, kNegative{0.36, 0.65, 0.95};
constexpr Colour kWire{0.30, 0.90, 0.78}, kIbug{1.0, 0.92, 0.25}, kNamed{1.0, 0.45, 0.75};
constexpr Colour kAlarm{0.80, 0.10, 0.10}, kNoPicture{0.30, 0.31, 0.33};
constexpr Colour kAxes[3] = {{0.95, 0.25, 0.20}, {0.35, 0.85, 0.25}, {0.30, 0.50, 1.0}};
constexpr const char* kAxisNames[3] = {"L", "up", "front"};

/// Video encoders work in blocks of this size, pixels.
int whole_blocks(double length_px) {
  return 16 * int(std::ceil(length_px / 16));
}

std::vector<std::array<int, 4>> edges_of(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::array<int, 4>> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      auto [edge, fresh] =
          edges.try_emplace(std::minmax(a, b), std::array<int, 4>{a, b, int(t), -1});
      if (!fresh) edge->second[3] = int(t);
    }
  std::vector<std::array<int, 4>> list;
  for (const auto& [key, edge] : edges) list.push_back(edge);
  return list;
}

/// For each triangle, whether it faces the camera at the origin. Triangles are counter-clockwise
/// seen from outside.
std::vector<bool> facing(const TriMesh& seen) {
  std::vector<bool> faces(std::size_t(seen.triangles.rows()));
  for (Eigen::Index t = 0; t < seen.triangles.rows(); ++t) {
    const Vec3 a = seen.points.row(seen.triangles(t, 0)), b = seen.points.row(seen.triangles(t, 1)),
               c = seen.points.row(seen.triangles(t, 2));
    faces[std::size_t(t)] = (b - a).cross(c - a).dot(a) < 0;
  }
  return faces;
}

/// The text, shortened to the width.
std::string fitted(const Canvas& canvas, std::string text, double width_px,
                   const render::TextStyle& style) {
  if (canvas.text_width(text, style) <= width_px) return text;
  while (!text.empty() && canvas.text_width(text + "…", style) > width_px) {
    do text.pop_back();
    while (!text.empty() && (text.back() & 0xC0) == 0x80);  // whole characters of UTF-8
  }
  return text + "…";
}

std::string unit_label(const expression::DeformationUnit& unit) {
  return unit.facs.empty() ? unit.name : unit.facs + "  " + unit.name;
}

/// On a light patch whose lower left corner is at (x, y), or the nearest place in the picture.
void draw_side(Canvas& canvas, const std::string& letter, double x, double y,
               const cv::Size& picture) {
  constexpr int kWidth = 17, kHeight = 17;
  if (letter.empty()) return;
  // Whole pixels, so that the letter looks the same wherever it is.
  const int left = std::clamp(int(std::lround(x)), 0, std::max(0, picture.width - kWidth));
  const int low = std::clamp(int(std::lround(y)), std::min(kHeight, picture.height),
                             std::max(kHeight, picture.height));
  canvas.rectangle(left, low - kHeight, kWidth, kHeight, render::palette::background);
  canvas.text(left + 3, low - 3, letter, {.size_px = 15, .bold = true});
}

render::Image to_image(const cv::Mat& bgr) {
  render::Image image(bgr.cols, bgr.rows);
  cv::cvtColor(bgr, cv::Mat(bgr.rows, bgr.cols, CV_8UC3, image.rgb.data()), cv::COLOR_BGR2RGB);
  return image;
}

}  // namespace

PreviewPainter::PreviewPainter(const expression::FaceModel& model,
                               const capture::Intrinsics& camera)
    : model_(model),
      camera_(camera),
      scale_(double(kLongerSide) / std::max(camera.width_px, camera.height_px)),
      picture_width_(int(std::lround(scale_ * camera.width_px))),
      picture_height_(int(std::lround(scale_ * camera.height_px))),
      width_px_(whole_blocks(picture_width_ + kPanelWidth)),
      height_px_(whole_blocks(picture_height_ + kStatusHeight)),
      edges_(edges_of(model.mesh.triangles)),
      strength_(Eigen::VectorXd::Zero(Eigen::Index(model.animation_units.size()))) {}

Eigen::Vector2d PreviewPainter::place(const Vec3& in_camera) const {
  // The canvas counts from pixel edges, the camera from pixel centres.
  return scale_ * (project(camera_, in_camera).array() + 0.5);
}

cv::Mat PreviewPainter::draw(const TrackedFrame& frame, const cv::Mat& bgr) {
  Canvas canvas(width_px_, height_px_, kPanel);
  if (bgr.cols == camera_.width_px && bgr.rows == camera_.height_px && bgr.type() == CV_8UC3) {
    cv::Mat scaled = bgr;
    const cv::Size size(picture_width_, picture_height_);
    if (bgr.size() != size)
      cv::resize(bgr, scaled, size, 0, 0, scale_ < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    canvas.draw(to_image(scaled), 0, 0);
  } else {
    canvas.rectangle(0, 0, picture_width_, picture_height_, kNoPicture);
  }
  if (frame.valid) draw_face(canvas, frame);
  // The panels cover whatever extends beyond the border of the picture.
  canvas.rectangle(picture_width_, 0, width_px_ - picture_width_, height_px_, kPanel);
  canvas.rectangle(0, picture_height_, width_px_, height_px_ - picture_height_, kPanel);
  draw_units(canvas, frame);
  draw_status(canvas, frame);
  if (!frame.valid) draw_banner(canvas, frame.fault);
  render::Image image = canvas.image();
  cv::Mat drawn;
  cv::cvtColor(cv::Mat(image.height, image.width, CV_8UC3, image.rgb.data()), drawn,
               cv::COLOR_RGB2BGR);
  return drawn;
}

void PreviewPainter::draw_face(Canvas& canvas, const TrackedFrame& frame) const {
  const auto in_camera = [&](const Points& points) {
    Points out(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      out.row(i) = (frame.camera_from_head * Vec3(points.row(i))).transpose();
    return out;
  };
  const TriMesh seen{in_camera(frame.vertices_m), model_.mesh.triangles};
  if (seen.points.col(2).minCoeff() <= 0) return;  // not in front of the camera
  draw_wires(canvas, seen);
  draw_landmarks(canvas, seen, in_camera(expression::landmarks_on(model_, frame.vertices_m)));
  draw_axes(canvas, frame.camera_from_head);
  draw_sides(canvas, seen, frame.camera_from_head);
}

void PreviewPainter::draw_wires(Canvas& canvas, const TriMesh& seen) const {
  const std::vector<bool> faces = facing(seen);
  Points middles(Eigen::Index(edges_.size()), 3);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    middles.row(Eigen::Index(e)) =
        0.5 * (seen.points.row(edges_[e][0]) + seen.points.row(edges_[e][1]));
  const std::vector<bool> hidden = render::hidden_from_origin(seen, middles, kBehind_m);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto& [a, b, left, right] = edges_[e];
    if (hidden[e] || !(faces[std::size_t(left)] || (right >= 0 && faces[std::size_t(right)])))
      continue;
    const Eigen::Vector2d from = place(seen.points.row(a)), to = place(seen.points.row(b));
    canvas.line(from.x(), from.y(), to.x(), to.y(), kWire, 0.6);
  }
}

void PreviewPainter::draw_landmarks(Canvas& canvas, const TriMesh& seen,
                                    const Points& landmarks) const {
  const std::vector<bool> hidden = render::hidden_from_origin(seen, landmarks, 2 * kBehind_m);
  std::size_t row = 0;
  for (const auto& [name, vertices] : model_.landmarks) {
    const std::size_t at = row++;
    if (hidden[at]) continue;
    const Eigen::Vector2d px = place(landmarks.row(Eigen::Index(at)));
    canvas.disc(px.x(), px.y(), face::ibug_number(name) ? 2.4 : 3.2,
                face::ibug_number(name) ? kIbug : kNamed);
  }
}

void PreviewPainter::draw_axes(Canvas& canvas, const Eigen::Isometry3d& camera_from_head) const {
  const Vec3 origin = camera_from_head.translation();
  int order[3] = {0, 1, 2};  // the axis pointing farthest away first, so that nearer ones cover it
  std::sort(order, order + 3, [&](int a, int b) {
    return camera_from_head.linear()(2, a) > camera_from_head.linear()(2, b);
  });
  const Eigen::Vector2d from = place(origin);
  for (const int k : order) {
    const Vec3 end = origin + kAxisLength_m * camera_from_head.linear().col(k);
    if (end.z() <= 0 || origin.z() <= 0) continue;
    const Eigen::Vector2d to = place(end);
    canvas.line(from.x(), from.y(), to.x(), to.y(), kAxes[k], 2.5);
    canvas.text(to.x() + 4, to.y() - 4, kAxisNames[k],
                {.size_px = 13, .colour = kAxes[k], .bold = true});
  }
}

void PreviewPainter::draw_sides(Canvas& canvas, const TriMesh& seen,
                                const Eigen::Isometry3d& camera_from_head) const {
  constexpr double kGap = 8, kPatch = 17;
  Eigen::Array2d low = place(seen.points.row(0)), high = low;
  for (Eigen::Index i = 1; i < seen.points.rows(); ++i) {
    const Eigen::Array2d at = place(seen.points.row(i));
    low = low.min(at), high = high.max(at);
  }
  const Vec3 middle = seen.points.colwise().mean();
  const render::Camera camera{.to_viewer = -middle, .up = -Vec3::UnitY()};
  const auto marks = render::side_marks(camera, camera_from_head.linear().col(0));
  const cv::Size picture(picture_width_, picture_height_);
  draw_side(canvas, marks.at_left, low.x() - kGap - kPatch, low.y() + kPatch, picture);
  draw_side(canvas, marks.in_middle, (low.x() + high.x() - kPatch) / 2, low.y() - kGap, picture);
  draw_side(canvas, marks.at_right, high.x() + kGap, low.y() + kPatch, picture);
}

void PreviewPainter::draw_units(Canvas& canvas, const TrackedFrame& frame) {
  strength_ *= kFade;
  if (frame.valid) strength_ = strength_.cwiseMax(frame.weights.cwiseAbs());
  std::vector<Eigen::Index> units(std::size_t(strength_.size()));
  std::iota(units.begin(), units.end(), Eigen::Index(0));
  const auto rows =
      std::min<std::size_t>(units.size(), std::size_t(picture_height_ / kRowHeight) - 1);
  std::stable_sort(units.begin(), units.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return strength_[a] > strength_[b]; });
  units.resize(std::min<std::size_t>(rows, kMostRows));
  std::sort(units.begin(), units.end());
  const double x = picture_width_ + 12;
  double y = 18;
  canvas.text(x, y, "Action units", {.size_px = 13, .colour = kInk, .bold = true});
  for (const Eigen::Index k : units) {
    y += kRowHeight;
    canvas.text(x, y - 3, unit_label(model_.animation_units[std::size_t(k)]),
                {.size_px = 11, .colour = kFaint});
    canvas.rectangle(x, y + 2, kBarWidth, 6, kTrack);
    if (!frame.valid) continue;
    const double weight = frame.weights[k];
    canvas.rectangle(x, y + 2, kBarWidth * std::min(1.0, std::abs(weight)), 6,
                     weight < 0 ? kNegative : kPositive);
    canvas.text(x + kPanelWidth - 24, y + 9, fmt::format("{:.2f}", weight),
                {.size_px = 11, .colour = kInk, .align = render::Align::right});
  }
}

void PreviewPainter::draw_status(Canvas& canvas, const TrackedFrame& frame) const {
  std::string text = fmt::format("{:8.3f} s    frame {}", frame.time_s, frame.index);
  if (frame.valid) {
    text += fmt::format("    head at {:.3f} m    network {:.1f} px",
                        frame.camera_from_head.translation().z(), frame.report.network_rms_px);
    if (frame.report.depth_share > 0)
      text += fmt::format("    depth {:.1f} mm", 1e3 * frame.report.depth_rms_m);
  }
  const render::TextStyle style{.size_px = 13, .colour = kInk};
  canvas.text(10, picture_height_ + 19, fitted(canvas, text, width_px_ - 20, style), style);
}

void PreviewPainter::draw_banner(Canvas& canvas, const std::string& fault) const {
  canvas.rectangle(0, 0, picture_width_, kBannerHeight, kAlarm);
  const render::TextStyle style{.size_px = 14, .colour = {1, 1, 1}, .bold = true};
  canvas.text(10, 20, fitted(canvas, "not valid: " + fault, picture_width_ - 20, style), style);
}

}  // namespace hyperex::tracking
