// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the module: whether a DICOM file is whole. Debian's GDCM ends the program where a
// file is cut within its header, and fills a cut picture without a word.
#include <string>
#include <string_view>

namespace hyperex::ct {

/// Whether the bytes begin as those of a DICOM file do: "DICM" after 128 bytes.
bool begins_as_dicom(std::string_view bytes);

/// Walks through the elements of the file, those within sequences too (DICOM PS3.5, 7.1 and 7.5),
/// and returns what is wrong with it: "" where every element lies within the file. Values are not
/// looked at, that of the transfer syntax excepted.
std::string fault_of_dicom(std::string_view bytes);

/// The bytes without zeros behind the last element, at which GDCM ends the program.
std::string without_padding(std::string bytes);

}  // namespace hyperex::ct
