// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// A recording of markers in the TRC format of motion laboratories (Motion Analysis, as documented
/// by OpenSim): tab-separated text with five header lines, then one line per frame.
struct TrcFile {
  LengthUnit unit = LengthUnit::millimetre;  ///< unit in the file; positions here are in metres
  double data_rate_hz = 0;
  std::vector<std::string> names;
  std::vector<double> time_s;  ///< strictly increasing
  std::vector<int> lines;      ///< line number of each frame in the file; not written
  /// One entry per frame: |names| x 3, metres; NaN for a lost marker.
  std::vector<Points> positions;
};

/// Throws InputError if a header line is missing or invalid, if the unit is not mm, cm or m, if the
/// number of names or frames differs from the header, if a name occurs twice, if a cell is not a
/// finite number, if only some of a marker's three coordinates are given, or if times do not
/// increase.
TrcFile read_trc(const std::filesystem::path& file);

/// Lost markers (any coordinate NaN) are written as empty cells. Numbers have 10 digits.
void write_trc(const std::filesystem::path& file, const TrcFile& recording);

}  // namespace hyperex::io
