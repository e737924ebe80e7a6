// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/skin_colours.hpp"

#include "hyperex/report/complexion.hpp"
#include "hyperex/report/skin_view.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::run {

render::VertexColours skin_colours(const simulate::Performance& performance, const io::Scan& scan,
                                   face::SkinTone tone) {
  const render::VertexColours own = tracking::picture_colours(scan);
  if (own.rows() == 0) return report::complexion(performance, tone).leftCols<3>();
  io::Scan coloured;
  coloured.vertex_colour.resize(own.rows(), 4);
  coloured.vertex_colour.leftCols<3>() = own;
  coloured.vertex_colour.col(3).setConstant(255);
  return report::skin_colour(performance, coloured).leftCols<3>();
}

}  // namespace hyperex::run
