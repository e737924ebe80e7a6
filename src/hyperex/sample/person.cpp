// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/person.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/report/eye_model.hpp"
#include "hyperex/sample/painted_face.hpp"

namespace hyperex::sample {
namespace {

constexpr double kCondyleInwards = 0.1;  // of the width between the outlines beside the ears
constexpr double kStepBetweenLips_m = 0.0005, kStepWidening = 0.9;

/// The corner of the mouth, the cheek that it pushes up, and the fold beside the nose.
const std::vector<Bump> kSmile = {
    {"cheilion_R", Person::kSmile_mm, 13},
    {"cheek_R", {-1, 3, 2}, 13},
    {"alare_R", {-1, 1.5, 0}, 7},
};

render::VertexColours one_colour(const TriMesh& mesh, int r, int g, int b) {
  render::VertexColours colours(mesh.points.rows(), 3);
  colours.rowwise() = Eigen::Matrix<std::uint8_t, 1, 3>(r, g, b);
  return colours;
}

}  // namespace

Person::Person(const anatomy::EmbeddedFace& face) : triangles_(face.mesh.triangles) {
  // The canonical vertices are the first ones of the embedded face, in the same order.
  const auto& contour = face::lip_contour();  // the upper lip, then the lower one back
  for (std::size_t i = 0; i <= contour.size() / 2; ++i)
    lip_line_.push_back((face.mesh.points.row(contour[i]) +
                         face.mesh.points.row(contour[(contour.size() - i) % contour.size()]))
                            .transpose() /
                        2);
  const Vec3 &right = face.landmarks.at(face::ibug(1)), &left = face.landmarks.at(face::ibug(15));
  condyle_ = right + kCondyleInwards * (left - right);
  Points landmarks(68, 3);
  for (int k = 0; k < 68; ++k) landmarks.row(k) = face.landmarks.at(face::ibug(k)).transpose();
  skin_ = moving(face.mesh.points, face.landmarks);
  landmarks_ = moving(landmarks, face.landmarks);
  colours_ = painted_face(face.mesh.points, face.landmarks);
  backing_ = report::face_backing(face.mesh, face.landmarks);
}

double Person::jaw_share(const Vec3& p) const {
  const double x = std::clamp(p.x(), lip_line_.front().x(), lip_line_.back().x());
  std::size_t k = 1;
  while (k + 1 < lip_line_.size() && lip_line_[k].x() < x) ++k;
  const Vec3 &a = lip_line_[k - 1], &b = lip_line_[k];
  const double line_y = a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
  const double half_step = kStepBetweenLips_m + kStepWidening * std::abs(p.x() - x);
  return smooth_step(((line_y - p.y()) / half_step + 1) / 2);
}

Person::Moving Person::moving(const Points& rest, const io::Landmarks& landmarks) const {
  Moving made{rest, displacement(kSmile, landmarks, rest), Eigen::VectorXd(rest.rows())};
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    made.jaw_share[v] = jaw_share(rest.row(v).transpose());
  return made;
}

Points Person::Moving::at(const Pose& pose, const Vec3& condyle) const {
  const double peak_rad = kJawPeak_deg * std::numbers::pi / 180;
  Points points(rest.rows(), 3);
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const Eigen::AngleAxisd turn(peak_rad * pose.jaw_open * jaw_share[v], Vec3::UnitX());
    const Vec3 turned = condyle + turn * (rest.row(v).transpose() - condyle);
    points.row(v) = turned.transpose() + pose.smile * smile.row(v);
  }
  return points;
}

std::vector<Person::Part> Person::behind(const Points& skin) const {
  std::vector<Part> parts;
  for (const report::Eyeball& eye : backing_.eyeballs)
    parts.push_back({report::placed_eye(eye), report::eye_model().colours});
  for (const report::Opening& opening : backing_.openings) {
    TriMesh mesh = report::pocket(opening, skin);
    const auto colours = one_colour(mesh, 70, 30, 30);
    parts.push_back({std::move(mesh), colours});
  }
  return parts;
}

}  // namespace hyperex::sample
