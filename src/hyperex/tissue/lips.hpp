// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::tissue {

/// Which lip a vertex belongs to, told by walking on the surface, since across a closed mouth the
/// other lip is nearer through the air. Per vertex: walk to the lower lip minus walk to the upper
/// one (m); above 0 on the upper side. Infinite walks count as far.
std::vector<double> upper_lip_margin(const TriMesh& mesh, const io::Landmarks& landmarks);

/// -1, 0 or 1 for points of the lower lip, of neither and of the upper lip by their iBUG-68 number.
int lip_of(const std::string& landmark);

/// A border loop runs between the lips: the mouth is a slit already.
bool mouth_is_open(const TriMesh& mesh, const io::Landmarks& landmarks);

/// The walk of vertices between the mouth corners (right to left) along the crease of closed lips:
/// cheap along concave edges and near the lip line of the landmarks (ibug68_60 to 67).
/// Throws InputError-free std::runtime_error where there is no walk.
std::vector<int> lip_crease(const TriMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::tissue
