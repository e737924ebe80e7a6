// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/render/time_plot.hpp"

namespace hyperex::bench {

struct Curve {
  std::string name;  ///< in the legend; empty: not there
  std::vector<double> time_s, value;
  render::Colour colour;
};

/// Curves over time on their own axes.
struct CurvePanel {
  std::string title = {}, unit = {};  ///< two lines above the panel
  std::vector<Curve> curves = {};
  render::Range range = {};       ///< of the values; what lies outside is not drawn
  bool legend_on_top = false;     ///< true: top left; false: below, right
  render::Range marked = {0, 0};  ///< a time interval that is shaded; none where empty
};

/// Panels in rows of `columns`, each with its axis of time.
render::Image draw_curves(const std::vector<CurvePanel>& panels, int columns);

/// Least and greatest value of all curves, a little wider.
render::Range range_of(const std::vector<Curve>& curves);

}  // namespace hyperex::bench
