// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/estimate/question.hpp"
#include "hyperex/session/face_session.hpp"

namespace hyperex::estimate {

/// The parts of the tissue of Request::stiffness on the session's mesh. Throws InputError where a
/// part is unknown, is the whole tissue, or both parts are the same.
StiffnessRatio ratio_of(session::FaceSession& session, const std::string& asked);

}  // namespace hyperex::estimate
