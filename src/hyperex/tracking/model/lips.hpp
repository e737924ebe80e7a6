// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/tracking/model/face_model.hpp"

namespace hyperex::tracking {

/// The vertices within the lips' outer border, one entry a vertex: there the landmark network draws
/// the lips as they look, while the skin rolls in and out of the mouth
/// (model/data/network_points.csv).
std::vector<bool> within_lips(const FaceModel& model);

}  // namespace hyperex::tracking
