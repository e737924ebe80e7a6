// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

#include "hyperex/core/describe.hpp"

namespace hyperex::fem {

/// How the change of volume is measured on a mesh of linear tetrahedra; docs/elements.md compares.
///  tet4:      in each tetrahedron on its own; locks as nu nears 0.5
///  tet4_star: in patches grown from stars of nodes that do not overlap; nu up to 0.4999
enum class ElementKind { tet4, tet4_star };

inline constexpr ElementKind kElementKinds[] = {ElementKind::tet4, ElementKind::tet4_star};

constexpr auto words_of(ElementKind) {
  return std::array{Word{"tet4", ElementKind::tet4}, Word{"tet4-star", ElementKind::tet4_star}};
}
constexpr std::string_view to_string(ElementKind kind) {
  return word_of(kind);
}

}  // namespace hyperex::fem
