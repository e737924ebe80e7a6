// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::report {

/// An eyeball for display: a sphere with the colours of sclera, iris and pupil. No figure depends
/// on it. Iris and pupil have diameters of 11.7 and 4 mm on a ball of 24 mm.
struct EyeModel {
  TriMesh mesh;  ///< radius 1, looking along +z
  render::VertexColours colours;
};

/// Made once.
const EyeModel& eye_model();

/// The rotation from +z to the direction of gaze.
Eigen::Quaterniond looking_along(const Vec3& gaze);

/// The rotations of the right and the left eye about their centres, from how they stand in `eyes`
/// (both, looking ahead) to a gaze.
std::array<Eigen::Quaterniond, 2> turns_of(const expression::EyesGaze& gaze,
                                           const std::vector<anatomy::Eyeball>& eyes);

/// The eyes (both or none) turned to a gaze.
std::vector<anatomy::Eyeball> turned(std::vector<anatomy::Eyeball> eyes,
                                     const expression::EyesGaze& gaze);

/// In its place on the face, metres.
TriMesh placed_eye(const anatomy::Eyeball& eye);

/// The lids at rest take no more light than this leaves: what they cover then shows when they rise
/// or the eye turns.
inline constexpr float kLeastEyeLight = 0.5F;

/// For each vertex of placed_eye() of each eye, the share of the light from all directions that
/// reaches it between the lids, from kLeastEyeLight to 1. `skin`: at rest. The page, the studio and
/// the model all use it.
std::vector<Eigen::VectorXf> light_on_eyes(const std::vector<anatomy::Eyeball>& eyes,
                                           const TriMesh& skin);

}  // namespace hyperex::report
