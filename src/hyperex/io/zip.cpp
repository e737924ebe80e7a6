// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/zip.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <algorithm>
#include <clocale>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 16;
constexpr std::size_t kLongestName = 200;  // of one folder or file name, bytes

/// libarchive returns names in the encoding of this thread's locale. This sets UTF-8.
class Utf8Names {
 public:
  Utf8Names() : names_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(uselocale(names_)) {}
  Utf8Names(const Utf8Names&) = delete;
  ~Utf8Names() {
    uselocale(before_);
    if (names_) freelocale(names_);
  }

 private:
  locale_t names_, before_;
};

/// The part of a text from the archive that can be shown in a message.
std::string shown(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 100));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return text;
}

enum class Kind { file, folder };

class Archive {
 public:
  Archive(const fs::path& file, const UnzipLimits& limits) : file_(file), limits_(limits) {
    if (!std::ifstream(file)) throw InputError(file, "cannot be read: expected a zip");
    archive_read_support_format_zip_seekable(archive_.get());
    if (archive_read_open_filename(archive_.get(), file.c_str(), kBlock) != ARCHIVE_OK) unsound();
  }

  /// The next entry; nothing after the last.
  std::optional<Kind> next() {
    archive_entry* entry = nullptr;
    const int state = archive_read_next_header(archive_.get(), &entry);
    if (state == ARCHIVE_EOF) return std::nullopt;
    if (state < ARCHIVE_WARN || !archive_entry_pathname(entry)) unsound();
    name_ = archive_entry_pathname(entry);
    stated_.reset();
    if (archive_entry_size_is_set(entry))
      stated_ = static_cast<std::uint64_t>(std::max<la_int64_t>(0, archive_entry_size(entry)));
    if (++count_ > limits_.most_files)
      throw InputError(file_, fmt::format("holds more than {0} files: expected at most {0}",
                                          limits_.most_files));
    if (archive_entry_is_encrypted(entry)) refuse("is encrypted");
    const auto type = archive_entry_filetype(entry);
    if (type != AE_IFREG && type != AE_IFDIR) refuse("is a link or a device");
    return type == AE_IFDIR ? Kind::folder : Kind::file;
  }
  const std::string& name() const { return name_; }

  /// Counts what the directory states of the entry, so that nothing has to be unpacked.
  void count_stated() {
    const std::uint64_t bytes = stated_.value_or(0);
    counted_ = bytes > limits_.most_bytes - counted_ ? limits_.most_bytes + 1 : counted_ + bytes;
    check_counted();
  }

  /// The unpacked bytes are counted during unpacking, independently of the header.
  void unpack(const fs::path& to) {
    std::ofstream out(to, std::ios::binary);
    if (!out) throw InputError(to, "cannot be written");
    std::vector<char> bytes(kBlock);
    std::uint64_t of_entry = 0;
    for (la_ssize_t count = 0;
         (count = archive_read_data(archive_.get(), bytes.data(), bytes.size())) != 0;) {
      if (count < 0)
        refuse(fmt::format("is damaged ({})", shown(archive_error_string(archive_.get()))));
      of_entry += static_cast<std::uint64_t>(count);
      if (stated_ && of_entry > *stated_) refuse("is damaged (longer than the zip states)");
      counted_ += static_cast<std::uint64_t>(count);
      check_counted();
      out.write(bytes.data(), count);
    }
    out.close();
    if (!out) throw InputError(to, "cannot be written: is the disk full?");
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(file_, fmt::format("{} in it {}", shown(name_), why));
  }

 private:
  void check_counted() const {
    if (counted_ > limits_.most_bytes)
      throw InputError(file_, fmt::format("unpacks to more than {} MB: expected less",
                                          limits_.most_bytes >> 20U));
  }
  [[noreturn]] void unsound() const {
    throw InputError(file_, "is no sound zip: expected one that is whole and holds files");
  }

  static constexpr std::size_t kBlock = 1 << 16;
  struct Free {
    void operator()(archive* a) const { archive_read_free(a); }
  };

  const fs::path& file_;
  const UnzipLimits& limits_;
  Utf8Names names_;
  std::unique_ptr<archive, Free> archive_{archive_read_new()};
  std::string name_;
  std::optional<std::uint64_t> stated_;  ///< bytes of this entry, by the header
  std::uint64_t counted_ = 0;            ///< bytes so far
  int count_ = 0;
};

enum class Way { taken, left_out, refused };

/// Converts a name to a path inside the folder, or refuses it.
Way way_of(const std::string& name, fs::path& way) {
  const bool odd = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
           std::string_view("\\:*?\"<>|").find(c) != std::string_view::npos;
  });
  if (name.empty() || name.front() == '/' || odd) return Way::refused;
  way.clear();
  bool hidden = false;
  int depth = 0;
  for (std::size_t from = 0; from < name.size();) {
    const std::size_t end = std::min(name.find('/', from), name.size());
    const std::string part = name.substr(from, end - from);
    if (part.empty() || part == "." || part == ".." || part.size() > kLongestName ||
        ++depth > kDeepest)
      return Way::refused;
    hidden = hidden || part.front() == '.' || part == "__MACOSX";
    way /= part;
    from = end + 1;
  }
  return hidden ? Way::left_out : Way::taken;
}

/// The next entry that is taken and where it belongs; nothing after the last.
std::optional<Kind> next_taken(Archive& archive, fs::path& way) {
  while (const auto kind = archive.next()) {
    const Way leads = way_of(archive.name(), way);
    if (leads == Way::refused)
      archive.refuse("has a name that leads elsewhere: expected a plain one");
    if (leads == Way::taken) return kind;
  }
  return std::nullopt;
}

/// A folder that is removed at the end unless it is kept.
class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) { fs::create_directories(path_); }
  Folder(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }
  void keep_as(const fs::path& name) {
    fs::rename(path_, name);
    path_.clear();
  }

 private:
  fs::path path_;
};

}  // namespace

std::vector<fs::path> files_in_zip(const fs::path& zip, const UnzipLimits& limits) {
  Archive archive(zip, limits);
  std::vector<fs::path> files;
  fs::path way;
  while (const auto kind = next_taken(archive, way)) {
    archive.count_stated();
    if (*kind == Kind::file) files.push_back(way);
  }
  return files;
}

void unzip(const fs::path& zip, const fs::path& folder, const UnzipLimits& limits) {
  if (fs::exists(fs::symlink_status(folder)))
    throw InputError(folder, "is there already: expected another name");
  files_in_zip(zip, limits);
  Archive archive(zip, limits);
  Folder made(folder.parent_path() / (".part-" + folder.filename().string()));
  fs::path way;
  while (const auto kind = next_taken(archive, way)) {
    const fs::path to = made.path() / way;
    const bool is_folder = *kind == Kind::folder;
    std::error_code error;
    fs::create_directories(is_folder ? to : to.parent_path(), error);
    if (error || (!is_folder && fs::exists(to))) archive.refuse("is there twice");
    if (!is_folder) archive.unpack(to);
  }
  made.keep_as(folder);
}

}  // namespace hyperex::io
