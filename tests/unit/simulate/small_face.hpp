// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate::test {

/// The canonical face with its eyes and mouth opened, unrefined, on one layer of tissue: everything
/// a face has, in some 900 nodes. Skin and outer surface are the same.
struct SmallFace {
  tissue::TissueMesh mesh;
  io::Landmarks landmarks;  ///< the 68 iBUG points
};
SmallFace small_face(int layers = 1);

/// A motion whose points are the landmarks, already in the scan's frame: sample k displaces point p
/// (of rest position x) by displacement(p, x, k).
AlignedMotion motion_of(
    const io::Landmarks& landmarks, int samples, double rate_hz,
    const std::function<Vec3(const std::string&, const Vec3&, int)>& displacement);

/// The chin and the lower lip turned about the jaw's axis and back: `samples` at `rate_hz`.
AlignedMotion mouth_opening(const io::Landmarks& landmarks, double peak_deg, int samples,
                            double rate_hz);

/// Those of section 7: corners, middles of the lips, chin and beside it.
const std::vector<std::string>& seven_points();

}  // namespace hyperex::simulate::test
