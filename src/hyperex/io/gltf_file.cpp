// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/io/nesting.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::io {
namespace {
static_assert(std::endian::native == std::endian::little);

/// Keeps images as encoded bytes. Images in a buffer are read later, with a range check.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return std::string(trimmed(text).substr(0, 200));
}

/// The files that tinygltf may read: those in the scan's folder or below.
struct ScanFolder {
  std::filesystem::path path;
  std::string refusals;

  static bool holds(const std::string& name, void* self) {
    auto& folder = *static_cast<ScanFolder*>(self);
    try {
      named_file(folder.path, std::filesystem::absolute(name).string());
      return true;
    } catch (const std::exception& refusal) {
      // tinygltf looks in the scan's folder first, then in the current folder. Only the first
      // refusal matters.
      if (folder.refusals.empty()) folder.refusals = std::string("; ") + refusal.what();
      return false;
    }
  }
  static std::string as_it_is(const std::string& name, void*) { return name; }
  static bool read(std::vector<unsigned char>* bytes, std::string* error, const std::string& name,
                   void* self) {
    if (!holds(name, self)) return false;
    try {
      const std::string text = read_regular_file(name);
      bytes->assign(text.begin(), text.end());
      return true;
    } catch (const InputError& refusal) {
      *error += refusal.what();
      return false;
    }
  }
  static bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&,
                            void*) {
    return false;
  }
};

/// The JSON part of a file that begins like a binary one; otherwise the whole file.
std::string_view json_of(const std::string& bytes, bool binary) {
  if (!binary) return bytes;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return std::string_view(bytes).substr(20, length);
}

}  // namespace

tinygltf::Model load_gltf(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const bool binary = bytes.starts_with("glTF");
  if (binary) {
    std::uint32_t length = 0;
    if (bytes.size() >= 12) std::memcpy(&length, bytes.data() + 8, 4);
    if (bytes.size() < 20 || bytes.size() < length)
      throw InputError(
          file, fmt::format("is torn: it has {} bytes; its header says {}", bytes.size(), length));
  }
  check_nesting_json(file, json_of(bytes, binary));
  ScanFolder beside{file.parent_path(), {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({&ScanFolder::holds, &ScanFolder::as_it_is, &ScanFolder::read,
                         &ScanFolder::write_nothing, &beside});
  loader.SetImageLoader(&keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = file.parent_path().string();
  bool sound = false;
  try {
    sound = binary
                ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()),
                                              size, folder)
                : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!sound) throw InputError(file, "is no sound glTF file: " + one_line(error) + beside.refusals);
  if (!warning.empty())
    remark(Remark::warning,
           fmt::format("{}: {}{}", file.string(), one_line(warning), beside.refusals));
  // Material extensions do not affect the shape, and quantised values are supported.
  for (const auto& extension : model.extensionsRequired)
    if (!extension.starts_with("KHR_materials_") && extension != "KHR_mesh_quantization")
      throw InputError(file, fmt::format("requires the extension {}, which is not supported; "
                                         "expected plain triangles (export without compression)",
                                         quotable(extension)));
  return model;
}

}  // namespace hyperex::io
