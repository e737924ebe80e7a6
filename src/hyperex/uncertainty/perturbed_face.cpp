// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/uncertainty/perturbed_face.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/face/landmark_errors.hpp"

namespace hyperex::uncertainty {
namespace {

using metrics::ErrorPart;

/// Changes the scene and its variants alike.
template <typename Change>
scene::Scene changed(scene::Scene scene, const Change& change) {
  change(scene);
  for (scene::Variant& variant : scene.variants) change(variant.scene);
  return scene;
}

PerturbedFace other_elements(const scene::Scene& scene, double factor) {
  const double size_m = scene.mesh.element_size_m * factor;
  return {ErrorPart::mesh,
          fmt::format("elements of {:.2g} mm instead of {:.2g}", 1e3 * size_m,
                      1e3 * scene.mesh.element_size_m),
          changed(scene, [&](scene::Scene& s) { s.mesh.element_size_m = size_m; }), false};
}

PerturbedFace moved_landmarks(const scene::Scene& scene, io::Landmarks landmarks, int draw) {
  std::mt19937 random(unsigned(draw) + 1);
  landmarks = face::with_errors(std::move(landmarks), face::kLandmarkError_m, random);
  scene::Scene moved = scene;
  moved.given.landmarks = std::move(landmarks);
  return {ErrorPart::landmarks,
          fmt::format("landmarks moved by {:g} mm", 1e3 * face::kLandmarkError_m), std::move(moved),
          false};
}

/// Each line moved in a direction of its own, on both sides alike; each prior narrower or wider.
muscles::MuscleTable other_muscles(muscles::MuscleTable table, int draw) {
  std::mt19937 random(unsigned(draw) + 101);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  std::normal_distribution<double> normal;
  for (muscles::TemplateMuscle& muscle : table) {
    const double way = angle(random);
    for (muscles::TemplatePlace& place : muscle.path) {
      place.out_mm += 1e3 * kMuscle_m * std::cos(way);
      place.up_mm += 1e3 * kMuscle_m * std::sin(way);
    }
    muscle.readiness *= std::pow(kReadiness, normal(random));
  }
  return table;
}

PerturbedFace moved_muscles(const scene::Scene& scene, int draw) {
  return {ErrorPart::muscles, fmt::format("muscles moved by {:g} mm", 1e3 * kMuscle_m),
          changed(scene,
                  [&](scene::Scene& s) { s.muscles.own = other_muscles(s.muscles.table(), draw); }),
          true};
}

void soften(simulate::BoneLayer& layer) {
  layer.across_pa_per_m /= kStiffness;
  layer.along_pa_per_m /= kStiffness;
}

/// A softer support: what the tissue's stiffness is relative to.
PerturbedFace stiffer(const scene::Scene& scene) {
  return {ErrorPart::stiffness,
          fmt::format("tissue {:g} times as stiff, relative to its support", kStiffness),
          changed(scene,
                  [](scene::Scene& s) {
                    soften(s.muscles.skull_layer);
                    soften(s.muscles.mandible_layer);
                    soften(s.muscles.teeth_layer);
                    s.muscles.foundation_pa_per_m /= kStiffness;
                    s.muscles.throat_pa_per_m /= kStiffness;
                    soften(s.support.skull_layer);
                    soften(s.support.mandible_layer);
                    s.support.field_pa_per_m /= kStiffness;
                  }),
          true};
}

PerturbedFace other_law(const scene::Scene& scene) {
  using simulate::Strain;
  const Strain other = scene.model.strain == Strain::finite ? Strain::linear : Strain::finite;
  return {ErrorPart::law, other == Strain::finite ? "finite strain" : "small strain",
          changed(scene, [&](scene::Scene& s) { s.model.strain = other; }), true};
}

}  // namespace

std::vector<PerturbedFace> perturbed_faces(const scene::Scene& scene,
                                           const io::Landmarks& landmarks) {
  std::vector<PerturbedFace> out;
  out.push_back(stiffer(scene));
  if (scene.drive.by == simulate::DriveBy::muscles)
    for (int draw = 0; draw < kMuscleDraws; ++draw) out.push_back(moved_muscles(scene, draw));
  out.push_back(other_law(scene));
  for (const double factor : kElementSizes) out.push_back(other_elements(scene, factor));
  for (int draw = 0; draw < kLandmarkDraws; ++draw)
    out.push_back(moved_landmarks(scene, landmarks, draw));
  return out;
}

}  // namespace hyperex::uncertainty
