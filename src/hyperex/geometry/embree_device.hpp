// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <embree3/rtcore.h>

#include <stdexcept>

namespace hyperex {

/// Embree's device of this process, for all scenes and threads: making one takes as long as a tree
/// of some thousand triangles. Throws std::runtime_error where Embree does not start.
inline RTCDevice embree_device() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (!device) throw std::runtime_error("Embree does not start");
  return device;
}

}  // namespace hyperex
