// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/made_ct.hpp"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageWriter.h>
#include <gdcmTrace.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>

namespace hyperex::test {
namespace {
namespace fs = std::filesystem;

constexpr double kAir_hu = -1000, kSoft_hu = 40, kBone_hu = 1000, kBlur_mm = 0.6;

/// The share of what lies within, blurred: 1 deep inside.
double share_within(double distance_mm) {
  return 0.5 * std::erfc(distance_mm / (kBlur_mm * std::sqrt(2.0)));
}

/// The middle of part n of `count` of a voxel, from -0.5 to 0.5.
double part_of(int n, int count) {
  return (n + 0.5) / count - 0.5;
}

void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR::VRType kind,
         std::string value) {
  if (value.size() % 2 != 0) value += kind == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement one(gdcm::Tag(group, element));
  one.SetVR(kind);
  one.SetByteValue(value.data(), gdcm::VL(std::uint32_t(value.size())));
  data.Replace(one);
}

std::string numbers(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) {
    char text[32];
    std::snprintf(text, sizeof text, "%.8g", v);
    out += (out.empty() ? "" : "\\") + std::string(text);
  }
  return out;
}

void write_slice(const fs::path& file, const ct::Volume& volume, int plane, const DicomTags& tags) {
  gdcm::Trace::WarningOff();
  gdcm::ImageWriter writer;
  gdcm::Image& image = writer.GetImage();
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, unsigned(volume.size[0]));
  image.SetDimension(1, unsigned(volume.size[1]));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetPixelFormat(gdcm::PixelFormat::INT16);
  image.SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  image.SetIntercept(tags.intercept);
  image.SetSlope(tags.slope);
  const Eigen::Matrix3d patient_from_face = ct::face_from_patient().transpose();
  const Vec3 spacing = 1e3 * volume.spacing_m();
  const Eigen::Matrix3d way =
      patient_from_face * volume.step_m * volume.spacing_m().cwiseInverse().asDiagonal();
  const Vec3 at = 1e3 * patient_from_face * volume.place(0, 0, plane);
  image.SetSpacing(0, spacing.x());
  image.SetSpacing(1, spacing.y());
  for (unsigned a = 0; a < 3; ++a) image.SetOrigin(a, at[a]);
  const std::array<double, 6> cosines = {way(0, 0), way(1, 0), way(2, 0),
                                         way(0, 1), way(1, 1), way(2, 1)};
  image.SetDirectionCosines(cosines.data());
  std::vector<std::int16_t> pixels(std::size_t(volume.size[0]) * volume.size[1]);
  for (std::size_t p = 0; p < pixels.size(); ++p)
    pixels[p] = std::int16_t(
        std::lround((volume.hu[volume.at(0, 0, plane) + p] - tags.intercept) / tags.slope));
  gdcm::DataElement data(gdcm::Tag(0x7fe0, 0x0010));
  data.SetByteValue(reinterpret_cast<const char*>(pixels.data()),
                    gdcm::VL(std::uint32_t(2 * pixels.size())));
  image.SetDataElement(data);
  if (tags.as_jpeg) {
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(gdcm::TransferSyntax::JPEGLosslessProcess14_1);
    change.SetInput(image);
    if (!change.Change()) throw std::runtime_error("no JPEG can be made");
    writer.SetImage(change.GetOutput());
  }
  gdcm::DataSet& set = writer.GetFile().GetDataSet();
  const bool is_ct = tags.modality == "CT";
  put(set, 0x0008, 0x0008, gdcm::VR::CS, "ORIGINAL\\PRIMARY\\AXIAL");
  put(set, 0x0008, 0x0016, gdcm::VR::UI,
      is_ct ? "1.2.840.10008.5.1.4.1.1.2" : "1.2.840.10008.5.1.4.1.1.4");
  put(set, 0x0008, 0x0018, gdcm::VR::UI, tags.series_uid + "." + std::to_string(plane + 1));
  put(set, 0x0008, 0x0060, gdcm::VR::CS, tags.modality);
  put(set, 0x0010, 0x0010, gdcm::VR::PN, tags.patient);
  put(set, 0x0010, 0x0020, gdcm::VR::LO, tags.patient_id);
  put(set, 0x0010, 0x0030, gdcm::VR::DA, tags.birth_date);
  put(set, 0x0020, 0x000d, gdcm::VR::UI, tags.study_uid);
  put(set, 0x0020, 0x000e, gdcm::VR::UI, tags.series_uid);
  put(set, 0x0020, 0x0011, gdcm::VR::IS, std::to_string(tags.series_number));
  put(set, 0x0020, 0x0032, gdcm::VR::DS, numbers({at.x(), at.y(), at.z()}));
  put(set, 0x0020, 0x0037, gdcm::VR::DS,
      numbers({way(0, 0), way(1, 0), way(2, 0), way(0, 1), way(1, 1), way(2, 1)}));
  put(set, 0x0028, 0x0030, gdcm::VR::DS, numbers({spacing.y(), spacing.x()}));
  put(set, 0x0028, 0x1052, gdcm::VR::DS, numbers({tags.intercept}));
  put(set, 0x0028, 0x1053, gdcm::VR::DS, numbers({tags.slope}));
  writer.SetFileName(file.c_str());
  if (!writer.Write()) throw std::runtime_error("no DICOM file can be written");
}

}  // namespace

