// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::simulate {

enum class AlignmentMethod {
  nonrigid,    ///< similarity by landmarks, then a radial basis so that common landmarks coincide
  similarity,  ///< similarity by landmarks alone
  normalised   ///< [5.1-5.4]: the axes by a similarity, then the parts of the face are scaled about
               ///< the nose apex
};
constexpr auto words_of(AlignmentMethod) {
  return std::array{Word{"nonrigid", AlignmentMethod::nonrigid},
                    Word{"similarity", AlignmentMethod::similarity},
                    Word{"normalised", AlignmentMethod::normalised}};
}

/// A stabilised motion (m, its own axes) in the frame of a scan.
struct AlignedMotion {
  motion::Motion motion;            ///< in the scan's frame: rest positions + displacements
  Similarity scan_from_motion;      ///< the similarity part
  Points rest;                      ///< positions of the points at the first sample, scan frame
  double rms_mm = 0;                ///< of the common landmarks after the similarity
  std::vector<std::string> common;  ///< landmarks that both the motion and the scan name
};

/// Turns and scales the displacements since the first sample with the face (normalised: by w, h_u
/// and h_d). The method also gives the positions at rest.
/// Throws InputError where fewer than three landmarks are common or they lie nearly on a line.
AlignedMotion align(const motion::Motion& stabilised, const io::Landmarks& landmarks,
                    AlignmentMethod method = AlignmentMethod::nonrigid);

}  // namespace hyperex::simulate
