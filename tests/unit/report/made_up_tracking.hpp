// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/expression/face_model.hpp"
#include "hyperex/tracking/tracked.hpp"

namespace hyperex::report::testing {

/// The canonical face at 30 frames a second, talking and nodding by sines of time: yaw 20 sin(1.1
/// t), pitch 8 sin(1.7 t), roll -5 sin(0.9 t) degrees, jaw, smile and lids in motion. Frames 40 to
/// 49 show no face, frame 60 has no picture. Without depth no residual of it, and not metric.
tracking::Tracking made_up_tracking(int frames, bool with_depth = true);

}  // namespace hyperex::report::testing
