// SPDX-License-Identifier: GPL-3.0-or-later
// Names in the folder that the studio writes to, and what a session that ended has left.
#include <algorithm>
#include <array>

#include "hyperex/core/error.hpp"
#include "server.hpp"
#include "session.hpp"

namespace hyperex::studio {

using nlohmann::json;
namespace fs = std::filesystem;

void Session::check_save_name(const std::string& name) {
  if (!is_upload_name(name))
    throw InputError("name: expected letters, digits, spaces and any of -_.(), the first no dot");
}

bool Session::is_anothers(const fs::path& path) const {
  return fs::exists(fs::symlink_status(path)) &&
         std::find(written_.begin(), written_.end(), path) == written_.end();
}

json Session::free_name(const json& fields) {
  // All that save() may write under a name.
  constexpr std::array endings = {"", ".toml", "_files", ".html", ".mrk.json", ".json"};
  const std::string wanted = fields.at("name");
  check_save_name(wanted);
  for (int n = 1;; ++n) {
    const std::string name = n == 1 ? wanted : wanted + "-" + std::to_string(n);
    if (std::none_of(endings.begin(), endings.end(), [&](const char* ending) {
          return is_anothers(options_.save_into / (name + ending));
        }))
      return {{"name", name}};
  }
}

json Session::discard_autosave() {
  if (options_.rescued.empty()) throw InputError("nothing is left of a session that ended");
  if (face_ && now_.file.parent_path() == options_.rescued)
    throw InputError("what was left is open: save it, or open something else first");
  std::error_code error;
  fs::remove_all(options_.rescued, error);
  if (error) throw InputError("what was left cannot be deleted (" + error.message() + ")");
  options_.rescued.clear();
  keeps_rescued_ = false;
  return json::object();
}

}  // namespace hyperex::studio
