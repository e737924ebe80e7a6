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

  /// Waits. A sentence for each doubtful landmark that `said` does not name yet; nothing where no
  /// face is found in pictures of the scan.
  std::vector<std::string> doubts(const std::vector<std::string>& said);

 private:
  std::future<std::vector<std::string>> doubts_;
};

}  // namespace hyperex::session
