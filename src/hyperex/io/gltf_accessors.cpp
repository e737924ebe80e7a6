// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/gltf_accessors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {

template <class T>
double load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double number(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? std::max(load<std::int8_t>(bytes) / 127, -1.) : load<std::int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(bytes) / (normalized ? 255 : 1);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? std::max(load<std::int16_t>(bytes) / 32767, -1.)
                        : load<std::int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes) / (normalized ? 65535 : 1);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return load<std::int32_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return load<double>(bytes);
    default:
      return load<float>(bytes);
  }
}

}  // namespace

std::vector<double> GltfAccessors::read(int id, int columns, const char* what) const {
  const tinygltf::Accessor& a = accessor(id, what);
  if (a.sparse.isSparse || a.bufferView < 0)
    fail(id, what, "is sparse or empty; expected its values in a buffer view");
  std::vector<double> values;  // not reserved: the file's count is not checked yet
  items(id, what, {a.bufferView, a.byteOffset, a.count, a.componentType, a.type, a.normalized},
        columns, [&](std::size_t, double value) { values.push_back(value); });
  return values;
}

std::vector<double> GltfAccessors::read_sparse(int id, int columns, std::size_t count,
                                               const char* what) const {
  const tinygltf::Accessor& a = accessor(id, what);
  if (a.count != count) fail(id, what, fmt::format("has {} items; expected {}", a.count, count));
  if (!a.sparse.isSparse && a.bufferView >= 0) return read(id, columns, what);
  std::vector<double> values(count * columns);
  if (a.bufferView >= 0)
    items(id, what, {a.bufferView, a.byteOffset, count, a.componentType, a.type, a.normalized},
          columns, [&](std::size_t k, double value) { values[k] = value; });
  if (!a.sparse.isSparse) return values;  // zeros by definition
  const auto& sparse = a.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > count)
    fail(id, what, fmt::format("lists {} of its {} items", sparse.count, count));
  const auto listed = static_cast<std::size_t>(sparse.count);
  std::vector<std::size_t> row;
  row.reserve(listed);
  items(id, what,
        {sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), listed,
         sparse.indices.componentType, TINYGLTF_TYPE_SCALAR, false},
        1, [&](std::size_t, double value) {
          if (!(value >= 0 && value < static_cast<double>(count)))
            fail(id, what, fmt::format("lists item {}; expected 0 to {}", value, count - 1));
          row.push_back(static_cast<std::size_t>(value));
        });
  items(id, what,
        {sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), listed,
         a.componentType, a.type, a.normalized},
        columns, [&](std::size_t k, double value) {
          values[row[k / columns] * columns + k % columns] = value;
        });
  return values;
}

template <class Take>
void GltfAccessors::items(int id, const char* what, const Items& a, int columns,
                          const Take& take) const {
  const int stored = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
  const int width = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.component_type));
  if (stored < columns || stored > 4 || width <= 0)
    fail(id, what, fmt::format("has another type; expected {} numbers an item", columns));
  const auto [bytes, available] = view(a.buffer_view, what);
  const std::size_t item = static_cast<std::size_t>(stored) * width;
  const std::size_t stride = model_.bufferViews[a.buffer_view].byteStride
                                 ? model_.bufferViews[a.buffer_view].byteStride
                                 : item;
  // The count is checked by division, so that a damaged file cannot cause a large allocation.
  if (a.byte_offset > available || stride < item || available - a.byte_offset < item ||
      (a.count - 1) > (available - a.byte_offset - item) / stride)
    fail(id, what,
         fmt::format("needs {} items of {} bytes; its buffer view is too short", a.count, item));
  std::size_t at = 0;
  for (std::size_t i = 0; i < a.count; ++i)
    for (int k = 0; k < columns; ++k)
      take(at++,
           number(bytes + a.byte_offset + i * stride + k * width, a.component_type, a.normalized));
}

int GltfAccessors::columns(int id, const char* what) const {
  return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor(id, what).type));
}

std::pair<const unsigned char*, std::size_t> GltfAccessors::view(int id, const char* what) const {
  if (id < 0 || id >= static_cast<int>(model_.bufferViews.size()))
    throw InputError(file_, fmt::format("{}: there is no buffer view {}", what, id));
  const tinygltf::BufferView& v = model_.bufferViews[id];
  if (v.buffer < 0 || v.buffer >= static_cast<int>(model_.buffers.size()))
    throw InputError(file_, fmt::format("{}: there is no buffer {}", what, v.buffer));
  const auto& data = model_.buffers[v.buffer].data;
  if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
    throw InputError(file_,
                     fmt::format("{}: buffer {} is too short: it has {} bytes, buffer view "
                                 "{} needs {} from {} on",
                                 what, v.buffer, data.size(), id, v.byteLength, v.byteOffset));
  return {data.data() + v.byteOffset, v.byteLength};
}

const tinygltf::Accessor& GltfAccessors::accessor(int id, const char* what) const {
  if (id < 0 || id >= static_cast<int>(model_.accessors.size()))
    throw InputError(file_, fmt::format("{}: there is no accessor {}", what, id));
  if (model_.accessors[id].count == 0) fail(id, what, "is empty; expected at least one item");
  return model_.accessors[id];
}

void GltfAccessors::fail(int id, const char* what, const std::string& why) const {
  throw InputError(file_, fmt::format("{}: accessor {} {}", what, id, why));
}

}  // namespace hyperex::io
