// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The segments in which a plane through `at` with the given normal (any length > 0) cuts a
/// surface: two rows each, in the order of the triangles.
Points plane_section(const TriMesh& mesh, const Vec3& at, const Vec3& normal);

}  // namespace hyperex
