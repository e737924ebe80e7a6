// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From the places that slices state to the steps of a grid.
#include <string>
#include <vector>

#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

/// What a slice says of its place; DICOM's patient frame, millimetres.
struct SlicePlace {
  Vec3 first_mm = Vec3::Zero();  ///< the centre of the first pixel (ImagePositionPatient)
  Vec3 along_row = Vec3::UnitX(), along_column = Vec3::UnitY();  ///< ImageOrientationPatient
  double row_step_mm = 0;                                        ///< between the pixels of a row
  double column_step_mm = 0;                                     ///< between rows
  int columns = 0, rows = 0;
};

struct SliceStack {
  std::vector<std::size_t> order;  ///< indices of the slices along the normal of their planes
  Volume grid;                     ///< without values
  double tilt_deg = 0;             ///< between the way from slice to slice and the normal
};

constexpr int kLeastSlices = 8;

/// Throws InputError, beginning with `source`, where the slices are no stack: too few, of different
/// sizes or directions, one missing, two at one place, unevenly far apart, or not in one line. The
/// sentence gives the place in mm along the axis of the patient that the stack runs along.
SliceStack order_slices(const std::vector<SlicePlace>& slices, const std::string& source);

}  // namespace hyperex::ct
