// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/core/temporary.hpp"

namespace hyperex::studio {

/// The folder of one session, for uploads and the autosaved scene, which a later session offers if
/// this one crashes. It lies in $XDG_STATE_HOME/hyperex/studio, else ~/.local/state/hyperex/studio,
/// else, without a home, among the temporary files.
class SessionFolder {
 public:
  SessionFolder();
  /// Removes the folder, unless leave() was called.
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The newest folder with a scene that an ended session has left; empty where there is none.
  const std::filesystem::path& rescued() const { return rescued_; }
  /// Keeps the folder.
  void leave() { left_ = true; }

 private:
  void make_among_temporary_files();
  std::filesystem::path path_, rescued_;
  std::unique_ptr<InUse> in_use_;
  bool left_ = false;
};

}  // namespace hyperex::studio
