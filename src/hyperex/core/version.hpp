// SPDX-License-Identifier: GPL-3.0-or-later
// The version of Hyperex.
#pragma once

#include <string_view>

namespace hyperex {

/// The release, as in "1.0.0": the version of the project in the top CMakeLists.txt.
std::string_view version();

/// The commit that was built: 12 hexadecimal digits, followed by "+" where the tree had uncommitted
/// changes. Empty where the tree is no checkout of git, as in an archive of a release.
std::string_view commit();

}  // namespace hyperex
