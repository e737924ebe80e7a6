// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hyperex {

/// A cache: a folder of results that take long to compute, each under a hash of its inputs. It
/// never causes an error: where the folder cannot be made, read or written there is no cache, and a
/// torn or changed entry counts as absent. Several processes may share it. The oldest entries are
/// removed when all together exceed a bound.
///
/// What is kept shows faces: folders are made for their owner alone (0700), entries too (0600). A
/// folder or an entry that belongs to another user, or that others may write to, is ignored.
class KeptResults {
 public:
  /// No folder: nothing is kept or found.
  KeptResults() = default;
  explicit KeptResults(std::filesystem::path folder, std::uintmax_t most_bytes = 256u << 20)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  bool in_use() const { return !folder_.empty(); }
  /// `key`: letters, digits, '-' and '_'.
  std::optional<std::string> find(const std::string& key) const;
  void keep(const std::string& key, const std::string& bytes) const;

 private:
  void remove_oldest() const;

  std::filesystem::path folder_;
  std::uintmax_t most_bytes_ = 0;
};

/// $XDG_CACHE_HOME/hyperex, else ~/.cache/hyperex; empty where neither is an absolute path.
std::filesystem::path user_cache_folder();

/// Identifies the build of the running program: its file's size and time.
std::string program_identity();

}  // namespace hyperex
