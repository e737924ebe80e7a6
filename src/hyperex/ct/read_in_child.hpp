// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Some damaged files end the process in which GDCM or ITK reads them: they reach assertions, and
// places beyond an array. So these are read by a child process, whose end is the file's fault.
#include <optional>
#include <string>

#include "hyperex/ct/itk_library.hpp"

namespace hyperex::ct {

/// ItkLibrary::pixels_of(), for compressed slices.
std::optional<DicomPixels> pixels_in_child(const std::string& bytes);
/// ItkLibrary::read_volume().
std::optional<ItkVolume> volume_in_child(const std::string& file, bool nifti);

}  // namespace hyperex::ct
