// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// A recording of markers as motion laboratories keep it (Motion Analysis' TRC, as documented by
/// OpenSim): tab-separated text, five header lines, then a line per frame.
struct TrcFile {
  LengthUnit unit = LengthUnit::millimetre;  ///< of the file; positions are metres
  double data_rate_hz = 0;
  std::vector<std::string> names;
  std::vector<double> time_s;     ///< increasing
  std::vector<int> lines;         ///< of the file, of each frame; not written
  std::vector<Points> positions;  ///< a frame each: |names| x 3, metres; NaN where a marker is lost
};

/// Throws InputError: a header line missing or not understood, a unit that is not mm, cm or m,
/// fewer or more names or frames than the header says, a name twice, a cell that is no finite
/// number, a marker with only some of its three coordinates, times that do not increase.
TrcFile read_trc(const std::filesystem::path& file);

/// Lost markers (any coordinate NaN) become empty cells. Numbers have 10 digits.
void write_trc(const std::filesystem::path& file, const TrcFile& recording);

}  // namespace hyperex::io
