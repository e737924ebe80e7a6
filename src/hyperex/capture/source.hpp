// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// A source of frames: a recording, a video or a camera. For one consumer on one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// Intrinsics of the colour picture, the same for all frames.
  virtual const Intrinsics& intrinsics() const = 0;
  /// False: colour only. Lengths in metres are then unknown unless a length in the picture is
  /// stated.
  virtual bool has_depth() const = 0;
  /// True: frames arrive in real time and are lost if nothing reads them in time.
  virtual bool live() const = 0;
  /// Total number of frames, including invalid ones; nothing if it is not known in advance.
  virtual std::optional<std::size_t> frame_count() const = 0;
  /// The next frame, or nothing at the end. A faulty frame is returned as invalid, with its `fault`
  /// and with what could be read of it. Throws InputError at the end if fewer than one frame in ten
  /// was valid, and if a camera gives no frame at all. If a camera is lost later, the source ends
  /// with a note. The pictures belong to the caller; the source does not change them again.
  virtual std::optional<Frame> next() = 0;
  /// Number of frames that were lost because they were not read in time (live sources).
  virtual std::size_t dropped() const { return 0; }
  /// What the user should know of how this source is read, one sentence each: guessed intrinsics,
  /// pairs by nearest time, depth whose registration is unknown.
  virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace hyperex::capture
