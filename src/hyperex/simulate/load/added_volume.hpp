// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/tissue/mesh/volume_mesh.hpp"

namespace hyperex::simulate {

/// The growth tensors (Assembler::grown) of a layer whose tetrahedra grow to `volume_ratio` times
/// their volume, in thickness alone: I + (ratio - 1) n n^T, n the way from bone to skin. Filler is
/// laid between sheets of tissue and parts them, and so does an implant on bone. Growth in all
/// directions would push the layer aside too, and lift it off the bone as a dome.
std::vector<Eigen::Matrix3d> growth_through_layer(const tissue::VolumeMesh& mesh,
                                                  const std::vector<double>& volume_ratio);

}  // namespace hyperex::simulate
