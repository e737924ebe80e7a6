// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// Throws InputError for names of points, landmarks and regions that do not exist, for still points
/// that are driven, and for invalid tissue. `owner` precedes the keys: "variant[0].".
void check_names(const scene::Scene& scene, const Inputs& in, const std::string& owner = "");

/// Throws InputError for motion.rigid_points that the recording `m` does not have.
void check_rigid_points(const scene::Scene& scene, const motion::Motion& m);

/// Parts of check_names() that need no landmarks. They throw InputError for points that the
/// recording does not have, and for regions that do not exist.
void check_point_names(const scene::Scene& scene, const motion::Motion& m,
                       const std::string& owner = "");
void check_regions(const scene::Scene& scene, const std::string& owner = "");

/// Throws InputError where the elements are longer than a third of the mouth's width: lips move
/// apart only where several elements lie between its corners.
void check_element_size(const scene::Scene& scene, const Inputs& in);

/// `landmarks.misspelt` and `landmarks.unknown` for labels to which neither the recording nor the
/// scene refers.
void note_unknown_landmarks(const scene::Scene& scene, const io::Landmarks& given, Inputs& in);

/// `support.none` where only the driven points hold the tissue.
void note_missing_support(const scene::Scene& scene, Inputs& in);

}  // namespace hyperex::session
