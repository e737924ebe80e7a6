// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "hyperex/ct/ct_face.hpp"
#include "hyperex/io/scan.hpp"
#include "support/made_ct.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::ct {
namespace {
using testing::HasSubstr;

SeriesVolume series_of(double noise_hu = 30) {
  SeriesVolume out;
  out.volume =
      test::volume_of(test::small_head(noise_hu), {0, 0, 5}, {120, 130, 126}, {1.5, 1.5, 1.5});
  return out;
}

Volume labels_of(const Volume& volume) {
  Volume out = volume;
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i) {
        const Vec3 p = 1e3 * out.place(i, j, k);
        out.hu[out.at(i, j, k)] = test::small_mandible()(p) < 0 ? 5
                                  : test::small_skull()(p) < 0  ? 3
                                                                : 0;
      }
  return out;
}

double most_beside_mm(const TriMesh& mesh, const test::Shape& shape) {
  double out = 0;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    out = std::max(out, std::abs(shape(1e3 * mesh.points.row(v).transpose())));
  return out;
}

TEST(OwnBones, AreTakenFromLabels) {
  const TestFolder folder;
  const SeriesVolume series = series_of();
  test::write_volume(folder / "labels.nrrd", labels_of(series.volume));
  CtOptions options;
  options.own.labels = folder / "labels.nrrd";
  options.own.skull_label = 3, options.own.mandible_label = 5;
  const CtFace face = face_of_series(series, options);
  EXPECT_TRUE(face.own_bones);
  EXPECT_LT(most_beside_mm(face.bones.mandible, test::small_mandible()), 1.5);
  EXPECT_LT(
      most_beside_mm(face.bones.skull, test::joined(test::small_skull(), test::small_mandible())),
      2.5);
  options.own.skull_label = 9;
  EXPECT_THAT(test::refusal([&] { face_of_series(series, options); }),
              HasSubstr("the label 9 does not occur"));
}

TEST(OwnBones, AreTakenFromSurfacesOfThePatientOrTheFace) {
  const TestFolder folder;
  const SeriesVolume series = series_of();
  const CtFace ours = face_of_series(series);
  TriMesh patient = ours.bones.skull;
  patient.points = (patient.points * face_from_patient()).eval();
  io::write_ply(folder / "patient.ply", patient, io::LengthUnit::millimetre);
  TriMesh patient_jaw = ours.bones.mandible;
  patient_jaw.points = (patient_jaw.points * face_from_patient()).eval();
  io::write_ply(folder / "patient_jaw.ply", patient_jaw, io::LengthUnit::millimetre);
  io::write_ply(folder / "face.ply", ours.bones.skull, io::LengthUnit::millimetre);
  io::write_ply(folder / "jaw.ply", ours.bones.mandible, io::LengthUnit::millimetre);
  CtOptions options;
  options.own.skull = folder / "patient.ply", options.own.mandible = folder / "patient_jaw.ply";
  const CtFace of_patient = face_of_series(series, options);
  options.own.skull = folder / "face.ply", options.own.mandible = folder / "jaw.ply";
  options.own.frame = SurfaceFrame::face;
  const CtFace of_face = face_of_series(series, options);
  EXPECT_LT((of_patient.bones.skull.points - ours.bones.skull.points).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((of_face.bones.skull.points - ours.bones.skull.points).cwiseAbs().maxCoeff(), 1e-7);
  for (Eigen::Index v = 0; v < ours.skin.points.rows(); ++v)
    if (!std::isnan(ours.thickness.shortest_m[v])) {
      ASSERT_NEAR(of_face.thickness.shortest_m[v], ours.thickness.shortest_m[v], 1e-6);
    }
}

TEST(OwnBones, OfAnotherPlaceAreRefused) {
  const TestFolder folder;
  TriMesh away{Points(3, 3), Triangles(1, 3)};
  away.points << 1, 1, 1, 1.01, 1, 1, 1, 1.01, 1;
  away.triangles << 0, 1, 2;
  io::write_ply(folder / "away.ply", away, io::LengthUnit::millimetre);
  CtOptions options;
  options.own.skull = folder / "away.ply", options.own.mandible = folder / "away.ply";
  EXPECT_THAT(test::refusal([&] { face_of_series(series_of(), options); }),
              HasSubstr("0 % of the bone lies in the head's tissue"));
}

/// The head's middle is the origin of both frames: in the wrong one the bones still lie about
/// there.
TEST(OwnBones, OfACentredHeadInTheOtherFrameAreRefused) {
  const TestFolder folder;
  const SeriesVolume series = series_of();
  const CtFace ours = face_of_series(series);
  io::write_ply(folder / "skull.ply", ours.bones.skull, io::LengthUnit::millimetre);
  io::write_ply(folder / "jaw.ply", ours.bones.mandible, io::LengthUnit::millimetre);
  CtOptions options;
  options.own.skull = folder / "skull.ply", options.own.mandible = folder / "jaw.ply";
  EXPECT_THAT(test::refusal([&] { face_of_series(series, options); }),
              HasSubstr("of the bone lies in the head's tissue"));
  options.own.frame = SurfaceFrame::face;
  std::swap(options.own.skull, options.own.mandible);
  EXPECT_THAT(test::refusal([&] { face_of_series(series, options); }),
              HasSubstr("the mandible lies above the middle of the skull"));
}

TEST(OwnBones, OneOfTwoIsRefused) {
  const SeriesVolume series = series_of();
  CtOptions options;
  options.own.skull = "skull.ply";
  EXPECT_EQ(test::refusal([&] { face_of_series(series, options); }),
            "--skull alone: expected --mandible too");
  options.own.mandible = "jaw.ply", options.own.skull.clear();
  EXPECT_EQ(test::refusal([&] { face_of_series(series, options); }),
            "--mandible alone: expected --skull too");
}

}  // namespace
}  // namespace hyperex::ct
