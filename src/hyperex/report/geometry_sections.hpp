// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of the report's page that hold geometry: numbers go into `block`, and the JSON says
// where they are.
#pragma once
#include "hyperex/report/html_report.hpp"
#include "hyperex/report/page_data.hpp"

namespace hyperex::report {

/// The skin at rest: points, triangles, and the scan's texture or colours.
nlohmann::json skin_section(const ReportInput& input, BinaryBlock& block);

/// {"modes": values of each mode and their step, "weights": frames x modes}. Small modes, of which
/// a noisy recording has many, take one byte per component: their step stays under 2 micrometres.
nlohmann::json modes_section(const DisplacementModes& motion, BinaryBlock& block);

/// Of all times and points: N x P x 3, m.
nlohmann::json positions_of(const motion::Motion& landmarks, BinaryBlock& block);

/// "vertices" (-1: none) and "weights" (bytes) of each vertex's counterpart on the other side.
nlohmann::json mirror_section(const metrics::RestAsymmetry& at_rest, BinaryBlock& block);

/// A list of {"jaw": "upper" or "lower", "part": "crowns" or "gum"} with their meshes and the
/// light on each vertex, a byte.
nlohmann::json teeth_section(const anatomy::Teeth& teeth, const Vec3& forward, BinaryBlock& block);

/// Frames x 7: a quaternion x y z w and a translation, now_from_rest.
nlohmann::json jaw_section(const simulate::Performance& performance, BinaryBlock& block);

/// Adds "openings" and "eyeballs" of the skin at rest. Returns the direction the face looks in.
Vec3 add_backing(const simulate::Performance& performance, BinaryBlock& block,
                 nlohmann::json& manifest);

}  // namespace hyperex::report
