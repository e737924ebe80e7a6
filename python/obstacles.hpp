// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/simulate/contact/obstacles.hpp"

namespace hyperex::python {

/// What tissue may touch, as Python hands it on.
struct Obstacles {
  std::shared_ptr<const std::vector<simulate::Obstacle>> all;  ///< null: nothing
};

}  // namespace hyperex::python
