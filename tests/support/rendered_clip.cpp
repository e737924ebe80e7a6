// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/rendered_clip.hpp"

#include <cmath>
#include <numbers>

#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::test {
namespace {

const Vec3 kProportions(0.95, 1.04, 1.0);  // of the person relative to the embedded face
const capture::Intrinsics kCamera{525, 525, 319.5, 239.5, 640, 480};

const sample::Person& person() {
  static const sample::Person person = [] {
    anatomy::EmbeddedFace face = anatomy::embedded_face();
    face.mesh.points = (face.mesh.points * kProportions.asDiagonal()).eval();
    for (auto& [name, at] : face.landmarks) at = at.cwiseProduct(kProportions).eval();
    return sample::Person(face);
  }();
  return person;
}

std::vector<sample::Moment> moments() {
  using Clip = RenderedClip;
  std::vector<sample::Moment> moments;
  for (std::size_t k = 0; k < Clip::kFrames; ++k) {
    const double phase = k < Clip::kRestFrames
                             ? 0
                             : 2 * std::numbers::pi * double(k + 1 - Clip::kRestFrames) /
                                   double(Clip::kFrames - Clip::kRestFrames);
    const double there = (1 - std::cos(phase)) / 2;
    moments.push_back({{.jaw_open = there},
                       sample::camera_from_head({.yaw_deg = Clip::kYawPeak_deg * std::sin(phase),
                                                 .nod_deg = Clip::kNodPeak_deg * there,
                                                 .right_m = Clip::kShift_m * std::sin(phase),
                                                 .back_m = Clip::kShift_m * there})});
  }
  return moments;
}

}  // namespace

RenderedClip::RenderedClip() : RenderedFace(person(), moments(), {.camera = kCamera}) {}

}  // namespace hyperex::test
