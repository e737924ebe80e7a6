// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

struct SeriesChoice {
  std::optional<int> number;  ///< of the series that are listed where there are several, from 1
};

/// A volume and what is to be said of it. Nothing here names the patient: neither names nor
/// identifiers nor the paths of files.
struct SeriesVolume {
  Volume volume;
  std::string kind;     ///< "DICOM", "NIfTI" or "NRRD"
  std::string shown;    ///< the source as messages name it
  double tilt_deg = 0;  ///< of the gantry; the steps of the volume hold it
  std::vector<std::string> notes;
};

/// Reads a folder of DICOM files (below it, too), a zip of one, or a NIfTI or NRRD file. Files that
/// are no DICOM are passed over, and so are survey pictures (localizers). Throws InputError in one
/// sentence: no such place, nothing in it that is a CT, several series and none chosen, a missing
/// slice (order_slices.hpp), a damaged file. A file is named unless its name holds a word of the
/// patient's name or number; then it is counted.
SeriesVolume read_series(const std::filesystem::path& source, const SeriesChoice& choice = {});

/// A NIfTI or NRRD volume of any values, in the frame of a face: a CT or labels.
Volume read_volume_file(const std::filesystem::path& file);

/// Whether the name ends as those of NIfTI and NRRD files do.
bool is_volume_file(const std::filesystem::path& file);

}  // namespace hyperex::ct
