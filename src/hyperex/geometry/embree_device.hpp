// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

namespace hyperex {

/// Embree's device of this process, for all scenes and threads: making one takes as long as a tree
/// of some thousand triangles. Throws std::runtime_error where Embree does not start.
inline RTCDevice embree_device() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (!device) throw std::runtime_error("Embree does not start");
  return device;
}

/// Builds a scene's tree. Embree shares this work through TBB, and in a group of tasks that an
/// exception has cancelled would leave the tree half built, for queries to crash in: it is given a
/// group of its own.
inline void commit_whole(RTCScene scene) {
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  tbb::parallel_for(
      0, 1, [scene](int) { rtcCommitScene(scene); }, alone);
}

}  // namespace hyperex
