// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/estimate/posterior.hpp"

namespace hyperex::estimate {

/// What a further recording is expected to determine.
struct Proposal {
  std::string expression;
  Eigen::VectorXd sigma;  ///< of each requested unknown, with that recording too
};

/// One for each standard expression, in their order: the curvature at the mode with the expected
/// information of one more recording, whose activations, jaw and head pose are unknown in turn. Its
/// points, noise and head pose are those of the first recording.
std::vector<Proposal> proposals(FaceModel& face, const Posterior& posterior, const Mode& mode,
                                const Assumptions& assumptions);

}  // namespace hyperex::estimate
