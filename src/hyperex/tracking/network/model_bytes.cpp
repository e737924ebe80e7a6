// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/model_bytes.hpp"

// A megabyte as a C++ array compiles for seconds; the assembler copies the files as they are.
#define HYPEREX_CARRY(name, file)               \
  __asm__(                                      \
      ".pushsection .rodata\n"                  \
      ".balign 16\n"                            \
      ".global " #name                          \
      "_begin\n"                                \
      ".global " #name "_end\n" #name           \
      "_begin:\n"                               \
      ".incbin \"" file "\"\n" #name            \
      "_end:\n"                                 \
      ".popsection\n");                         \
  extern "C" const std::uint8_t name##_begin[]; \
  extern "C" const std::uint8_t name##_end[];

HYPEREX_CARRY(hyperex_face_detection, HYPEREX_FACE_DETECTION_TFLITE)
HYPEREX_CARRY(hyperex_face_landmark, HYPEREX_FACE_LANDMARK_TFLITE)

namespace hyperex::tracking {

std::span<const std::uint8_t> face_detection_bytes() {
  return {hyperex_face_detection_begin, hyperex_face_detection_end};
}

std::span<const std::uint8_t> face_landmark_bytes() {
  return {hyperex_face_landmark_begin, hyperex_face_landmark_end};
}

}  // namespace hyperex::tracking
