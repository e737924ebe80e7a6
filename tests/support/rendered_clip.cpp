// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/rendered_clip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/tissue/canonical_face.hpp"
#include "unit/tracking/face_depth.hpp"

namespace hyperex::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRate_hz = 30, kDistance_m = 0.6;
constexpr double kDepthNoise_m = 0.001, kColourNoise = 2;
constexpr double kCondyleInwards = 0.1;  // of the width between the outlines beside the ears
constexpr double kStepBetweenLips_m = 0.0005, kStepWidening = 0.9;
const Vec3 kProportions(0.95, 1.04, 1.0);  // of the person relative to the embedded face
const capture::Intrinsics kCamera{525, 525, 319.5, 239.5, 640, 480};

/// The person at rest, head frame, and where the jaw's axis and the line of the lips are.
struct Person {
  TriMesh mesh;
  render::VertexColours colours;
  tracking::Points68 landmarks;
  std::vector<Vec3> lip_line;  // from corner to corner, x rising
  Vec3 condyle;                // the axis is along x
};

void colour_lips(Person& person) {
  std::vector<cv::Point2f> outline;
  for (int k = 48; k < 60; ++k)
    outline.emplace_back(float(person.landmarks(k, 0)), float(person.landmarks(k, 1)));
  const auto rows = person.mesh.points.rows();
  person.colours.resize(rows, 3);
  for (Eigen::Index v = 0; v < rows; ++v) {
    const cv::Point2f at(float(person.mesh.points(v, 0)), float(person.mesh.points(v, 1)));
    const bool lip = cv::pointPolygonTest(outline, at, false) > 0;
    person.colours.row(v) << (lip ? 180 : 214), (lip ? 110 : 180), (lip ? 105 : 160);
  }
}

/// A dark wall behind the lips, so that an open mouth is dark and has depth.
void add_mouth(Person& person, const Vec3& lips) {
  constexpr double behind_m = 0.035, half_width_m = 0.024, up_m = 0.012, down_m = 0.025;
  const auto first = person.mesh.points.rows(), face = person.mesh.triangles.rows();
  person.mesh.points.conservativeResize(first + 4, 3);
  person.colours.conservativeResize(first + 4, 3);
  person.mesh.triangles.conservativeResize(face + 2, 3);
  for (int k = 0; k < 4; ++k) {
    person.mesh.points.row(first + k) =
        lips.transpose() +
        Eigen::RowVector3d(k % 2 ? half_width_m : -half_width_m, k < 2 ? -down_m : up_m, -behind_m);
    person.colours.row(first + k) << 70, 30, 30;
  }
  const int a = int(first);
  person.mesh.triangles.row(face) << a, a + 1, a + 3;
  person.mesh.triangles.row(face + 1) << a, a + 3, a + 2;
}

const Person& person() {
  static const Person person = [] {
    const tissue::EmbeddedFace face = tissue::embedded_face();
    const auto stretched = [](const Vec3& p) -> Vec3 { return p.cwiseProduct(kProportions); };
    Person made;
    made.mesh = face.mesh;
    for (auto point : made.mesh.points.rowwise())
      point = stretched(point.transpose()).transpose().eval();
    for (int k = 0; k < 68; ++k)
      made.landmarks.row(k) =
          stretched(face.landmarks.at("ibug68_" + std::to_string(k))).transpose();
    const Points& canonical = face::canonical_face().mesh.points;
    const auto& contour = face::lip_contour();  // the upper lip, then the lower one back
    for (std::size_t i = 0; i <= contour.size() / 2; ++i) {
      const Vec3 upper = canonical.row(contour[i]).transpose(),
                 lower = canonical.row(contour[(contour.size() - i) % contour.size()]).transpose();
      made.lip_line.push_back(stretched((upper + lower) / 2));
    }
    const Vec3 right = made.landmarks.row(1).transpose(), left = made.landmarks.row(15).transpose();
    made.condyle = right + kCondyleInwards * (left - right);
    colour_lips(made);
    add_mouth(made, made.lip_line[made.lip_line.size() / 2]);
    return made;
  }();
  return person;
}

