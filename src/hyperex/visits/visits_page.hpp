// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/visits/compare_visits.hpp"

namespace hyperex::visits {

/// Writes one HTML file that needs no network: what changed, the face at each visit, the curves of
/// the corners of the mouth and the table of measures. It prints on one page of A4. Its manifest is
/// described in web/src/visits/manifest.ts. Throws InputError where the file cannot be written.
void write_visits_page(const std::filesystem::path& file, const Comparison& comparison);

}  // namespace hyperex::visits
