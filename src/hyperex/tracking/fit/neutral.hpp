// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/tracking/fit/frame_fit.hpp"

namespace hyperex::tracking {

struct NeutralOptions {
  FitOptions fit;
  int rounds = 3;
  double vertex_m = 0.001;  ///< of a vertex's mean over the frames
  /// For a vertex's deviation from the model, relative to that of its neighbours.
  double bend_m = 0.001;
  double eye_distance_m = 0.09;  ///< between the outer corners; used if there is no depth
};

/// Estimates the person's shape from at least one frame. In each round, every frame is fitted with
/// the current shape. Each vertex is then measured in each frame by the picture and the depth at
/// its network point, transformed back to rest, and averaged over the frames. The averages are
/// regularised towards the model's shape units and the neighbouring vertices, depending on their
/// standard deviation.
Neutral estimate_neutral(const expression::FaceModel& model, const capture::Intrinsics& camera,
                         const std::vector<Observation>& frames,
                         const NeutralOptions& options = {});

/// Throws InputError if depth gives a distance between the outer corners of the eyes below 50 mm or
/// above 150 mm. The unit of the depth or the camera is then probably wrong.
void check_size(const expression::FaceModel& model, const Neutral& neutral);

}  // namespace hyperex::tracking
