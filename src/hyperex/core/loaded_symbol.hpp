// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <dlfcn.h>

namespace hyperex {

/// A function of a library that may or may not be in this process; null where it is not.
template <class Function>
Function loaded_symbol(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

}  // namespace hyperex
