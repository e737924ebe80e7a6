// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/error.hpp"

namespace hyperex::python {

/// An argument that cannot be taken, as one line: "KEY = VALUE: expected EXPECTED".
[[noreturn]] inline void refuse(const std::string& key, const std::string& value,
                                const std::string& expected) {
  throw InputError(InputProblem{{}, 0, key, value, expected});
}

}  // namespace hyperex::python
