// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// A place farther than this from the surface is not on the scan.
inline constexpr double kOffScan_m = 0.015;

/// The least nose_before_plane() of a face. Measured: 0.31 to 0.52 on six people, three of them
/// real; 0.44 on the canonical face.
inline constexpr double kFlattestNose = 0.15;

/// How far the tip of the nose stands before the plane of the corners of eyes and mouth, in parts
/// of the distance between the outer corners of the eyes. The plane passes midway between the
/// corners of the mouth, and is that of x and y of face::face_frame_of_corners. Nothing where one
/// of the five places is not known.
std::optional<double> nose_before_plane(const io::Landmarks& landmarks);

/// A sentence where a scan shows half of a face; else nothing. `given`: the landmarks that a person
/// set or the program found on the scan; `all`: with those that complete_landmarks added; m. By the
/// landmarks of one side and of the midline, the canonical face is laid on the scan. At most 10 %
/// of the places that it names on this side lie farther than kOffScan_m from the scan, and more
/// than 60 % of those on the other side. This takes four places well off one line. By 4 to 12
/// landmarks drawn from those of seven scans, 7,500 times, the other side's share was at most 38 %.
/// On these scans cut along the midline it was above 60 % in 99.9 %. Scans whose
/// nose_before_plane() is below 0.3 are not judged: half a face laid on a shallow scan turns, so
/// that the other half leaves it.
std::optional<std::string> half_missing(const io::Landmarks& given, const io::Landmarks& all,
                                        const TriMesh& scan);

/// `scan.flat`: flat_problem(), as a warning.
std::optional<Note> flat_warning(const io::Landmarks& landmarks);

/// A sentence where landmarks of one side, two or more and at least 60 % of those given, lie
/// farther than kOffScan_m from the scan, and all others lie on it; else nothing. The other side
/// has two or more. `off_m`: each given landmark's distance from the scan.
std::optional<std::string> half_missing_problem(const std::map<std::string, double>& off_m);

/// The sentence of `scan.flat`; nothing where nose_before_plane() is unknown or kFlattestNose or
/// more.
std::optional<std::string> flat_problem(const io::Landmarks& landmarks);

}  // namespace hyperex::anatomy
