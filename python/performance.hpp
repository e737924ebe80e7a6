// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "bind.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::python {

/// The results of a run, with NumPy arrays that are created at the first access.
struct RunResult {
  simulate::SimulationResult result;
  std::shared_ptr<const tissue::TissueMesh> mesh;
  py::object skin_stack, node_stack;  ///< null until then

  const simulate::Performance& performance() const { return result.performance; }
};

}  // namespace hyperex::python
