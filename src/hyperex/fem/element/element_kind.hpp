// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

#include "hyperex/core/describe.hpp"

namespace hyperex::fem {

/// How the change of volume is averaged on a mesh of linear tetrahedra. Compared in
/// docs/elements.md.
///  tet4:      in each tetrahedron separately; locks as nu approaches 0.5
///  tet4_star: over patches that are grown from non-overlapping stars of nodes; nu up to 0.4999
enum class ElementKind { tet4, tet4_star };

inline constexpr ElementKind kElementKinds[] = {ElementKind::tet4, ElementKind::tet4_star};

constexpr auto words_of(ElementKind) {
  return std::array{Word{"tet4", ElementKind::tet4}, Word{"tet4-star", ElementKind::tet4_star}};
}
constexpr std::string_view to_string(ElementKind kind) {
  return word_of(kind);
}

}  // namespace hyperex::fem
