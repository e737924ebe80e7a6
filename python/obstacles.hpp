// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/simulate/contact/obstacles.hpp"

namespace hyperex::python {

/// Obstacles for contact, as Python passes them on.
struct Obstacles {
  std::shared_ptr<const std::vector<simulate::Obstacle>> all;  ///< null: nothing
};

}  // namespace hyperex::python
