// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// Counts faulty frames. A few are normal; if nearly all are faulty, the source itself is wrong.
class FaultCount {
 public:
  explicit FaultCount(std::string source) : source_(std::move(source)) {}
  void add(const Frame& frame);
  /// Throws InputError, with the counts and the first fault, if there was no frame at all or if
  /// fewer than one frame in ten is valid.
  void check_at_end() const;
  std::size_t frames() const { return frames_; }
  std::size_t faulty() const { return faulty_; }

 private:
  std::string source_, first_fault_;
  std::size_t frames_ = 0, faulty_ = 0;
};

}  // namespace hyperex::capture
