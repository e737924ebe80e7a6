// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace hyperex::face {

/// Three places along the fold from nose to mouth (nasolabial fold) of one side.
enum class FoldPoint {
  upper,   ///< its upper end, beside the wing of the nose
  middle,  ///< about half-way
  lower    ///< its lower end, beside the corner of the mouth
};

/// The name of the landmark there: "nasolabial_fold_upper_L".
std::string fold_landmark(FoldPoint point, bool left);

/// Landmarks that are used where they are given, and are neither needed nor placed: those of the
/// fold on both sides, sorted. canonical_face() does not have them.
const std::vector<std::string>& optional_landmarks();

bool is_optional_landmark(const std::string& name);

/// Whether a name is that of a landmark of canonical_face(), or an optional one.
bool is_known_landmark(const std::string& name);

}  // namespace hyperex::face
