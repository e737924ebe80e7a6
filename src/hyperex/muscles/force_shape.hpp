// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex::muscles {

/// How a muscle's force spreads in the tissue around its line.
struct ForceShape {
  double band = 2.1;         ///< weight exp(-(r / R)^2) at distance r, R = band x width
  double ramp = 6;           ///< a pull varies as s^ramp, s the share of the length from the origin
  double tangential = 0.54;  ///< share of the force's component normal to the skin removed: 0 to 1
  double midline_m = 0.005;  ///< the force vanishes this far beyond the midline; 0: no limit
  bool operator==(const ForceShape&) const = default;
};

/// How muscles that end in the skin along the fold from nose to mouth pull there.
struct FoldShape {
  double width_mm = 2.5;    ///< weight exp(-(d / width)^2) at distance d; on the template's face
  double inwards_deg = 30;  ///< angle of the pull below the skin's tangent plane, into the tissue
  /// Whether a groove that the skin has at rest shifts the line of its side (groove_at_rest()).
  bool from_rest = true;
  bool operator==(const FoldShape&) const = default;
};

}  // namespace hyperex::muscles
