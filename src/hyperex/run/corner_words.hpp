// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a run's summary says of the corners of the mouth, in words for a terminal. The pages say the
// same by the same rules: web/src/replay/corners.ts. The right side comes first, as on a face that
// one looks at.
#include <nlohmann/json.hpp>
#include <string>

namespace hyperex::run {

/// "corners of the mouth: right 12.7 mm, left 3.8 mm, 8.9 mm apart: more than the floor of 0.1 mm
/// (mesh)", a line; empty where they are not known.
std::string corners_line(const nlohmann::ordered_json& summary);

/// What each variant makes of the corners of the mouth, a line each:
/// "  weak right: corner of the mouth right 9.6 to 6.2 mm, moves 3.4 mm less (+- 0.3); left 10.1
/// mm, unchanged". What is compared goes along the way that the corner goes in base: a corner that
/// goes elsewhere is not "farther" by being as far from rest.
std::string variant_lines(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
