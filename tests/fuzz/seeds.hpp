// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small sound inputs of every format, made by code.
#include <string>
#include <vector>

namespace hyperex::fuzz {
using Seeds = std::vector<std::string>;

Seeds ply_seeds();  ///< ascii, binary of both endians; colours, texture, polygons, own properties
Seeds obj_seeds();
Seeds stl_seeds();
Seeds gltf_seeds();
Seeds glb_seeds();
Seeds rig_seeds();
Seeds landmark_seeds();
Seeds markup_seeds();
Seeds csv_seeds();
Seeds trc_seeds();
Seeds scene_seeds();
Seeds camera_seeds();
Seeds list_seeds();
Seeds candide_seeds();
Seeds picture_seeds();  ///< PNG of 8 and 16 bits, JPEG; 4 x 4 pixels
}  // namespace hyperex::fuzz