/// How far a point at rest follows the jaw, 0 to 1.
double jaw_share(const Vec3& p) {
  const std::vector<Vec3>& line = person().lip_line;
  const double x = std::clamp(p.x(), line.front().x(), line.back().x());
  std::size_t k = 1;
  while (k + 1 < line.size() && line[k].x() < x) ++k;
  const Vec3 &a = line[k - 1], &b = line[k];
  const double line_y = a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
  const double half_step = kStepBetweenLips_m + kStepWidening * std::abs(p.x() - x);
  const double t = std::clamp(((line_y - p.y()) / half_step + 1) / 2, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

template <class Rows>
Rows jaw_turned(Rows points, double jaw_rad) {
  for (auto point : points.rowwise()) {
    const Vec3 p = point.transpose();
    const Eigen::AngleAxisd turn(jaw_rad * jaw_share(p), Vec3::UnitX());
    point = (person().condyle + turn * (p - person().condyle)).transpose();
  }
  return points;
}

struct Moment {
  double jaw_open = 0;  // of the peak
  Eigen::Isometry3d camera_from_head;
};

Moment moment(std::size_t frame) {
  using Clip = RenderedClip;
  const double phase = frame < Clip::kRestFrames
                           ? 0
                           : 2 * std::numbers::pi * double(frame + 1 - Clip::kRestFrames) /
                                 double(Clip::kFrames - Clip::kRestFrames);
  const double there = (1 - std::cos(phase)) / 2;
  Moment made;
  made.jaw_open = there;
  made.camera_from_head =
      Eigen::Translation3d(Clip::kShift_m * std::sin(phase), 0,
                           kDistance_m + Clip::kShift_m * there) *
      Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()) *
      Eigen::AngleAxisd(Clip::kYawPeak_deg * kDegree * std::sin(phase), Vec3::UnitY()) *
      Eigen::AngleAxisd(Clip::kNodPeak_deg * kDegree * there, Vec3::UnitX());
  return made;
}

/// The camera's picture of a mesh, camera frame. The renderer looks along parallel rays; the
/// projective map (x, y, z) -> d (x, -y, d - z) / z makes the camera's rays parallel, keeps
/// triangles plane and, at z = d, lengths.
cv::Mat picture_of(const TriMesh& mesh) {
  TriMesh parallel = mesh;
  for (auto point : parallel.points.rowwise())
    point = kDistance_m / point.z() *
            Eigen::RowVector3d(point.x(), -point.y(), kDistance_m - point.z());
  const render::Camera camera{.height_m = kCamera.height_px * kDistance_m / kCamera.fy_px};
  render::Image image = render::render({{.mesh = parallel, .colours = person().colours}}, camera,
                                       {.width_px = kCamera.width_px,
                                        .height_px = kCamera.height_px,
                                        .samples = 2,
                                        .background = {0.45, 0.47, 0.5}});
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(kCamera.height_px, kCamera.width_px, CV_8UC3, image.rgb.data()), bgr,
               cv::COLOR_RGB2BGR);
  return bgr;
}

void add_noise(capture::Frame& frame) {
  cv::RNG random(frame.index + 1);
  cv::Mat colour(frame.colour.size(), CV_16SC3), depth(frame.depth_m.size(), CV_32F);
  random.fill(colour, cv::RNG::NORMAL, 0, kColourNoise);
  random.fill(depth, cv::RNG::NORMAL, 0, kDepthNoise_m);
  cv::add(frame.colour, colour, frame.colour, cv::noArray(), CV_8UC3);
  cv::add(frame.depth_m, depth, frame.depth_m, frame.depth_m > 0);
}

}  // namespace

const capture::Intrinsics& RenderedClip::intrinsics() const {
  return kCamera;
}

std::optional<capture::Frame> RenderedClip::next() {
  if (next_ == kFrames) return std::nullopt;
  const Moment now = moment(next_);
  TriMesh seen = person().mesh;
  const auto face = seen.points.rows() - 4;  // the wall of the mouth stays
  seen.points.topRows(face) =
      jaw_turned<Points>(seen.points.topRows(face), now.jaw_open * kJawPeak_deg * kDegree);
  seen.points = tracking::in_camera(now.camera_from_head, seen.points);
  capture::Frame frame;
  frame.index = next_++;
  frame.time_s = double(frame.index) / kRate_hz;
  frame.colour = picture_of(seen);
  frame.depth_m = tracking::depth_of(seen, kCamera);
  add_noise(frame);
  return frame;
}

tracking::Truth RenderedClip::truth() {
  tracking::Truth truth;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const Moment then = moment(k);
    truth.time_s.push_back(double(k) / kRate_hz);
    truth.camera_from_face.push_back(then.camera_from_head);
    truth.landmarks_m.push_back(tracking::in_camera(
        then.camera_from_head,
        jaw_turned(person().landmarks, then.jaw_open * kJawPeak_deg * kDegree)));
    truth.jaw_open.push_back(then.jaw_open);
  }
  return truth;
}

}  // namespace hyperex::test
