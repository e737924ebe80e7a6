// SPDX-License-Identifier: GPL-3.0-or-later
// APPNOTE.TXT 6.3.10 of PKWARE: the directory at the end says what is where.
#include "hyperex/io/zip.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kEnd = 0x06054b50, kEntry = 0x02014b50, kLocal = 0x04034b50;
constexpr std::size_t kEndSize = 22, kEntrySize = 46, kLocalSize = 30, kMostComment = 65535;
constexpr std::size_t kChunk = 1 << 16;
constexpr int kDeepest = 16;
constexpr std::size_t kLongestName = 200;  // of one folder or file, bytes

std::uint16_t two(const char* at) {
  const auto* b = reinterpret_cast<const unsigned char*>(at);
  return static_cast<std::uint16_t>(b[0] | (b[1] << 8U));
}
std::uint32_t four(const char* at) {
  return two(at) | (std::uint32_t(two(at + 2)) << 16U);
}

struct Entry {
  std::string name;
  int method = 0;
  std::uint32_t crc = 0, packed = 0, size = 0, offset = 0;
};

/// Of a name what can be shown in a message.
std::string shown(const std::string& name) {
  std::string out = name.substr(0, 100);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return out;
}

class Archive {
 public:
  Archive(const fs::path& file, const UnzipLimits& limits)
      : file_(file), limits_(limits), stream_(file, std::ios::binary) {
    std::error_code error;
    size_ = fs::file_size(file, error);
    if (error || !stream_) throw InputError(file, "cannot be read: expected a zip");
  }

  std::vector<Entry> entries() {
    const std::string directory = read_directory();
    std::vector<Entry> out;
    std::size_t at = 0;
    for (int i = 0; i < count_; ++i) {
      if (at + kEntrySize > directory.size() || four(&directory[at]) != kEntry) damaged();
      const char* head = &directory[at];
      const std::size_t name = two(head + 28), rest = two(head + 30) + std::size_t(two(head + 32));
      if (at + kEntrySize + name + rest > directory.size()) damaged();
      Entry entry{std::string(head + kEntrySize, name),
                  two(head + 10),
                  four(head + 16),
                  four(head + 20),
                  four(head + 24),
                  four(head + 42)};
      at += kEntrySize + name + rest;
      constexpr unsigned kEncrypted = 1, kUnix = 3, kTypes = 0170000, kLink = 0120000;
      if (two(head + 8) & kEncrypted) refuse(entry, "is encrypted");
      if ((two(head + 4) >> 8U) == kUnix && ((four(head + 38) >> 16U) & kTypes) == kLink)
        refuse(entry, "is a link");
      if (entry.size == 0xffffffff || entry.packed == 0xffffffff || entry.offset == 0xffffffff)
        refuse(entry, "is of the 64-bit form, for more than 4 GB");
      out.push_back(std::move(entry));
    }
    return out;
  }

  void unpack(const Entry& entry, const fs::path& to) {
    if (entry.method != 0 && entry.method != 8)
      refuse(entry, fmt::format("is packed by method {}: expected deflate", entry.method));
    std::array<char, kLocalSize> head{};
    read(entry.offset, head.data(), head.size());
    if (four(head.data()) != kLocal) damaged();
    std::uint64_t from =
        entry.offset + std::uint64_t(kLocalSize) + two(&head[26]) + std::uint64_t(two(&head[28]));
    if (from + entry.packed > size_) damaged();
    std::ofstream out(to, std::ios::binary);
    if (!out) throw InputError(to, "cannot be written");
    Sum sum;
    entry.method == 0 ? copy(entry, from, out, sum) : inflate_to(entry, from, out, sum);
    if (sum.size != entry.size || sum.crc != entry.crc) refuse(entry, "is damaged");
    out.close();
    if (!out) throw InputError(to, "cannot be written: is the disk full?");
  }

  [[noreturn]] void refuse(const Entry& entry, const std::string& why) const {
    throw InputError(file_, fmt::format("{} in it {}", shown(entry.name), why));
  }

 private:
  struct Sum {
    std::uint64_t size = 0;
    std::uint32_t crc = 0;
  };

  [[noreturn]] void damaged() const {
    throw InputError(file_, "is no sound zip: expected one that is whole");
  }

