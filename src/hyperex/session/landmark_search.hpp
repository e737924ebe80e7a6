// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <future>
#include <string>
#include <vector>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// Compares a user's landmarks with those that the program finds on the scan. Works in the
/// background, since it takes seconds.
class LandmarkSearch {
 public:
  /// `inputs` must outlive this and not change. Landmarks found before on the same scan are taken
  /// from `kept`.
  LandmarkSearch(const Inputs& inputs, const KeptResults& kept);

  /// Waits for the result: `landmarks.doubtful` for each doubtful landmark that no such note in
  /// `said` names yet. None where no face is found in pictures of the scan.
  std::vector<Note> doubts(const std::vector<Note>& said);

 private:
  std::future<std::vector<Note>> doubts_;
};

}  // namespace hyperex::session
