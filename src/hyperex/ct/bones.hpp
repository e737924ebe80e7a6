// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/ct/body.hpp"

namespace hyperex::ct {

struct Seeds {
  Vec3 skull_m = Vec3::Zero(), mandible_m = Vec3::Zero();  ///< the frame of a face
};

/// Which values are skull and which mandible.
struct Bones {
  Mask label;             ///< 0: neither; kSkull; kMandible
  bool separated = true;  ///< false: the mandible was not found and hangs on the skull
  double level_hu = 0;    ///< at which the two fall apart
};
constexpr std::uint8_t kSkull = 1, kMandible = 2;

/// Bone is what is at least `thresholds.bone_hu`. The value is raised in steps of 25 HU, by up to
/// 1200 HU, until a piece falls off that is a mandible: at least 8 cm^3 and 55 mm wide, in the
/// middle (15 mm), its centre at least 30 mm below that of the largest piece and its front at most
/// 40 mm behind. The largest piece (with other pieces of 0.1 cm^3 whose middle is above the
/// mandible) and the mandible are then the markers of a watershed, which assigns every value of
/// bone to one of them. With `seeds`, the value is raised until the mandible's point lies in a
/// piece of at least 8 cm^3 that is not the largest and does not hold the skull's point; the
/// largest piece is skull. Where that never comes, balls around the points are the markers. Bone
/// that hangs on neither is left out. Throws InputError, naming `source`, where there is no bone, a
/// seed is more than 6 mm from bone, the seeds or the bone at them lie within 6 mm of each other,
/// or the seeds' mandible is larger than the skull.
Bones find_bones(const Body& body, const Thresholds& thresholds, const std::optional<Seeds>& seeds,
                 const std::string& source);

/// The volume with all bone but one part's as soft tissue: its surface at the bone's value is that
/// of the part. `part`: a label, or 0 for both.
Volume bone_alone(const Body& body, const Bones& bones, int part, const Thresholds& thresholds);

}  // namespace hyperex::ct
