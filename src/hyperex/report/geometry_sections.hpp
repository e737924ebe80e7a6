// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The sections of the report's page with geometry. Numbers are appended to `block`; the JSON states
// their positions.
#include "hyperex/report/html_report.hpp"
#include "hyperex/report/page_data.hpp"

namespace hyperex::report {

/// The skin at rest: points, triangles, the scan's texture or colours (else a complexion), the
/// ambient light and the opacity near the border (border_fade.hpp).
nlohmann::json skin_section(const ReportInput& input, BinaryBlock& block);

/// {"modes": values of each mode and their step, "weights": frames x modes}. Small modes, which are
/// numerous in a noisy recording, take one byte per component with a step below 2 micrometres.
nlohmann::json modes_section(const DisplacementModes& motion, BinaryBlock& block);

/// Positions at all times and points: N x P x 3, m.
nlohmann::json positions_of(const motion::Motion& landmarks, BinaryBlock& block);

/// "vertices" (-1: none) and "weights" (bytes) of each vertex's counterpart on the other side.
nlohmann::json mirror_section(const metrics::RestAsymmetry& at_rest, BinaryBlock& block);

/// A list of {"jaw": "upper" or "lower", "part": "crowns", "gum" or "tongue"} with their meshes,
/// colours (sRGB) and one byte per vertex for the light on it.
nlohmann::json teeth_section(const anatomy::Teeth& teeth, const Vec3& forward, BinaryBlock& block);

/// Frames x 7: a quaternion x y z w and a translation, now_from_rest.
nlohmann::json jaw_section(const simulate::Performance& performance, BinaryBlock& block);

/// Frames x 8: the quaternions x y z w of the right and of the left eye, from looking ahead. Null
/// without a gaze or eyeballs.
nlohmann::json gaze_section(const simulate::Performance& performance, BinaryBlock& block);

/// The pose that surgery gave the upper teeth, now_from_rest: a quaternion x y z w and a
/// translation (m), 7 numbers. Null where it did not move them.
nlohmann::json upper_teeth_section(const simulate::Performance& performance);

/// Adds "openings" and "eyeballs" of the skin at rest. Returns the direction the face looks in.
Vec3 add_backing(const ReportInput& input, BinaryBlock& block, nlohmann::json& manifest);

}  // namespace hyperex::report
