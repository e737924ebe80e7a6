// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct MouthOpeningOptions {
  double peak_deg = 13;     ///< peak rotation of the jaw about the condyles; wide but comfortable
  double duration_s = 2.7;  ///< of one opening and closing: number of samples / rate
  double rate_hz = 30;
  bool head_moves = true;  ///< adds a small nod, turn and shift, since no head keeps quite still
};

/// A mouth that opens and closes once, for any face. The jaw rotates about the axis through both
/// condyles by the angle peak (1 - cos(2 pi t / T)) / 2, where T is the time of the last sample.
/// The motion therefore starts and ends at rest. The chin and the lower lip follow the jaw rigidly,
/// the corners of the mouth and the outline of the jaw in part, the upper lip and the rest of the
/// face not at all. Each condyle is assumed a tenth of the face's width inwards from the outline of
/// the face beside the ears. Every landmark (metres) becomes a point of the motion; only the 68
/// iBUG points and the points with anatomical names can follow the jaw. The first sample is in the
/// frame of `landmarks`. Throws InputError where ibug68_1, 15, 8 or 27 is missing, where the angle
/// or the rate is not positive, or where there would be fewer than three samples.
Motion embedded_mouth_opening(const io::Landmarks& landmarks,
                              const MouthOpeningOptions& options = {});

}  // namespace hyperex::motion
