// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/reenact/performance.hpp"

namespace hyperex::report::testing {

enum class Surface { plain, coloured, textured };

/// A face-sized bump whose lower part swings down and back like a jaw, cut along a short line; all
/// that a report shows is there. Textured: a small PNG, with a seam down the middle.
struct MadeUpFace {
  reenact::Performance performance;
  io::Scan scan;
  metrics::SymmetryCurve symmetry;
};
MadeUpFace made_up_face(Surface surface, int side = 41, int frames = 31);

}  // namespace hyperex::report::testing
