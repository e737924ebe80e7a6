// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/reenact/alignment.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// Everything a scene names, read, checked and brought into the scan's frame.
struct Inputs {
  io::Scan scan;
  io::Landmarks landmarks;          ///< completed: the 68 iBUG points and the anatomical ones
  std::vector<std::string> placed;  ///< landmarks that were not given
  reenact::AlignedMotion motion;    ///< gaps filled, head pose out, in the scan's frame
  double rigid_rms_mm = 0;          ///< mean residual of the rigid points
  std::vector<std::string> driven;  ///< names of the driven points
  std::vector<std::string> notes;   ///< what was guessed, placed, filled: a sentence each
};

/// The landmarks that every run needs: all that the canonical face knows.
std::vector<std::string> needed_landmarks();

/// Throws InputError, as far as possible with all problems at once.
Inputs read_inputs(const Scene& scene);

}  // namespace hyperex::scene
