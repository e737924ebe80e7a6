// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/reenact/performance.hpp"
#include "hyperex/report/displacement_modes.hpp"

namespace hyperex::report {

/// What the page shows. References must outlive the call.
struct ReportInput {
  const reenact::Performance& performance;
  const io::Scan& scan;
  /// Of performance.skin_displacement_m; its error and 1/65534 of each mode's largest component are
  /// the accuracy of the replay.
  const DisplacementModes& modes;
  const metrics::SymmetryCurve* symmetry = nullptr;  ///< its plots are left out where null
  nlohmann::json summary;                            ///< an object; shown as tables
  std::vector<std::string> notes;                    ///< warnings and remarks, a sentence each
  std::string title;
};

/// Writes one HTML file that replays the performance in a browser without any network: the page
/// built from web/ with a JSON manifest (see web/src/manifest.ts) and one base64 block of
/// little-endian arrays put into it. Throws InputError where the file cannot be written,
/// std::invalid_argument where performance, scan and modes do not belong together.
void write_html_report(const std::filesystem::path& file, const ReportInput& input);

}  // namespace hyperex::report
