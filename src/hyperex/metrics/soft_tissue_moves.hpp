// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::metrics {

/// How far the soft tissue at a landmark follows a segment of bone, as others measured it on
/// patients: millimetres of soft tissue per millimetre of bone, along the movement.
struct PublishedRatio {
  simulate::BonePart part;
  int axis;  ///< of the movement: 0 to the left, 1 up, 2 forward
  int sign;  ///< of the movement along it
  const char* landmark;
  double usual, low, high;  ///< low and high: over studies, not over patients
  const char* source;
};
const std::vector<PublishedRatio>& published_ratios();

/// What surgery does to a landmark of the soft tissue. Vectors (mm) are along the axes of the face:
/// to the subject's left, up, forward.
struct SoftTissueMove {
  std::string landmark;
  Vec3 at_rest;  ///< of the face at rest, by surgery
  /// Displacement at the peak of base from the face at rest, before and after surgery.
  Vec3 expression_before, expression_after;
  /// at_rest along the movement of a bone over that movement, and the ratio published for it. NaN
  /// and null where none is published for the bones that are moved.
  double ratio = std::numeric_limits<double>::quiet_NaN();
  const PublishedRatio* published = nullptr;
};

/// The landmarks that planners of surgery use, as far as the face has them: from pronasale to
/// pogonion, the corners of the mouth and the wings of the nose. `landmarks`: at rest, for the axes
/// of the face. Ratios are given for an axis along which one segment alone is moved.
std::vector<SoftTissueMove> soft_tissue_moves(const simulate::Performance& before,
                                              const simulate::Performance& after,
                                              const io::Landmarks& landmarks,
                                              const std::vector<simulate::BoneMove>& moves);

/// Change of the distance between the wings of the nose (alare_L and alare_R) at rest, mm; NaN
/// where they are unknown.
double change_of_nose_width_mm(const simulate::Performance& before,
                               const simulate::Performance& after);

/// The volume that the skin at rest gains, ml: what lies between both skins, positive outwards.
double change_of_volume_ml(const simulate::Performance& before, const simulate::Performance& after);

/// The greatest distance (mm) by which a vertex of the skin at rest differs.
double greatest_change_at_rest_mm(const simulate::Performance& before,
                                  const simulate::Performance& after);

/// One row per landmark.
void write_soft_tissue_csv(const std::filesystem::path& file,
                           const std::vector<SoftTissueMove>& moves);
nlohmann::ordered_json json_of(const std::vector<SoftTissueMove>& moves);

}  // namespace hyperex::metrics
