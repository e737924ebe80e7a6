// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/ct/itk_library.hpp"
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

}  // namespace

bool is_volume_file(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  return is_nifti(name) || is_nrrd(name);
}

Volume read_volume_file(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw InputError(file, "no such file");
  auto read =
      itk_library().read_volume(file.string(), is_nifti(lower_case(file.filename().string())));
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
  if (!(out.voxel_m3() > 0) || *std::min_element(out.size.begin(), out.size.end()) < 2)
    throw InputError(file, "expected steps above 0 and at least two values along each axis");
  out.hu = std::move(read->values);
  return out;
}

}  // namespace hyperex::ct