Shape ball(const Vec3& middle_mm, double radius_mm) {
  return [=](const Vec3& p) { return (p - middle_mm).norm() - radius_mm; };
}

Shape ellipsoid(const Vec3& middle_mm, const Vec3& radii_mm) {
  return [=](const Vec3& p) {
    const Vec3 q = (p - middle_mm).cwiseQuotient(radii_mm);
    const double slope = q.cwiseQuotient(radii_mm).norm();
    return slope < 1e-9 ? -radii_mm.minCoeff() : q.norm() * (q.norm() - 1) / slope;
  };
}

Shape joined(const Shape& a, const Shape& b) {
  return [=](const Vec3& p) { return std::min(a(p), b(p)); };
}

Shape without(const Shape& a, const Shape& b) {
  return [=](const Vec3& p) { return std::max(a(p), -b(p)); };
}

Shape box(const Vec3& low_mm, const Vec3& high_mm) {
  return [=](const Vec3& p) {
    const Vec3 out = (low_mm - p).cwiseMax(p - high_mm);
    return out.cwiseMax(0).norm() + std::min(0.0, out.maxCoeff());
  };
}

Shape half_ring(const Vec3& middle_mm, double radius_mm, double thickness_mm) {
  return [=](const Vec3& p) {
    Vec3 q = p - middle_mm;
    q.z() = std::max(q.z(), 0.0);
    const Vec3 flat(q.x(), 0, q.z());
    const Vec3 on =
        flat.norm() < 1e-9 ? Vec3(radius_mm, 0, 0) : Vec3(radius_mm * flat.normalized());
    return (p - middle_mm - on).norm() - thickness_mm / 2;
  };
}

double MadeHead::hu(const Vec3& place_mm) const {
  const double within = share_within(skin(place_mm)), bony = share_within(bone(place_mm));
  return kAir_hu + (kSoft_hu - kAir_hu) * within + (kBone_hu - kSoft_hu) * bony;
}

