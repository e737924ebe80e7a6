// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::report {

/// One block of little-endian numbers, decoded once by a page. The manifest states what it contains
/// and where.
class BinaryBlock {
 public:
  /// Appends `count` numbers and returns where they are: {"type", "offset" in bytes, "count"}.
  /// `type` names T as JavaScript's typed arrays do: "float32", "int16" ...
  template <typename T>
  nlohmann::json add(const char* type, const T* data, std::size_t count) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);  // typed arrays need aligned offsets
    const nlohmann::json at = {{"type", type}, {"offset", bytes_.size()}, {"count", count}};
    const auto* first = reinterpret_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
    return at;
  }
  nlohmann::json add(const std::vector<float>& v) { return add("float32", v.data(), v.size()); }
  nlohmann::json add(const std::vector<int>& v) { return add("int32", v.data(), v.size()); }
  nlohmann::json add(const std::vector<std::int16_t>& v) {
    return add("int16", v.data(), v.size());
  }
  nlohmann::json add(const std::vector<std::uint8_t>& v) {
    return add("uint8", v.data(), v.size());
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// In base64 (RFC 4648), with padding.
std::string base64(const std::vector<std::uint8_t>& bytes);

/// "palette" of a manifest: colours of categories on light and dark paper (render/time_plot.hpp),
/// the places of left and right in them, and those of base and its variants.
nlohmann::json palette();

/// Writes `page` (page_template.hpp) with its data put in: a JSON manifest in the element
/// hyperex-manifest and the block as base64 in hyperex-binary. Text of the manifest cannot end the
/// element. palette() is put in. Throws InputError where the file cannot be written.
void write_page(const std::filesystem::path& file, std::string_view page, nlohmann::json manifest,
                const BinaryBlock& block);

}  // namespace hyperex::report
