// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate::test {

/// The canonical face with open eyes and mouth, not refined, on one layer of tissue: all features
/// of a face in about 900 nodes. Skin and outer surface are the same.
struct SmallFace {
  tissue::TissueMesh mesh;
  io::Landmarks landmarks;  ///< the 68 iBUG points
};
SmallFace small_face(int layers = 1);

/// A motion whose points are the landmarks, in the scan's frame. In sample k, point p with rest
/// position x is displaced by displacement(p, x, k).
AlignedMotion motion_of(
    const io::Landmarks& landmarks, int samples, double rate_hz,
    const std::function<Vec3(const std::string&, const Vec3&, int)>& displacement);

/// The chin and the lower lip rotate about the jaw's axis and back: `samples` samples at `rate_hz`.
AlignedMotion mouth_opening(const io::Landmarks& landmarks, double peak_deg, int samples,
                            double rate_hz);

/// The usual seven points: the corners of the mouth, the middle of each lip, the points on either
/// side of the lower lip's middle, and the chin.
const std::vector<std::string>& seven_points();

}  // namespace hyperex::simulate::test
