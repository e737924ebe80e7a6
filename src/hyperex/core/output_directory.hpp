// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A folder of outputs appears whole or not at all, and replaces nothing but an earlier output.
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/temporary.hpp"

namespace hyperex {

/// A folder of outputs filled under a temporary name; commit() gives it its own. A folder of that
/// name may exist if it holds only files that an earlier run is known to have written; those, and
/// no others, are then removed. A link to a folder is followed.
/// Without commit() the destructor removes everything, and so does an interruption.
class OutputDirectory {
 public:
  /// The files that an earlier run wrote into a folder, relative to it and with '/' between; none
  /// where no earlier run is known to have written there.
  using Earlier = std::function<std::set<std::string>(const std::filesystem::path& folder)>;

  /// Throws InputError, before any work is done, where `target` cannot become the folder: it is
  /// a file, a link to nothing, is new and named as a file is (out.glb), cannot be written, or
  /// holds what no earlier run wrote; and where one of `inputs` lies in it and would be replaced
  /// (empty ones are passed over). Removes what killed processes left beside it.
  OutputDirectory(const std::filesystem::path& target, Earlier earlier,
                  const std::vector<std::filesystem::path>& inputs = {});
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  /// Where to write until commit().
  const std::filesystem::path& path() const { return temporary_.path(); }
  /// What commit() replaces: the files of an earlier run, relative to the folder; empty: none.
  const std::set<std::string>& earlier_files() const { return known_; }
  /// `text` with the folder's own name in the place of the temporary one: for messages.
  std::string with_own_name(std::string text) const;
  /// An earlier output stays as it was where this throws InputError. Files that others put into
  /// the folder in the meantime stay there too.
  void commit();

 private:
  void make_parents();
  void swap_folders(const std::filesystem::path& aside);
  void swap_contents(const std::filesystem::path& aside);
  void clear_away(const std::filesystem::path& aside, const std::set<std::string>& known);

  std::filesystem::path target_;
  Earlier earlier_;
  std::set<std::string> known_;  ///< of the earlier run
  bool within_;                  ///< the temporary folder lies in the target, which must stay
  TemporaryPath temporary_;
  std::vector<std::filesystem::path> made_;  ///< parents of the target, the outermost first
  std::vector<InUse> in_use_;
  bool committed_ = false;
};

/// Every file in `folder` and below, relative to it and with '/' between, sorted; links are named
/// and not followed.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace hyperex
