// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::python {

/// A scan and its landmarks, completed: what a simulation begins with.
struct Face {
  io::Scan scan;
  io::Landmarks landmarks;
  std::vector<std::string> placed;  ///< landmarks that were not given
};

using SharedTissueMesh = std::shared_ptr<tissue::TissueMesh>;

}  // namespace hyperex::python
