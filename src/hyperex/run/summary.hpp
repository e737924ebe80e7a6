// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "hyperex/run/outputs.hpp"
#include "hyperex/session/face_session.hpp"

namespace hyperex::run {

/// The contents of summary.json for base: counts, figures at the peak, symmetry, muscles, tissue.
/// `results`: results_of(session).
nlohmann::ordered_json summary_of(const session::FaceSession& session, const Results& results);

}  // namespace hyperex::run
