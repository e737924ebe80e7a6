// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// toml++ 3.3 asserts (with NDEBUG: may let the compiler assume) what a torn file like "[=" does not
// keep, just before it checks the same properly. Leave it the check alone.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
