// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/error.hpp"

namespace hyperex::test {

/// The message of the error that `act` throws; "" where it throws none.
template <class Error = InputError, class Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace hyperex::test
