// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// Where frames come from: a recording, a video, a camera. One consumer, one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// Intrinsics of the colour picture, the same for all frames.
  virtual const Intrinsics& intrinsics() const = 0;
  /// False: colour only; metres are then unknown until a length in the picture is stated.
  virtual bool has_depth() const = 0;
  /// True: frames come at the pace of a clock and are lost where nobody fetches them.
  virtual bool live() const = 0;
  /// Frames in all, the invalid ones among them; nothing where that is not known beforehand.
  virtual std::optional<std::size_t> frame_count() const = 0;
  /// The next frame, nothing at the end. A faulty one comes as invalid with its `fault`, and with
  /// what could be read of it. Throws InputError at the end where fewer than one frame in ten was
  /// valid, and where a camera gives no frame at all; one that is lost later ends the source with a
  /// note. The pictures belong to the caller: the source does not change them again.
  virtual std::optional<Frame> next() = 0;
  /// Frames that were lost because nobody fetched them in time (live sources).
  virtual std::size_t dropped() const { return 0; }
  /// What the user should know of how this source is read, one sentence each: guessed intrinsics,
  /// pairs by nearest time, depth whose registration is unknown.
  virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace hyperex::capture
