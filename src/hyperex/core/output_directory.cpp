// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/stat.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/remarks.hpp"

namespace hyperex {
namespace fs = std::filesystem;
namespace {

fs::path without_slash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

/// The folder that is meant, links followed.
fs::path followed(const fs::path& target) {
  if (target.empty()) throw InputError("the name of the folder for the outputs is empty");
  std::error_code error;
  const fs::path found = without_slash(fs::weakly_canonical(fs::absolute(target, error), error));
  if (error) throw InputError(target, "cannot be written (" + error.message() + ")");
  if (fs::is_symlink(fs::symlink_status(found, error)))
    throw InputError(target, fmt::format("is a link to {}, which does not exist; expected the name "
                                         "of a folder for the outputs",
                                         fs::read_symlink(found, error).string()));
  return found;
}

bool is_named_as_a_file(const fs::path& folder) {
  constexpr const char* files[] = {".glb", ".gltf", ".html", ".json", ".csv", ".png", ".ply",
                                   ".obj", ".stl",  ".toml", ".vtu",  ".pvd", ".zip", ".webm",
                                   ".mp4", ".txt",  ".pdf",  ".trc",  ".jpg"};
  const std::string extension = ending_of(folder);
  return std::ranges::any_of(files, [&](const char* one) { return extension == one; });
}

bool is_or_holds(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// A folder that must not be renamed: it is mounted, somebody works in it, or its parent is not
/// ours to change.
bool must_stay(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  const fs::path here = fs::canonical(fs::current_path(error), error);
  if (!error && is_or_holds(folder, here)) return true;
  if (::access(folder.parent_path().c_str(), W_OK) != 0) return true;
  struct statx status {};
  return ::statx(AT_FDCWD, folder.c_str(), 0, STATX_BASIC_STATS, &status) == 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// Collects the entries that `known` does not name. A folder that contains none of the known files
/// is one entry, ending in '/'.
void find_others(const fs::path& folder, const std::string& at, const std::set<std::string>& known,
                 std::vector<std::string>& others) {
  std::error_code error;
  for (fs::directory_iterator entry(folder / at, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = at + entry->path().filename().string();
    const fs::file_status status = entry->symlink_status(error);
    if (fs::is_directory(status)) {
      const auto first = known.lower_bound(name + "/");
      if (first != known.end() && first->starts_with(name + "/"))
        find_others(folder, name + "/", known, others);
      else
        others.push_back(name + "/");
    } else if (!fs::is_regular_file(status) || !known.contains(name)) {
      others.push_back(name);
    }
  }
  if (error) others.push_back(at.empty() ? "." : at);
}

/// The files in `folder` that `known` names, and folders that are then empty. What a name leads to
/// outside of the folder, by ".." or a link, is never touched.
void remove_known(const fs::path& folder, const std::string& at,
                  const std::set<std::string>& known) {
  std::error_code error, ignored;
  std::vector<fs::directory_entry> entries;
  for (fs::directory_iterator entry(folder / at, error), end; !error && entry != end;
       entry.increment(error))
    entries.push_back(*entry);
  for (const fs::directory_entry& entry : entries) {
    const std::string name = at + entry.path().filename().string();
    const fs::file_status status = entry.symlink_status(ignored);
    if (fs::is_directory(status))
      remove_known(folder, name + "/", known);
    else if (fs::is_regular_file(status) && known.contains(name))
      fs::remove(entry.path(), ignored);
  }
  fs::remove(folder / at, ignored);  // only where it is empty
}

std::vector<std::string> others_in(const fs::path& folder, const std::set<std::string>& known) {
  std::vector<std::string> others;
  find_others(folder, "", known, others);
  std::erase_if(others, [&](std::string name) {
    if (name.ends_with('/')) name.pop_back();
    return is_temporary_of(folder, name);
  });
  std::sort(others.begin(), others.end());
  return others;
}

/// "a, b/ and 3 more", without what would upset a terminal.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < most; ++i)
    text += (i == 0                                          ? ""
             : i + 1 == names.size() && names.size() <= most ? " and "
                                                             : ", ") +
            names[i];
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  return text;
}

void refuse_inputs_in(const fs::path& folder, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs) {
    std::error_code error;
    if (!input.empty() && is_or_holds(folder, fs::weakly_canonical(input, error)))
      throw InputError(input, fmt::format("lies in {}, whose files are replaced; expected another "
                                          "folder for the outputs",
                                          folder.string()));
  }
}

}  // namespace

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!fs::is_directory(entry.symlink_status()))
      files.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

OutputDirectory::OutputDirectory(const fs::path& target, Earlier earlier,
                                 const std::vector<fs::path>& inputs)
    : target_(followed(target)),
      earlier_(std::move(earlier)),
      within_(must_stay(target_)),
      temporary_(within_ ? temporary_within(target_) : temporary_beside(target_)) {
  std::error_code error;
  for (const fs::path& folder : {target_.parent_path(), target_}) remove_leftovers(target_, folder);
  if (fs::exists(target_, error)) {
    if (!fs::is_directory(target_, error))
      throw InputError(target_, "is a file; expected the name of a folder for the outputs");
    known_ = earlier_(target_);
    if (const auto others = others_in(target_, known_); !others.empty())
      throw InputError(target_, fmt::format("holds {}, which no earlier run is known to have "
                                            "written; expected a new or empty folder, or one with "
                                            "an earlier run's results alone",
                                            listed(others)));
    refuse_inputs_in(target_, inputs);
  } else if (error) {
    throw InputError(target_, "cannot be written (" + error.message() + ")");
  } else if (is_named_as_a_file(target_)) {
    throw InputError(target_,
                     "is named as a file is; expected the name of a folder for the outputs");
  }
  make_parents();
  fs::create_directory(path(), error);
  if (error) throw InputError(target_, "cannot be created (" + error.message() + ")");
  if (in_use_.emplace_back(path()).taken())  // of a process of the same number, in a container
    throw InputError(target_, "is being written by another process; try again when that has ended");
  for (const auto& entry : fs::directory_iterator(path(), error))
    fs::remove_all(entry.path(), error);
}

void OutputDirectory::make_parents() {
  std::error_code error;
  for (fs::path parent = target_.parent_path(); !fs::exists(parent, error) && !error;
       parent = parent.parent_path())
    made_.insert(made_.begin(), parent);
  for (const fs::path& parent : made_) fs::create_directory(parent, error);
}

OutputDirectory::~OutputDirectory() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(path(), ignored);
  for (auto parent = made_.rbegin(); parent != made_.rend(); ++parent)
    fs::remove(*parent, ignored);  // only while empty
}

