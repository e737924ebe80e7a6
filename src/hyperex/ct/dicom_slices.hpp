// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the module: the headers of DICOM files.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "hyperex/ct/order_slices.hpp"

namespace hyperex::ct {

struct DicomSlice {
  std::filesystem::path file;
  std::string name;    ///< for messages: the file's, or its number where that names the patient
  std::string series;  ///< only to be compared
  int series_number = 0;
  std::string modality;
  bool other = false;   ///< no picture of any kind
  bool survey = false;  ///< a localizer
  bool compressed = false;
  std::string fault;  ///< why it cannot be used; empty where it can
  SlicePlace place;
};

struct DicomFolder {
  std::vector<DicomSlice> slices;
  int other_files = 0;                       ///< that are no DICOM
  int pictures = 0;                          ///< of those, JPEG, PNG and the like
  std::set<std::string> private_words = {};  ///< of patients and studies, lower case
  /// A path as messages may name it: "the series" where it holds a private word.
  std::string shown(const std::filesystem::path& path) const;
};

/// Reads the headers of all files in `folder` and below, in the order of their names.
DicomFolder read_dicom_headers(const std::filesystem::path& folder);

/// The values of one slice in Hounsfield units. Throws InputError naming the file where it is
/// damaged or of another size than its header states.
void read_pixels(const DicomSlice& slice, float* to);

}  // namespace hyperex::ct
