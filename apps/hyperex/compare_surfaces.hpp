// SPDX-License-Identifier: GPL-3.0-or-later
// The input of `hyperex compare`.
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
  TriMesh a, b, rest;       ///< rest: the surface given by --rest, or `a` without it
  Eigen::Index scored = 0;  ///< number of vertices at the beginning of `a` that are compared
  std::vector<std::string> notes;
};

/// Throws InputError if the sizes of the surfaces differ too much, or if their vertices cannot
/// correspond.
ComparedSurfaces read_surfaces(const CompareOptions& options);

}  // namespace hyperex::cli
