// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

/// A motion as shape keys that an artist can read and mix: each key is the face's own shape in one
/// of the frames, and every frame is a sum of keys with weights from 0 to 1,
///   displacement(f) ~ sum_k weights(f, k) * displacement(frames[k]).
/// A frame that is a key has the weight 1 there and 0 elsewhere.
struct PoseKeys {
  std::vector<int> frames;  ///< K of them, rising
  Eigen::MatrixXf weights;  ///< N x K, 0 to 1
  double max_error_m = 0;   ///< largest distance of any vertex in any frame from its true place
};

/// The least displacement that a key stores, a twentieth of the tolerance. To save space, vertices
/// that move less have no displacement in that key; max_error_m includes this.
float least_move_m(double tolerance_m);
PointsF pose_of(const PointsF& displacement, float least_m);

/// Keys are chosen one by one: the next key is the frame with the greatest error so far. This ends
/// when no vertex is farther than `tolerance_m` from its place in any frame, or when `take(frame)`
/// returns false. The weights of a frame are the least-squares ones within 0 to 1, by coordinate
/// descent in the coordinates of frame_coordinates(). No motion gives no keys. The same input gives
/// the same keys, however many threads there are.
PoseKeys pose_keys(const std::vector<PointsF>& displacements, double tolerance_m,
                   const std::function<bool(int)>& take);

/// "pose_0.933s", one per key; `time_s` of all frames, counted from the first. Frames so close that
/// their names would be one get more digits.
std::vector<std::string> pose_names(const PoseKeys& keys, const std::vector<double>& time_s);

}  // namespace hyperex::report
