// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "hyperex/io/scan.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// Reads named points over time, by extension (C3D is refused with advice):
///  .trc  markers of a motion laboratory, the unit as the file says;
///  .csv  a column of time (time_s, time or timestamp; seconds) and three columns a point, either
///        NAME_x, NAME_y, NAME_z, each with an optional unit (NAME_x_mm, _cm, _m), or x0, y0, z0,
///        x1 ... (68 of those are ibug68_0 ... ibug68_67, otherwise point_0 ...). A column named
///        frame is passed over. Empty cells and "nan" are gaps.
/// The unit of a CSV is that of its columns, else `unit`, else the end of the file's name
/// (..._mm.csv), else guessed: the points of a face span 5 to 45 cm. Motion::unit_note says which.
/// Throws InputError: no samples, no points, time that is NaN or does not rise, a name twice, a
/// point without all three columns, columns in another unit than `unit`, an implausible span.
Motion read_motion(const std::filesystem::path& file,
                   std::optional<io::LengthUnit> unit = std::nullopt);

/// time_s, NAME_x_mm, NAME_y_mm, NAME_z_mm ...; millimetres; "nan" where not measured.
void write_motion_csv(const std::filesystem::path& file, const Motion& motion);

}  // namespace hyperex::motion
