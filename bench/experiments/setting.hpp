// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::bench {

/// The folders, and the faces on which the experiments run.
struct Setting {
  std::filesystem::path source;    ///< of this program; contains examples/ and bench/scenes/
  std::filesystem::path data;      ///< of subject A; empty: subject A is left out
  std::filesystem::path pictures;  ///< folder that pictures are written to

  std::filesystem::path scene(int experiment, bool subject_a) const {
    return source / (subject_a ? "bench/scenes" : "examples") /
           ("experiment_" + std::to_string(experiment) +
            (subject_a ? "_subject_a.toml" : "_embedded.toml"));
  }
  /// false: the embedded face; true: subject A.
  std::vector<bool> faces() const {
    return data.empty() ? std::vector<bool>{false} : std::vector<bool>{false, true};
  }
};

}  // namespace hyperex::bench
