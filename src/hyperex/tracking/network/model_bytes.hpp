// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>

namespace hyperex::tracking {

/// The networks of MediaPipe Face Mesh (npm package @mediapipe/face_mesh, Apache-2.0) as .tflite
/// files. They are extracted from the package at build time and embedded in this library.
std::span<const std::uint8_t> face_detection_bytes();  ///< face_detection_short_range.tflite
std::span<const std::uint8_t> face_landmark_bytes();   ///< face_landmark_with_attention.tflite

}  // namespace hyperex::tracking
