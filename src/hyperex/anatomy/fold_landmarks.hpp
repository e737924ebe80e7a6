// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// What is wrong with the landmarks of the fold from nose to mouth (face::fold_landmark), one
/// sentence each; empty where none is given. `landmarks`: m, with all 68 iBUG points.
///  * A landmark lies on the other side of the face.
///  * It is more than 30 mm from where it belongs: the upper end from the wing of the nose, the
///    lower end from the corner of the mouth, the middle from the place half-way between the two.
///  * The upper end lies below the lower one.
std::vector<std::string> fold_landmark_problems(const io::Landmarks& landmarks);

}  // namespace hyperex::anatomy
