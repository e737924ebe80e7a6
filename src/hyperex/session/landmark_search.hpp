// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <future>
#include <string>
#include <vector>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The landmarks that a user gave against those that the program finds on the scan, which takes
/// seconds: in the background.
class LandmarkSearch {
 public:
  /// `inputs` must outlive this and stay as they are. What was found before on the same scan is
  /// taken from `kept`.
  LandmarkSearch(const Inputs& inputs, const KeptResults& kept);

  /// Waits. `landmarks.doubtful` for each doubtful landmark that no note of that id in `said` names
  /// yet; nothing where no face is found in pictures of the scan.
  std::vector<Note> doubts(const std::vector<Note>& said);

 private:
  std::future<std::vector<Note>> doubts_;
};

}  // namespace hyperex::session
