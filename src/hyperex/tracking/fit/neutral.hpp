// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/tracking/fit/frame_fit.hpp"

namespace hyperex::tracking {

struct NeutralOptions {
  FitOptions fit;
  int rounds = 3;
  double vertex_m = 0.001;  ///< of a vertex's mean over the frames
  double bend_m = 0.001;    ///< of a vertex's difference from the model against its neighbours'
  double eye_distance_m = 0.09;  ///< outer corner to outer corner, where there is no depth
};

/// The person's shape from some frames, at least one. Round by round each frame is fitted with the
/// shape so far; then each vertex becomes the mean over the frames of where the picture and the
/// depth at its network point put it, taken back to rest, and is held to the model's shape units
/// and to its neighbours as its spread requires.
Neutral estimate_neutral(const expression::FaceModel& model, const capture::Intrinsics& camera,
                         const std::vector<Observation>& frames,
                         const NeutralOptions& options = {});

/// Throws InputError where depth puts the outer corners of the eyes less than 50 or more than 150
/// mm apart: the depth's unit or the camera is not as stated then.
void check_size(const expression::FaceModel& model, const Neutral& neutral);

}  // namespace hyperex::tracking
