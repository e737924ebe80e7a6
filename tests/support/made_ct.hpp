// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// CTs made by code from known surfaces, and DICOM files of them.
#include <filesystem>
#include <functional>
#include <string>

#include "hyperex/ct/volume.hpp"

namespace hyperex::test {

/// Signed distance (mm) of a place (mm, the frame of a face) from a surface, negative inside.
using Shape = std::function<double(const Vec3&)>;

Shape ball(const Vec3& middle_mm, double radius_mm);
Shape ellipsoid(const Vec3& middle_mm, const Vec3& radii_mm);  ///< to first order near the surface
Shape joined(const Shape& a, const Shape& b);
Shape without(const Shape& a, const Shape& b);
Shape box(const Vec3& low_mm, const Vec3& high_mm);
/// The front half of a ring in the plane y = middle.y, as a jaw is.
Shape half_ring(const Vec3& middle_mm, double radius_mm, double thickness_mm);

/// What a scanner shows: soft tissue of 40 HU within `skin`, bone of 1000 HU within `bone`, air of
/// -1000; edges blurred as by a point spread of 0.6 mm (standard deviation) and by the mean over a
/// voxel; noise.
struct MadeHead {
  Shape skin, bone;
  double noise_hu = 0;
  double hu(const Vec3& place_mm) const;  ///< without noise
};

/// Values at the grid's places. `turn`: rotation of the grid's axes; `middle_mm` is its centre. The
/// third index runs upwards where it is not turned.
ct::Volume volume_of(const MadeHead& head, const Vec3& middle_mm, const Vec3& size_mm,
                     const Vec3& spacing_mm,
                     const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());

/// What is to be written beside the pixels.
struct DicomTags {
  std::string patient = "Made^Up", patient_id = "ID-0001", birth_date = "19700101";
  std::string modality = "CT", series_uid = "1.2.3.4.5", study_uid = "1.2.3.4";
  int series_number = 1;
  double intercept = -1024, slope = 1;
  bool as_jpeg = false;  ///< lossless
};

/// Writes each plane of the third index as a file IM0001.dcm ..., in an order that is not that of
/// the planes. `prefix` begins the names.
void write_dicom(const std::filesystem::path& folder, const ct::Volume& volume,
                 const DicomTags& tags = {}, const std::string& prefix = "IM");

/// Writes the volume as NIfTI or NRRD, by the file's ending.
void write_volume(const std::filesystem::path& file, const ct::Volume& volume);

/// A head to try everything with: skin a ball of 48 mm with a nose and a chin, a skull with a
/// cavity, a mandible that touches it at both joints. Within 60 mm of the origin.
MadeHead small_head(double noise_hu = 30);
/// The bones of that head.
Shape small_skull();
Shape small_mandible();
Shape small_joints();  ///< thin bridges between the two, of bone's value

}  // namespace hyperex::test
