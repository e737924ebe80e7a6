// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/ct/read_in_child.hpp"
#include "hyperex/ct/read_series.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

bool is_nifti(const std::string& name) {
  return name.ends_with(".nii") || name.ends_with(".nii.gz");
}
bool is_nrrd(const std::string& name) {
  return name.ends_with(".nrrd") || name.ends_with(".nhdr");
}

/// ITK copies these lines into arrays of about 800 bytes. Remarks and values of keys may be long.
constexpr std::size_t kLongestLine = 600;

void check_header_lines(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (int number = 1; std::getline(in, line) && !line.empty() && line != "\r"; ++number)
    if (line.size() > kLongestLine && !line.starts_with('#') && line.find(":=") >= line.find(": "))
      throw InputError({file, number, "", std::to_string(line.size()) + " characters",
                        fmt::format("a line of an NRRD header, of at most {}", kLongestLine)});
}

}  // namespace

bool is_volume_file(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  return is_nifti(name) || is_nrrd(name);
}

Volume read_volume_file(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw InputError(file, "no such file");
  const bool nifti = is_nifti(lower_case(file.filename().string()));
  if (!nifti) check_header_lines(file);
  auto read = volume_in_child(file.string(), nifti);
  if (!read)
    throw InputError(file, "damaged, cut off, or no NIfTI or NRRD file; expected a volume");
  if (read->dimensions != 3 || read->components != 1)
    throw InputError(file, "expected a volume with three axes and one value at each place");
  Volume out;
  out.size = read->grid.size;
  Eigen::Matrix3d step_mm;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t r = 0; r < 3; ++r)
      step_mm(Eigen::Index(r), Eigen::Index(a)) = read->direction[r][a] * read->grid.spacing_mm[a];
  out.origin_m = face_from_patient() * Eigen::Map<const Vec3>(read->origin_mm.data()) * 1e-3;
  out.step_m = face_from_patient() * step_mm * 1e-3;
  if (!out.is_possible() || *std::min_element(out.size.begin(), out.size.end()) < 2)
    throw InputError(file,
                     "states an impossible place or steps; expected steps of 0.01 to 100 mm, no "
                     "more than 5 m in all, and at least two values along each axis");
  out.hu = std::move(read->values);
  return out;
}

}  // namespace hyperex::ct
