// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/version.hpp"

#include "hyperex_commit.hpp"  // written by cmake/HyperexCommit.cmake

namespace hyperex {

std::string_view version() {
  return HYPEREX_VERSION;
}
std::string_view commit() {
  return HYPEREX_COMMIT;
}

}  // namespace hyperex
