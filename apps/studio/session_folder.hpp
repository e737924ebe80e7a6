// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/core/temporary.hpp"

namespace hyperex::studio {

/// The folder of one session, for uploads and for the scene as it is: what a later session offers
/// where this one dies. It lies in $XDG_STATE_HOME/hyperex/studio, else
/// ~/.local/state/hyperex/studio; without a home among the temporary files.
class SessionFolder {
 public:
  SessionFolder();
  /// Removes the folder, unless leave() was called.
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The youngest folder that a session which is no more left behind with a scene in it; empty
  /// where there is none.
  const std::filesystem::path& rescued() const { return rescued_; }
  void leave() { left_ = true; }

 private:
  void make_among_temporary_files();
  std::filesystem::path path_, rescued_;
  std::unique_ptr<InUse> in_use_;
  bool left_ = false;
};

}  // namespace hyperex::studio
