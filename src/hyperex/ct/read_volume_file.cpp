// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
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

itk::ImageIOBase::Pointer reader_for(const std::string& name) {
  if (is_nifti(name)) return itk::NiftiImageIO::New().GetPointer();
  return itk::NrrdImageIO::New().GetPointer();
}

}  // namespace

bool is_volume_file(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  return is_nifti(name) || is_nrrd(name);
}

Volume read_volume_file(const fs::path& file) {
  itk::Object::GlobalWarningDisplayOff();  // they go to standard error
  using Image = itk::Image<float, 3>;
  auto reader = itk::ImageFileReader<Image>::New();
  reader->SetFileName(file.string());
  reader->SetImageIO(reader_for(lower_case(file.filename().string())));
  try {
    reader->Update();
  } catch (const itk::ExceptionObject&) {
    throw InputError(file, "damaged, cut off, or no NIfTI or NRRD file; expected a volume");
  }
  const Image& image = *reader->GetOutput();
  if (reader->GetImageIO()->GetNumberOfDimensions() != 3 ||
      reader->GetImageIO()->GetNumberOfComponents() != 1)
    throw InputError(file, "expected a volume with three axes and one value at each place");
  Volume out;
  Eigen::Matrix3d step_mm;
  for (unsigned a = 0; a < 3; ++a) {
    out.size[a] = int(image.GetLargestPossibleRegion().GetSize()[a]);
    for (unsigned r = 0; r < 3; ++r)
      step_mm(r, a) = image.GetDirection()[r][a] * image.GetSpacing()[a];
    out.origin_m[a] = image.GetOrigin()[a];
  }
  out.origin_m = face_from_patient() * out.origin_m * 1e-3;
  out.step_m = face_from_patient() * step_mm * 1e-3;
  if (!(out.voxel_m3() > 0) || *std::min_element(out.size.begin(), out.size.end()) < 2)
    throw InputError(file, "expected steps above 0 and at least two values along each axis");
  out.hu.assign(image.GetBufferPointer(), image.GetBufferPointer() + out.count());
  return out;
}

}  // namespace hyperex::ct
