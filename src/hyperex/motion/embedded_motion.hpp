// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct MouthOpeningOptions {
  double peak_deg = 13;     ///< of the jaw about the condyles; a wide, comfortable opening
  double duration_s = 2.7;  ///< opens once and closes again; samples / rate
  double rate_hz = 30;
  bool head_moves = true;  ///< a small nod, turn and shift, as no one holds quite still
};

/// A mouth that opens and closes once, made for any face: the jaw turns about the axis through both
/// condyles by peak (1 - cos(2 pi t / T)) / 2, T the time of the last sample, so that it starts and
/// ends at rest. Chin and lower lip follow it rigidly, the corners of the mouth and the outline of
/// the jaw in part, the upper lip and the rest of the face not at all. The condyles are estimated
/// at the outline of the face beside the ears, a tenth of the face's width inwards. `landmarks`
/// (metres): those among the 68 iBUG points and the anatomical names are moved, the frame of the
/// first sample is theirs. Throws InputError where ibug68_1, 15, 8 or 27 is missing, or the options
/// are not positive.
Motion embedded_mouth_opening(const io::Landmarks& landmarks,
                              const MouthOpeningOptions& options = {});

}  // namespace hyperex::motion
