// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hyperex::test {

/// A file of a zip. A hostile zip may contain false values.
struct Zipped {
  std::string name, bytes;
  bool deflated = true;
  std::uint32_t mode = 0100644;  ///< mode of a file in Unix
  int flags = 0;
  int method = -1;            ///< stated instead of the true one
  std::int64_t size = -1;     ///< stated instead of the true one
  std::uint32_t crc_off = 0;  ///< added to the checksum
};

inline std::string deflated(const std::string& bytes) {
  z_stream z{};
  deflateInit2(&z, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, static_cast<uLong>(bytes.size())), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

/// The bytes of a zip.
inline std::string zip_of(const std::vector<Zipped>& files) {
  std::string out, directory;
  const auto put = [](std::string& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to += static_cast<char>((value >> (8 * i)) & 0xff);
  };
  for (const Zipped& file : files) {
    const std::string packed = file.deflated ? deflated(file.bytes) : file.bytes;
    const auto crc = file.crc_off + static_cast<std::uint32_t>(
                                        crc32(0, reinterpret_cast<const Bytef*>(file.bytes.data()),
                                              static_cast<uInt>(file.bytes.size())));
    const auto size = file.size < 0 ? file.bytes.size() : static_cast<std::size_t>(file.size);
    const int method = file.method >= 0 ? file.method : file.deflated ? 8 : 0;
    const std::size_t offset = out.size();
    const auto common = [&](std::string& to) {
      put(to, 20, 2);
      put(to, std::uint64_t(file.flags), 2);
      put(to, std::uint64_t(method), 2);
      put(to, 0, 4);  // time
      put(to, crc, 4);
      put(to, packed.size(), 4);
      put(to, size, 4);
      put(to, file.name.size(), 2);
      put(to, 0, 2);
    };
    put(out, 0x04034b50, 4);
    common(out);
    out += file.name + packed;
    put(directory, 0x02014b50, 4);
    put(directory, (3 << 8) | 20, 2);
    common(directory);
    put(directory, 0, 2);  // comment
    put(directory, 0, 2);  // disk
    put(directory, 0, 2);
    put(directory, std::uint64_t(file.mode) << 16U, 4);
    put(directory, offset, 4);
    directory += file.name;
  }
  const std::size_t at = out.size();
  out += directory;
  put(out, 0x06054b50, 4);
  put(out, 0, 4);
  put(out, files.size(), 2);
  put(out, files.size(), 2);
  put(out, directory.size(), 4);
  put(out, at, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace hyperex::test
