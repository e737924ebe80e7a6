// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "hyperex/run/outputs.hpp"
#include "hyperex/session/face_session.hpp"

namespace hyperex::run {

/// The contents of summary.json for base: counts, figures at the peak, symmetry, muscles, tissue.
/// `results`: results_of(session).
nlohmann::ordered_json summary_of(const session::FaceSession& session, const Results& results);

/// "options" of summary.json: every option in use, with files by name. Where the scene names no
/// points that drive, `drive.points` has those that did.
nlohmann::ordered_json options_in_use(const scene::Scene& scene, const session::Inputs& inputs);

}  // namespace hyperex::run
