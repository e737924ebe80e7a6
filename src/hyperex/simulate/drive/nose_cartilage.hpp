// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::simulate {

/// Where the cartilage of the nose lies, in the frame of the face (m): between the wings
/// (ibug68_31 and 35) and below the nasal bones, which end at the middle of the bridge (ibug68_28
/// and 29).
struct NoseCartilage {
  double top, half_width, back;  ///< height of its upper end; half its width; forward of its back

  NoseCartilage(const io::Landmarks& landmarks, const face::FaceFrame& frame) {
    const auto at = [&](int k) { return frame.local(landmarks.at(face::ibug(k))); };
    top = (at(28) + at(29)).y() / 2;
    half_width = std::abs(at(31).x() - at(35).x()) / 2;
    back = (at(31) + at(35)).z() / 2;
  }
};

}  // namespace hyperex::simulate