std::string OutputDirectory::with_own_name(std::string text) const {
  const std::string from = path().string(), to = target_.string();
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

void OutputDirectory::commit() {
  const auto together = hold_off_interruption();
  if (!in_use_.front().is_at(path()))
    throw InputError(target_,
                     "cannot be written: the folder that was being filled was replaced by "
                     "something else");
  std::error_code error;
  if (!fs::exists(target_, error)) {
    fs::rename(path(), target_, error);
    if (error) throw InputError(target_, "cannot be written (" + error.message() + ")");
    committed_ = true;
    return;
  }
  // Read again, because another run may have finished in the meantime.
  std::set<std::string> known = earlier_(target_);
  known.insert(known_.begin(), known_.end());
  const fs::path aside =
      within_ ? temporary_within(target_, "old") : temporary_beside(target_, "old");
  fs::remove_all(aside, error);
  if (within_)
    swap_contents(aside);
  else
    swap_folders(aside);
  committed_ = true;
  clear_away(aside, known);
}

/// At one stroke where the file system can do that.
void OutputDirectory::swap_folders(const fs::path& aside) {
  std::error_code error, ignored;
  const auto fail = [&] {
    throw InputError(target_, "cannot be written (" + error.message() + ")");
  };
  if (::renameat2(AT_FDCWD, path().c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    fs::rename(path(), aside, error);
    if (error) fail();
    return;
  }
  fs::rename(target_, aside, error);
  if (error) fail();
  fs::rename(path(), target_, error);
  if (!error) return;
  fs::rename(aside, target_, ignored);
  fail();
}

/// File by file, the folder itself staying what it is.
void OutputDirectory::swap_contents(const fs::path& aside) {
  std::error_code error, ignored;
  std::vector<std::pair<fs::path, fs::path>> moved;
  const auto move_all = [&](const fs::path& from, const fs::path& to) {
    std::vector<fs::path> names;
    for (fs::directory_iterator at(from, error), end; !error && at != end; at.increment(error))
      if (from != target_ || !is_temporary_of(target_, at->path().filename().string()))
        names.push_back(at->path().filename());
    for (const fs::path& name : names) {
      if (!error) fs::rename(from / name, to / name, error);
      if (!error) moved.emplace_back(from / name, to / name);
    }
  };
  fs::create_directory(aside, error);
  if (!error) move_all(target_, aside);
  if (!error) move_all(path(), target_);
  if (!error) {
    fs::remove(path(), ignored);
    return;
  }
  for (auto back = moved.rbegin(); back != moved.rend(); ++back)
    fs::rename(back->second, back->first, ignored);
  fs::remove(aside, ignored);
  throw InputError(target_, "cannot be written (" + error.message() + ")");
}

/// Removes the earlier run's files in `aside` and moves what is none of them back.
void OutputDirectory::clear_away(const fs::path& aside, const std::set<std::string>& known) {
  std::error_code ignored;
  for (std::string name : others_in(aside, known)) {
    if (name.ends_with('/')) name.pop_back();
    if (fs::exists(fs::symlink_status(target_ / name, ignored))) continue;
    fs::create_directories((target_ / name).parent_path(), ignored);
    fs::rename(aside / name, target_ / name, ignored);
  }
  remove_known(aside, "", known);
  if (!fs::exists(aside, ignored)) return;
  fs::path kept = target_;
  for (int n = 1; fs::exists(fs::symlink_status(kept, ignored)); ++n)
    kept = target_.string() + fmt::format(".kept{}", n);
  fs::rename(aside, kept, ignored);
  remark(Remark::warning,
         fmt::format("{}: files that others put into the output folder meanwhile", kept.string()));
}

}  // namespace hyperex
