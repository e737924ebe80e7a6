// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/io/scan.hpp"
#include "hyperex/visits/expression_peak.hpp"

namespace hyperex::visits {

/// A scan of the face on that day.
struct VisitScan {
  std::filesystem::path file;
  std::filesystem::path landmarks;  ///< empty: they are found on the scan
};

/// One appointment: what was recorded on that day.
struct VisitEntry {
  std::string label;                              ///< its date, or another name
  std::string note;                               ///< "before injection"; may be empty
  std::vector<std::filesystem::path> recordings;  ///< one or more repetitions of the expression
  std::optional<VisitScan> rest_scan = {};        ///< relaxed
  std::optional<VisitScan> peak_scan = {};        ///< in the expression
  /// Standard deviation of a recorded coordinate where the user states it, m.
  std::optional<double> jitter_m;
  /// Samples after this time are left out, s.
  double end_s = std::numeric_limits<double>::infinity();
};

/// The content of a file of visits.
struct VisitsFile {
  std::filesystem::path file;
  std::string patient;  ///< a label; may be empty
  Expression expression;
  /// 95 % of the differences between two performances of the expression by one person are below
  /// this, m; nothing: the default, or measured where visits have several recordings.
  std::optional<double> repetition_m;
  std::optional<io::LengthUnit> unit;     ///< of recordings that do not state theirs, and of scans
  std::vector<std::string> rigid_points;  ///< as motion.rigid_points of a scene; may be empty
  std::vector<VisitEntry> visits;         ///< one or more, by date where all have one
  std::string order_remark;               ///< a sentence on their order; may be empty
};

/// Whether a visit has scans.
bool has_scans(const VisitsFile& file);

/// Reads TOML:
///   patient = "P-017"
///   expression = "smile"
///   [[visit]]
///   date = 2026-03-01
///   recordings = ["first.csv", "second.csv"]
///   rest_scan = "neutral.ply"
/// Paths are relative to the file. Visits are sorted by date (visit_dates.hpp). Throws InputError
/// with a line for each mistake.
VisitsFile read_visits(const std::filesystem::path& file);

}  // namespace hyperex::visits
