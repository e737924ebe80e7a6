// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/eye_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hyperex/render/sky_share.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using Rgb = std::array<double, 3>;

constexpr int kSectors = 64;
/// Angles from the gaze, radians: close together where colours change.
constexpr double kAngles[] = {0,    0.08, 0.155, 0.172, 0.2,  0.24, 0.29,      0.34,
                              0.39, 0.44, 0.47,  0.495, 0.53, 0.58, 0.66,      0.78,
                              0.95, 1.15, 1.4,   1.7,   2.1,  2.6,  3.14159265};
constexpr double kPupil = 0.16, kIris = 0.51;

Rgb mixed(const Rgb& a, const Rgb& b, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return {std::lerp(a[0], b[0], s), std::lerp(a[1], b[1], s), std::lerp(a[2], b[2], s)};
}

/// Fibres of the iris run outwards: some are lighter.
double fibre(int sector) {
  const auto wave = [&](int times, double phase) {
    return std::cos(2 * std::numbers::pi * times * sector / kSectors + phase);
  };
  return 0.4 * wave(17, 0.3) + 0.35 * wave(23, 2.1) + 0.25 * wave(29, 4.0);
}

Rgb colour_at(double angle, int sector) {
  constexpr Rgb pupil{14, 12, 11}, inner{142, 108, 70}, outer{98, 78, 58}, rim{40, 32, 27};
  constexpr Rgb white{236, 231, 224}, edge{216, 188, 178};
  if (angle < kPupil) return pupil;
  if (angle > kIris) return mixed(white, edge, (angle - kIris) / 0.75);
  const double out = (angle - kPupil) / (kIris - kPupil);
  Rgb iris = mixed(inner, outer, out / 0.6);
  for (double& value : iris) value *= 1 + 0.22 * fibre(sector) * std::min(1.0, 3 * (1 - out));
  return mixed(iris, rim, (out - 0.72) / 0.28);
}

EyeModel make() {
  constexpr auto rings = Index(std::size(kAngles));
  EyeModel eye;
  eye.mesh.points.resize(rings * kSectors, 3);
  eye.colours.resize(rings * kSectors, 3);
  for (Index r = 0; r < rings; ++r)
    for (int k = 0; k < kSectors; ++k) {
      const double angle = kAngles[r], turn = 2 * std::numbers::pi * k / kSectors;
      eye.mesh.points.row(r * kSectors + k) << std::sin(angle) * std::cos(turn),
          std::sin(angle) * std::sin(turn), std::cos(angle);
      const Rgb colour = colour_at(angle, k);
      for (int c = 0; c < 3; ++c)
        eye.colours(r * kSectors + k, c) =
            static_cast<std::uint8_t>(std::lround(std::clamp(colour[std::size_t(c)], 0.0, 255.0)));
    }
  eye.mesh.triangles.resize(2 * (rings - 1) * kSectors, 3);
  Index row = 0;
  for (Index r = 0; r + 1 < rings; ++r)
    for (int k = 0; k < kSectors; ++k) {
      const int a = int(r) * kSectors + k, b = int(r) * kSectors + (k + 1) % kSectors;
      eye.mesh.triangles.row(row++) << a, a + kSectors, b + kSectors;
      eye.mesh.triangles.row(row++) << a, b + kSectors, b;
    }
  return eye;
}

}  // namespace

const EyeModel& eye_model() {
  static const EyeModel eye = make();
  return eye;
}

Eigen::Quaterniond looking_along(const Vec3& gaze) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), gaze);
}

std::array<Eigen::Quaterniond, 2> turns_of(const expression::EyesGaze& gaze,
                                           const std::vector<anatomy::Eyeball>& eyes) {
  const Vec3 across = eyes.at(1).centre - eyes.at(0).centre;
  return {expression::turn_of(gaze.right, eyes[0].gaze, across),
          expression::turn_of(gaze.left, eyes[1].gaze, across)};
}

std::vector<anatomy::Eyeball> turned(std::vector<anatomy::Eyeball> eyes,
                                     const expression::EyesGaze& gaze) {
  if (eyes.empty()) return eyes;
  const auto turns = turns_of(gaze, eyes);
  for (std::size_t side = 0; side < 2; ++side) eyes[side].gaze = turns[side] * eyes[side].gaze;
  return eyes;
}

TriMesh placed_eye(const anatomy::Eyeball& eye) {
  const TriMesh& unit = eye_model().mesh;
  const Eigen::Matrix3d turn = looking_along(eye.gaze).toRotationMatrix();
  return {(eye.radius_m * unit.points * turn.transpose()).rowwise() + eye.centre.transpose(),
          unit.triangles};
}

std::vector<Eigen::VectorXf> light_on_eyes(const std::vector<anatomy::Eyeball>& eyes,
                                           const TriMesh& skin) {
  const Points& unit = eye_model().mesh.points;
  const Index each = unit.rows();
  Points places(each * Index(eyes.size()), 3), normals(places.rows(), 3);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    places.middleRows(each * Index(i), each) = placed_eye(eyes[i]).points;
    normals.middleRows(each * Index(i), each) =
        unit * looking_along(eyes[i].gaze).toRotationMatrix().transpose();
  }
  const Eigen::VectorXf light = render::sky_share(skin, places, normals);
  std::vector<Eigen::VectorXf> out;
  for (std::size_t i = 0; i < eyes.size(); ++i)
    out.emplace_back(light.segment(each * Index(i), each).cwiseMax(kLeastEyeLight));
  return out;
}

}  // namespace hyperex::report