  void read(std::uint64_t from, char* to, std::size_t size) {
    if (from + size > size_) damaged();
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(from));
    if (!stream_.read(to, static_cast<std::streamsize>(size))) damaged();
  }

  std::string read_directory() {
    const std::size_t tail = std::min<std::uint64_t>(size_, kEndSize + kMostComment);
    std::string end(tail, '\0');
    read(size_ - tail, end.data(), tail);
    std::size_t at = tail;
    for (std::size_t i = tail < kEndSize ? 0 : tail - kEndSize + 1; i-- > 0;)
      if (four(&end[i]) == kEnd && i + kEndSize + two(&end[i + 20]) == tail) {
        at = i;
        break;
      }
    if (at == tail) damaged();
    const char* head = &end[at];
    count_ = two(head + 10);
    if (two(head + 4) != 0 || two(head + 6) != 0 || two(head + 8) != count_)
      throw InputError(file_, "is one of several parts: expected a zip that is whole");
    const std::uint32_t size = four(head + 12), from = four(head + 16);
    if (count_ == 0xffff || from == 0xffffffff)
      throw InputError(file_, "is of the 64-bit form: expected at most 65,534 files and 4 GB");
    if (count_ > limits_.most_files)
      throw InputError(
          file_, fmt::format("holds {} files: expected at most {}", count_, limits_.most_files));
    if (std::uint64_t(from) + size > size_ - tail + at) damaged();
    std::string directory(size, '\0');
    read(from, directory.data(), size);
    return directory;
  }

  void take(const Entry& entry, const char* bytes, std::size_t count, std::ofstream& out,
            Sum& sum) {
    unpacked_ += count;
    sum.size += count;
    if (unpacked_ > limits_.most_bytes)
      throw InputError(file_, fmt::format("unpacks to more than {} MB: expected less",
                                          limits_.most_bytes >> 20U));
    if (sum.size > entry.size) refuse(entry, "is damaged");
    sum.crc = static_cast<std::uint32_t>(
        crc32(sum.crc, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(count)));
    out.write(bytes, static_cast<std::streamsize>(count));
  }

  void copy(const Entry& entry, std::uint64_t from, std::ofstream& out, Sum& sum) {
    std::vector<char> chunk(kChunk);
    for (std::uint64_t left = entry.packed; left > 0;) {
      const std::size_t some = std::min<std::uint64_t>(left, kChunk);
      read(from, chunk.data(), some);
      take(entry, chunk.data(), some, out, sum);
      from += some;
      left -= some;
    }
  }

  void inflate_to(const Entry& entry, std::uint64_t from, std::ofstream& out, Sum& sum) {
    struct Inflater {
      z_stream z{};
      Inflater() {
        if (inflateInit2(&z, -MAX_WBITS) != Z_OK) throw std::runtime_error("zlib does not start");
      }
      ~Inflater() { inflateEnd(&z); }
    } inflater;
    z_stream& z = inflater.z;
    std::vector<char> in(kChunk), plain(kChunk);
    int state = Z_OK;
    for (std::uint64_t left = entry.packed; state != Z_STREAM_END;) {
      if (z.avail_in == 0) {
        if (left == 0) refuse(entry, "is damaged");
        const std::size_t some = std::min<std::uint64_t>(left, kChunk);
        read(from, in.data(), some);
        from += some;
        left -= some;
        z.next_in = reinterpret_cast<Bytef*>(in.data());
        z.avail_in = static_cast<uInt>(some);
      }
      z.next_out = reinterpret_cast<Bytef*>(plain.data());
      z.avail_out = static_cast<uInt>(plain.size());
      state = inflate(&z, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END) refuse(entry, "is damaged");
      take(entry, plain.data(), plain.size() - z.avail_out, out, sum);
    }
  }

  const fs::path& file_;
  const UnzipLimits& limits_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, unpacked_ = 0;
  int count_ = 0;
};

enum class Way { taken, left_out, refused };

/// Where a name leads to: inside, or not at all.
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

/// Removed again unless it is kept.
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

void unzip(const fs::path& zip, const fs::path& folder, const UnzipLimits& limits) {
  if (fs::exists(fs::symlink_status(folder)))
    throw InputError(folder, "is there already: expected another name");
  Archive archive(zip, limits);
  const std::vector<Entry> entries = archive.entries();
  Folder made(folder.parent_path() / (".part-" + folder.filename().string()));
  std::set<fs::path> files;
  for (const Entry& entry : entries) {
    fs::path way;
    switch (way_of(entry.name, way)) {
      case Way::refused:
        archive.refuse(entry, "has a name that leads elsewhere: expected a plain one");
      case Way::left_out:
        continue;
      case Way::taken:
        break;
    }
    std::error_code error;
    if (entry.name.back() == '/') {
      fs::create_directories(made.path() / way, error);
      if (error) archive.refuse(entry, "is there twice");
      continue;
    }
    fs::create_directories((made.path() / way).parent_path(), error);
    if (error || !files.insert(way).second || fs::exists(made.path() / way))
      archive.refuse(entry, "is there twice");
    archive.unpack(entry, made.path() / way);
  }
  made.keep_as(folder);
}

}  // namespace hyperex::io
