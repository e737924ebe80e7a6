// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// Which lip a vertex belongs to, by paths along the surface, since across a closed mouth the other
/// lip may be nearer in a straight line. Per vertex: length of the path to the lower lip minus that
/// to the upper one (m); above 0 on the upper side. A missing path counts as 1 m (0 where both are
/// missing). If the mouth is open, values are shifted to be 0 at its corners (linearly in between).
/// On the rims they are at least 5 mm in magnitude, with the sign of the lip.
std::vector<double> upper_lip_margin(const TriMesh& mesh, const io::Landmarks& landmarks);

/// By iBUG-68 number: -1 for points of the lower lip, 1 for points of the upper lip, 0 for all
/// others.
int lip_of(const std::string& landmark);

/// The border loop between the lips, in the direction of its triangles; empty where the mouth is
/// closed.
std::vector<int> mouth_border(const TriMesh& mesh, const io::Landmarks& landmarks);

/// Whether a border loop runs between the lips.
bool mouth_is_open(const TriMesh& mesh, const io::Landmarks& landmarks);

/// A line from the right corner of the mouth to the left along which closed lips may be cut, laid
/// on the surface as seen from in front; smooth.
Points lip_line_of_landmarks(const io::Landmarks& landmarks);  ///< ibug68_60 to 67, means of pairs
/// The deepest crease near that line (find_lip_line), smoothed by no more than 0.3 mm; nothing
/// where no clear crease runs there.
std::optional<Points> lip_line_of_crease(const TriMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::anatomy
