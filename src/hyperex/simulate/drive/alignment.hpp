// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/rbf.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::simulate {

enum class AlignmentMethod {
  nonrigid,    ///< similarity by landmarks, then a radial basis so that common landmarks coincide
  similarity,  ///< similarity by landmarks alone
  normalised   ///< the source's [5.1-5.4]: similarity of axes, face-part dimensions about the nose
               ///< apex
};

/// A stabilised motion (metres, its own axes) carried into a scan's frame.
struct AlignedMotion {
  motion::Motion motion;            ///< in the scan's frame: rest positions + displacements
  Similarity scan_from_motion;      ///< the similarity part
  Points rest;                      ///< positions of the points at the first sample, scan frame
  double rms_mm = 0;                ///< of the common landmarks after the similarity
  std::vector<std::string> common;  ///< landmarks that both sides name
};

/// Displacements since the first sample are turned and scaled with the face (normalised: by w, h_u
/// and h_d); rest positions are laid where the method puts them.
/// Throws InputError where fewer than three names are common or those lie nearly on a line.
AlignedMotion align(const motion::Motion& stabilised, const io::Landmarks& landmarks,
                    AlignmentMethod method = AlignmentMethod::nonrigid);

}  // namespace hyperex::simulate
