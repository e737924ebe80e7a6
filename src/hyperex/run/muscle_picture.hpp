// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/simulate/performance.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::run {

/// A picture of the muscles on this face, for checking by an anatomist. It shows their lines over
/// the skin at rest, from the front and from both sides. Each line begins at a numbered disc at the
/// origin (for a ring, in its middle). Muscles that end along the fold from nose to mouth have a
/// translucent sheet between origin and fold, and rings are closed loops (MuscleShape). Colours are
/// those of the branches of the facial nerve. A line's width increases with the activation at the
/// sample in which the sum of all activations is greatest. A list beside the picture gives the
/// names and these activations on both sides, with a star where one is mostly the prior's choice.
render::Image draw_muscles(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                           const simulate::MuscleCourse& course,
                           const muscles::MuscleTable& table = muscles::muscle_template());

}  // namespace hyperex::run
