// SPDX-License-Identifier: GPL-3.0-or-later
// What `hyperex compare` reads.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::cli {

struct CompareOptions {
  std::filesystem::path a, b, landmarks, rest, picture;
  bool corresponding = false, json = false, baseline = false;
  std::string unit;
};

struct ComparedSurfaces {
  TriMesh a, b, rest;       ///< rest: that of --rest, else a
  Eigen::Index scored = 0;  ///< the first n vertices of a
  std::vector<std::string> notes;
};

/// Throws InputError: surfaces of quite different size, or vertices that cannot correspond.
ComparedSurfaces read_surfaces(const CompareOptions& options);

}  // namespace hyperex::cli
