// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/report/html_report.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report::testing {

enum class Surface { plain, coloured, textured };

/// A face-sized bump whose lower part swings down and back like a jaw, cut along a short line; all
/// that a report shows is there. Textured: a small PNG, with a seam down the middle.
struct MadeUpFace {
  simulate::Performance performance;
  io::Scan scan;
  metrics::SymmetryCurve symmetry;
};
MadeUpFace made_up_face(Surface surface, int side = 41, int frames = 31);

/// Without them there are no eyeballs.
void add_inner_eye_corners(simulate::Performance& performance);

/// Average teeth behind the cut, the lower ones to be moved by performance.jaw_now_from_rest.
anatomy::Teeth made_up_teeth();

/// The face with other tissue: 0 moves less on its right side, 1 less on its left, 2 half as much
/// and wider, 3 somewhat more, 4 as the face itself. Young's modulus differs in 0 and 1.
struct MadeUpVariant {
  std::string name;
  MadeUpFace face;
  std::vector<SkinMap> tissue;
};
inline constexpr int made_up_variants = 5;
MadeUpVariant made_up_variant(const MadeUpFace& face, int which);
/// Uniform: the tissue of the face itself.
SkinMap made_up_uncertainty(const MadeUpFace& face);
std::vector<SkinMap> made_up_tissue(const MadeUpFace& face);

/// Each vertex of the grid with that at -x; those that the cut added have none.
hyperex::metrics::RestAsymmetry made_up_mirror(const MadeUpFace& face);

/// The variant for a page; it must outlive the page's input.
ReportVariant reported(const MadeUpFace& face, const MadeUpVariant& variant);

}  // namespace hyperex::report::testing
