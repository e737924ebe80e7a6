// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// For each parameter, one value per vertex of the scan: NaN where the file has no value; empty if
/// the file has no such column.
using PerVertex = std::array<Eigen::VectorXd, parameter_count>;

/// A CSV with columns young_kpa, viscosity_pa_s, poisson, density_kg_m3 (one or more; others are
/// ignored), one row per vertex of the scan in its order; or a PLY of the scan whose vertices have
/// them, in any order (vertex_match.hpp). Adds notes on how they were matched. Throws InputError if
/// the number of rows is wrong, if the vertices are not those of the scan, if none of the columns
/// exists, or if a value is out of range.
PerVertex read_per_vertex(const std::filesystem::path& file, const TriMesh& scan,
                          std::vector<Note>& notes);

/// Thickness of the soft tissue, m, likewise: a column or property thickness_mm, of 1 to 40, NaN
/// where the file gives none.
Eigen::VectorXd read_depths(const std::filesystem::path& file, const TriMesh& scan,
                            std::vector<Note>& notes);

/// A region painted on the scan: a share from 0 to 1 per vertex, in the scan's order. A CSV with a
/// column `weight` in that order; or a PLY whose vertices have it, or a mesh of the scan (PLY, OBJ,
/// GLB) painted red on white, grey or black, either in any order. The share is then the excess of
/// red over green and blue. Notes and errors as above; it is also an error if the file has neither
/// weights nor colours.
Eigen::VectorXd read_paint(const std::filesystem::path& file, const TriMesh& scan,
                           std::vector<Note>& notes);

}  // namespace hyperex::tissue
