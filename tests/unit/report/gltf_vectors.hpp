// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tiny_gltf.h>

#include <cstdint>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report::testing {

/// Vectors of an accessor, whether all are stored or only those that are not 0.
inline PointsF vectors_of(const tinygltf::Model& model, int accessor) {
  const auto& a = model.accessors.at(std::size_t(accessor));
  const auto bytes = [&](int view) {
    return model.buffers[0].data.data() + model.bufferViews.at(std::size_t(view)).byteOffset;
  };
  const auto rows = static_cast<Eigen::Index>(a.count);
  if (!a.sparse.isSparse)
    return Eigen::Map<const PointsF>(reinterpret_cast<const float*>(bytes(a.bufferView)), rows, 3);
  const unsigned char* indices = bytes(a.sparse.indices.bufferView);
  const bool narrow = a.sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  const auto* value = reinterpret_cast<const float*>(bytes(a.sparse.values.bufferView));
  PointsF out = PointsF::Zero(rows, 3);
  for (int i = 0; i < a.sparse.count; ++i) {
    const Eigen::Index at = narrow ? reinterpret_cast<const std::uint16_t*>(indices)[i]
                                   : reinterpret_cast<const std::uint32_t*>(indices)[i];
    out.row(at) << value[3 * i], value[3 * i + 1], value[3 * i + 2];
  }
  return out;
}

}  // namespace hyperex::report::testing
