// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex::capture {

/// A pinhole camera without distortion; pixel centres at integers. The camera's frame has x to the
/// right, y down, z forward:  u = fx x / z + cx,  v = fy y / z + cy.
struct Intrinsics {
  double fx_px = 0, fy_px = 0;  ///< > 0
  double cx_px = 0, cy_px = 0;
  int width_px = 0, height_px = 0;  ///< > 0
};

}  // namespace hyperex::capture
