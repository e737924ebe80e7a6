// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// A face at weight 1 of one blend shape; or a corrective (expression/correctives.hpp): what the
/// face that shows two of them adds to their sum.
struct RigShape {
  std::string name;
  PointsF displacement_m = {};  ///< of skin_rest's vertices
  /// Rigid. A corrective's maps x to x and what it adds to x, which is affine.
  Eigen::Affine3d jaw_now_from_rest = Eigen::Affine3d::Identity();
  std::optional<expression::Gaze> right_eye = {}, left_eye = {};
  /// Of a corrective: the places of its two shapes in the list, both before its own.
  std::optional<std::array<std::size_t, 2>> corrects = {};
};

/// Writes a face at rest as binary glTF 2.0, metres, with the shapes as morph targets of their
/// names: of the skin (all of them), of the pockets behind its openings, of the lower teeth (those
/// in which the jaw moves) and of the eyeballs (those in which they turn). The nodes lower_teeth,
/// eye_R and eye_L may be turned instead of morphed: their origins are the middle of the jaw's axis
/// (`jaw_axis_m`) and the middles of the eyes. Displacements below 0.05 mm are left out. Normals of
/// a corrective are such that with its two shapes they are those of the face that shows both. All
/// weights are 0. `performance`: its skin at rest and landmarks are used. `tone`: of complexion(),
/// where the scan has neither a texture nor colours. Returns the size in
/// bytes. Throws InputError where the file cannot be written, std::invalid_argument for shapes of
/// another skin or correctives before their shapes.
double write_rig_glb(const std::filesystem::path& file, const simulate::Performance& performance,
                     const io::Scan& scan, const anatomy::Teeth* teeth, const Vec3& jaw_axis_m,
                     const std::vector<RigShape>& shapes,
                     face::SkinTone tone = face::SkinTone::light);

}  // namespace hyperex::report