ct::Volume volume_of(const MadeHead& head, const Vec3& middle_mm, const Vec3& size_mm,
                     const Vec3& spacing_mm, const Eigen::Matrix3d& turn) {
  ct::Volume out;
  // Columns of an unturned grid: left, backwards, up, as in DICOM.
  out.step_m = turn * ct::face_from_patient() * (1e-3 * spacing_mm).asDiagonal();
  for (int a = 0; a < 3; ++a)
    out.size[std::size_t(a)] = int(std::lround(size_mm[a] / spacing_mm[a])) + 1;
  const Vec3 last(out.size[0] - 1, out.size[1] - 1, out.size[2] - 1);
  out.origin_m = 1e-3 * middle_mm - out.step_m * last / 2;
  out.hu.resize(out.count());
  // A voxel shows the mean over its own volume.
  std::array<int, 3> fine{};
  for (int a = 0; a < 3; ++a)
    fine[std::size_t(a)] = std::max(1, int(std::ceil(spacing_mm[a] - 1e-9)));
  tbb::parallel_for(0, out.size[2], [&](int k) {
    std::mt19937 random(unsigned(k) + 1);
    std::normal_distribution<double> noise(0, 1);
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i) {
        double sum = 0;
        for (int n = 0; n < fine[0] * fine[1] * fine[2]; ++n)
          sum += head.hu(1e3 * out.place(i + part_of(n % fine[0], fine[0]),
                                         j + part_of(n / fine[0] % fine[1], fine[1]),
                                         k + part_of(n / (fine[0] * fine[1]), fine[2])));
        out.hu[out.at(i, j, k)] = float(
            std::max(-1024.0, sum / (fine[0] * fine[1] * fine[2]) + head.noise_hu * noise(random)));
      }
  });
  return out;
}

void write_dicom(const fs::path& folder, const ct::Volume& volume, const DicomTags& tags,
                 const std::string& prefix) {
  fs::create_directories(folder);
  const int count = volume.size[2];
  for (int plane = 0; plane < count; ++plane) {
    // 7 has no factor in common with the counts in use, so that names are shuffled.
    char name[32];
    std::snprintf(name, sizeof name, "%04d.dcm",
                  count % 7 == 0 ? count - plane : (7 * plane) % count + 1);
    write_slice(folder / (prefix + name), volume, plane, tags);
  }
}

void write_volume(const fs::path& file, const ct::Volume& volume) {
  using Image = itk::Image<float, 3>;
  auto image = Image::New();
  Image::SizeType size;
  Image::SpacingType spacing;
  Image::PointType origin;
  Image::DirectionType direction;
  const Eigen::Matrix3d patient_from_face = ct::face_from_patient().transpose();
  const Vec3 at = 1e3 * patient_from_face * volume.origin_m;
  const Eigen::Matrix3d step = 1e3 * patient_from_face * volume.step_m;
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = itk::SizeValueType(volume.size[a]);
    spacing[a] = step.col(a).norm();
    origin[a] = at[a];
    for (unsigned r = 0; r < 3; ++r) direction[r][a] = step(r, a) / spacing[a];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->Allocate();
  std::copy(volume.hu.begin(), volume.hu.end(), image->GetBufferPointer());
  auto writer = itk::ImageFileWriter<Image>::New();
  writer->SetInput(image);
  writer->SetFileName(file.string());
  if (file.extension() == ".nrrd")
    writer->SetImageIO(itk::NrrdImageIO::New());
  else
    writer->SetImageIO(itk::NiftiImageIO::New());
  writer->Update();
}

Shape small_skull() {
  return joined(without(ellipsoid({0, 12, -6}, {36, 34, 40}), ellipsoid({0, 14, -8}, {29, 27, 32})),
                box({-12, -22, 8}, {12, -10, 34}));
}

Shape small_mandible() {
  const Shape bow = half_ring({0, -34, 0}, 32, 10);
  const Shape right = box({-35, -36, -6}, {-29, -10, 3}), left = box({29, -36, -6}, {35, -10, 3});
  return joined(bow, joined(right, left));
}

Shape small_joints() {
  return joined(box({-32.7, -11, -1.7}, {-31.3, 0, -0.3}), box({31.3, -11, -1.7}, {32.7, 0, -0.3}));
}

MadeHead small_head(double noise_hu) {
  const Shape skull_skin = ellipsoid({0, 10, -5}, {44, 42, 48}),
              jaw = ellipsoid({0, -26, 6}, {43, 24, 38}),
              nose = ellipsoid({1, -8, 44}, {8, 12, 12}), chin = ball({1, -36, 36}, 10);
  return {joined(joined(skull_skin, jaw), joined(nose, chin)),
          joined(joined(small_skull(), small_mandible()), small_joints()), noise_hu};
}

}  // namespace hyperex::test
