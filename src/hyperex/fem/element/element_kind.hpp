// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::fem {

/// How the change of volume is measured on a mesh of linear tetrahedra (docs/elements.md).
///  tet4:       in each tetrahedron on its own; locks as nu nears 0.5
///  tet4_nodal: averaged over the tetrahedra around each node; does not lock up to nu = 0.4999
enum class ElementKind { tet4, tet4_nodal };

/// As in scene files.
constexpr std::string_view to_string(ElementKind kind) {
  return kind == ElementKind::tet4 ? "tet4" : "tet4-nodal";
}

}  // namespace hyperex::fem
