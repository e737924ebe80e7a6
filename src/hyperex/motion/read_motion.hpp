// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "hyperex/io/scan.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// Reads named points over time. The extension decides the format (C3D is refused with advice):
///  .trc  markers of a motion laboratory, in the unit that the file states;
///  .csv  a column of time (time_s, time or timestamp; seconds) and three columns a point, either
///        NAME_x, NAME_y, NAME_z, each with an optional unit (NAME_x_mm, _cm, _m), or x0, y0, z0,
///        x1 ... (68 of those are ibug68_0 ... ibug68_67, otherwise point_0 ...). A column named
///        frame is ignored. Empty cells and "nan" are gaps.
/// The unit of a CSV is that of its columns, else `unit`, else the one at the end of the file's
/// name (..._mm.csv), else guessed: the points of a face span 5 to 45 cm. Motion::unit_note states
/// the unit and its origin. Throws InputError where there are no samples or no points, a time is
/// NaN or does not rise, a name occurs twice, a point lacks one of its three columns, the columns
/// state another unit than `unit`, or the span is implausible.
Motion read_motion(const std::filesystem::path& file,
                   std::optional<io::LengthUnit> unit = std::nullopt);

/// Columns time_s, NAME_x_mm, NAME_y_mm, NAME_z_mm ...; millimetres; "nan" where not measured.
void write_motion_csv(const std::filesystem::path& file, const Motion& motion);

}  // namespace hyperex::motion
