// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/simulate/performance.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::run {

/// Where the muscles lie on this face, for the eye of an anatomist: their lines from origin (disc,
/// numbered; that of a ring in its middle) to insertion over the skin at rest, from in front and
/// from both sides, coloured by branch of the facial nerve and as broad as they are active where
/// all together are most so; beside it their names with that activation on either side.
render::Image draw_muscles(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                           const simulate::MuscleCourse& course,
                           const muscles::MuscleTable& table = muscles::muscle_template());

}  // namespace hyperex::run
