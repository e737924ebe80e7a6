// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/model_bytes.hpp"

#include "hyperex/core/carried_file.hpp"

namespace hyperex::tracking {

HX_CARRIED_FILE(face_detection_tflite, HYPEREX_FACE_DETECTION_TFLITE)
HX_CARRIED_FILE(face_landmark_tflite, HYPEREX_FACE_LANDMARK_TFLITE)

namespace {
std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}
}  // namespace

std::span<const std::uint8_t> face_detection_bytes() {
  return as_bytes(face_detection_tflite());
}

std::span<const std::uint8_t> face_landmark_bytes() {
  return as_bytes(face_landmark_tflite());
}

}  // namespace hyperex::tracking
