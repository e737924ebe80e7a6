// SPDX-License-Identifier: GPL-3.0-or-later
// Every field of the structs, written by hand: if a table swapped two fields in both setter and
// getter, a test that used only the table would pass.
#include <gmock/gmock.h>

#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {
using testing::ElementsAre;

TEST(SceneFields, EachHoldsItsOwnKeyInSiUnits) {
  const SceneFolder folder;
  const Scene s = read_scene(folder.write("scene.toml", R"(
title = "All of it"
[scan]
file = "face.ply"
unit = "cm"
landmarks = "points.json"
landmarks_unit = "m"
[motion]
file = "motion.csv"
unit = "mm"
candide = "points.json"
mirrored = true
rest_s = [0.21, 0.22]
rigid_points = ["r1", "r2", "r3"]
max_gap_s = 0.31
gain = 1.32
time_scale = 2.5
[[motion.point_gain]]
point = "p1"
gain = 1.7
[alignment]
method = "similarity"
[region]
measured = "points"
measured_points = ["m1"]
measured_radius_mm = 33
blend_mm = 34
[mesh]
element_size_mm = 3.5
layers = 6
thickness_mm = 0
cut_lips = "never"
trim_border_mm = 37
thickness_per_vertex = "points.json"
[[mesh.thickness_point]]
landmark = "gonion_L"
thickness_mm = 11
[[mesh.thickness_point]]
thickness_mm = 9
landmark = "menton"
[[mesh.thickness_region]]
painted = "motion.csv"
thickness_mm = 12.5
[tissue]
young_kpa = 38.5
poisson = 0.39
viscosity_pa_s = 40
density_kg_m3 = 941
element = "tet4"
strain = "finite"
law = "yeoh"
yeoh_c20 = 0.61
yeoh_c30 = 0.62
mooney_c01 = 0.63
maxwell = [{ ratio = 0.64, relaxation_s = 0.65 }]
preset = "granite"
interpolation = "linear"
mirror = true
per_vertex = "points.json"
[[tissue.layer]]
name = "skin"
thickness_mm = 1.5
young_kpa = 106
viscosity_factor = 1.6
poisson_factor = 0.7
density_kg_m3 = 1003
[[tissue.layer]]
name = "deep"
young_factor = 0.25
viscosity_pa_s = 107
poisson = 0.43
density_factor = 3
[[tissue.point]]
landmark = "cheek"
side = "R"
young_kpa = 101
viscosity_pa_s = 102
poisson = 0.41
density_kg_m3 = 1001
[[tissue.point]]
landmark = "chin"
viscosity_pa_s = 103
[[tissue.region]]
name = "nose"
blend_mm = 2.5
young_kpa = 104
viscosity_factor = 1.5
poisson_factor = 0.5
density_factor = 2
[[tissue.region]]
scar = ["a", "b"]
width_mm = 3.5
young_factor = 3
[[tissue.region]]
scar_points_mm = [[1, 2, 3], [4, 5, 6]]
viscosity_pa_s = 105
poisson = 0.42
density_kg_m3 = 1002
[support]
border = "free"
skull = "held"
skull_across_kpa_per_mm = 51
skull_along_kpa_per_mm = 52
mandible = "free"
mandible_across_kpa_per_mm = 53
mandible_along_kpa_per_mm = 54
field_kpa_per_mm = 57
jaw_points = ["j1"]
[drive]
points = ["d1", "d2"]
patch_radius_mm = 4.2
still_points = ["s1"]
[contact]
eyes = true
[solver]
method = "direct"
tolerance = 0.004
finite_step_s = 0.041
finite_tolerance = 0.042
full_newton = true
newmark_beta = 0.36
newmark_gamma = 0.7
verify = true
[time]
step_s = 0.0043
end_s = 4.4
frame_rate_hz = 45
[output]
peak_time_s = 4.6
vtu = false
glb = true
report = false
symmetry_floor = 4.7e-5
lowpass_hz = 7.5
jitter_mm = 0.3
picture_times_s = [0.48, 0.49]
)"));
  EXPECT_EQ(s.title, "All of it");
  EXPECT_FALSE(s.scan.source.embedded);
  EXPECT_EQ(s.scan.source.file, folder / "face.ply");
  EXPECT_EQ(s.scan.unit, io::LengthUnit::centimetre);
  EXPECT_EQ(s.scan.landmarks, folder / "points.json");
  EXPECT_EQ(s.scan.landmarks_unit, io::LengthUnit::metre);
  EXPECT_EQ(s.motion.source.file, folder / "motion.csv");
  EXPECT_EQ(s.motion.unit, io::LengthUnit::millimetre);
  EXPECT_EQ(s.motion.candide, folder / "points.json");
  const std::string other = folder.write("other.csv", "").string();
  EXPECT_EQ(read_scene(s.file, {"motion.openface=" + other}).motion.openface, other);
  EXPECT_EQ(read_scene(s.file, {"motion.recording=" + (folder / "sub").string()}).motion.recording,
            folder / "sub");
  EXPECT_EQ(read_scene(s.file, {"motion.arkit=" + other}).motion.arkit, other);
  EXPECT_THAT(s.motion.rigid_points, ElementsAre("r1", "r2", "r3"));
  EXPECT_TRUE(s.motion.mirrored);
  EXPECT_THAT(s.motion.rest_s, ElementsAre(0.21, 0.22));
  EXPECT_THAT(read_scene(s.file, {"motion.rest_s=1.5"}).motion.rest_s, ElementsAre(1.5));
  EXPECT_EQ(s.motion.max_gap_s, 0.31);
  EXPECT_EQ(s.drive.gain, 1.32);
  EXPECT_EQ(s.motion.time_scale, 2.5);
  ASSERT_EQ(s.motion.point_gains.size(), 1u);
  EXPECT_EQ(s.motion.point_gains[0].point, "p1");
  EXPECT_EQ(s.motion.point_gains[0].gain, 1.7);
  EXPECT_EQ(s.alignment.method, simulate::AlignmentMethod::similarity);
  EXPECT_EQ(s.region.measured, simulate::Measured::points);
  EXPECT_THAT(s.region.measured_points, ElementsAre("m1"));
  EXPECT_EQ(s.region.measured_radius_m, 0.033);
  EXPECT_EQ(s.region.blend_m, 0.034);
  EXPECT_EQ(s.mesh.element_size_m, 0.0035);
  EXPECT_EQ(s.mesh.layers, 6);
  EXPECT_EQ(s.mesh.thickness_m, 0);
  EXPECT_EQ(s.mesh.cut_lips, tissue::LipCut::never);
  EXPECT_EQ(s.mesh.trim_border_m, 0.037);
  ASSERT_EQ(s.mesh.depths.size(), 2u);
  EXPECT_EQ(s.mesh.depths[0].landmark, "gonion_L");
  EXPECT_EQ(s.mesh.depths[0].depth_m, 0.011);
  EXPECT_EQ(s.mesh.depths[1].landmark, "menton");
  EXPECT_EQ(s.mesh.depths[1].depth_m, 0.009);
  EXPECT_EQ(s.mesh.depth_per_vertex, folder / "points.json");
  ASSERT_EQ(s.mesh.depth_regions.size(), 1u);
  EXPECT_EQ(s.mesh.depth_regions[0].painted, folder / "motion.csv");
  EXPECT_EQ(s.mesh.depth_regions[0].depth_m, 0.0125);
  EXPECT_EQ(s.tissue.uniform[tissue::young], 38500);
  EXPECT_EQ(s.tissue.uniform[tissue::poisson], 0.39);
  EXPECT_EQ(s.tissue.uniform[tissue::viscosity], 40);
  EXPECT_EQ(s.tissue.uniform[tissue::density], 941);
  EXPECT_EQ(read_scene(s.file, {"tissue.strain=linear", "tissue.viscous_form=printed"})
                .model.viscous_form,
            fem::ViscousForm::printed);
  EXPECT_EQ(s.model.strain, simulate::Strain::finite);
  EXPECT_EQ(s.model.law, (fem::Hyperelastic{.law = fem::HyperelasticLaw::yeoh,
                                            .c20 = 0.61,
                                            .c30 = 0.62,
                                            .c01 = 0.63,
                                            .branches = {{0.64, 0.65}}}));
  EXPECT_EQ(s.model.element, fem::ElementKind::tet4);
  EXPECT_EQ(s.tissue.preset, "granite");
  EXPECT_EQ(s.tissue.interpolation, tissue::Interpolation::linear);
  EXPECT_TRUE(s.tissue.mirror);
  EXPECT_EQ(s.tissue.per_vertex, folder / "points.json");
  using Given = tissue::GivenParameters;  // young, viscosity, poisson, density
  const std::vector<tissue::TissuePoint> points = {{"cheek", "R", Given{101e3, 102, 0.41, 1001}},
                                                   {"chin", "", Given{std::nullopt, 103}}};
  EXPECT_EQ(s.tissue.points, points);
  const std::vector<tissue::TissueLayer> layers = {
      {.name = "skin",
       .thickness_m = 0.0015,
       .value = {106e3, std::nullopt, std::nullopt, 1003},
       .factor = {std::nullopt, 1.6, 0.7}},
      {.name = "deep",
       .value = {std::nullopt, 107, 0.43},
       .factor = {0.25, std::nullopt, std::nullopt, 3}}};
  EXPECT_EQ(s.tissue.layers, layers);
  const std::vector<tissue::TissueRegion> regions = {
      {.name = "nose", .blend_m = 0.0025, .value = {104e3}, .factor = {std::nullopt, 1.5, 0.5, 2}},
      {.scar = {"a", "b"}, .width_m = 0.0035, .factor = {3}},
      {.scar_points_m = {{0.001, 0.002, 0.003}, {0.004, 0.005, 0.006}},
       .value = {std::nullopt, 105, 0.42, 1002}}};
  EXPECT_EQ(s.tissue.regions, regions);
  EXPECT_EQ(s.solver.method, simulate::SolverMethod::direct);
  EXPECT_EQ(s.solver.tolerance, 0.004);
  EXPECT_EQ(s.solver.newmark_beta, 0.36);
  EXPECT_EQ(s.solver.newmark_gamma, 0.7);
  EXPECT_TRUE(s.solver.verify);
  EXPECT_EQ(s.solver.finite_step_s, 0.041);
  EXPECT_EQ(s.solver.finite_tolerance, 0.042);
  EXPECT_TRUE(s.solver.full_newton);
  EXPECT_TRUE(s.contact.eyes);
  EXPECT_FALSE(s.contact.lips || s.contact.teeth);
  EXPECT_FALSE(s.support.border_held);
  EXPECT_EQ(s.support.skull, simulate::Hold::held);
  EXPECT_EQ(s.support.skull_layer.across_pa_per_m, 51e6);
  EXPECT_EQ(s.support.skull_layer.along_pa_per_m, 52e6);
  EXPECT_EQ(s.support.mandible, simulate::Mandible::free);
  EXPECT_EQ(s.support.mandible_layer.across_pa_per_m, 53e6);
  EXPECT_EQ(s.support.mandible_layer.along_pa_per_m, 54e6);
  EXPECT_EQ(s.support.field_pa_per_m, 57e6);
  EXPECT_THAT(s.support.jaw_points, ElementsAre("j1"));
  EXPECT_FALSE(s.drive.all_points);
  EXPECT_THAT(s.drive.points, ElementsAre("d1", "d2"));
  EXPECT_DOUBLE_EQ(s.drive.patch_radius_m, 0.0042);
  EXPECT_THAT(s.drive.still_points, ElementsAre("s1"));
  EXPECT_EQ(s.time.step_s, 0.0043);
  EXPECT_EQ(s.time.end_s, 4.4);
  EXPECT_EQ(s.time.frame_rate_hz, 45);
  EXPECT_EQ(s.time.peak_time_s, 4.6);
  EXPECT_FALSE(s.output.vtu);
  EXPECT_TRUE(s.output.glb);
  EXPECT_FALSE(s.output.report);
  EXPECT_EQ(s.output.symmetry_floor, 4.7e-5);
  EXPECT_EQ(s.output.lowpass_hz, 7.5);
  EXPECT_EQ(s.output.jitter_m, 0.0003);
  EXPECT_THAT(s.time.still_times_s, ElementsAre(0.48, 0.49));
}

TEST(SceneFields, FlagsHoldsAndThicknessAreNotMixedUp) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  EXPECT_EQ(read_scene(file, {"mesh.thickness_mm=7.5"}).mesh.thickness_m, 0.0075);
  EXPECT_EQ(read_scene(file, {"support.skull=free"}).support.skull, simulate::Hold::free);
  EXPECT_TRUE(read_scene(file, {"support.skull=free"}).support.border_held);
  EXPECT_FALSE(read_scene(file, {"output.glb=false"}).output.glb);
  EXPECT_TRUE(read_scene(file, {"output.glb=false"}).output.vtu);
}

TEST(SceneFields, EachWordMeansItsValue) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  const auto with = [&](const std::string& set) {
    return read_scene(file, {"region.measured_points=[\"a\"]", set});
  };
  EXPECT_EQ(with("scan.unit=mm").scan.unit, io::LengthUnit::millimetre);
  EXPECT_EQ(with("scan.unit=m").scan.unit, io::LengthUnit::metre);
  EXPECT_EQ(with("scan.unit=guess").scan.unit, std::nullopt);
  EXPECT_EQ(with("motion.unit=file").motion.unit, std::nullopt);
  EXPECT_EQ(with("alignment.method=nonrigid").alignment.method,
            simulate::AlignmentMethod::nonrigid);
  EXPECT_EQ(with("alignment.method=normalised").alignment.method,
            simulate::AlignmentMethod::normalised);
  EXPECT_EQ(with("region.measured=none").region.measured, simulate::Measured::none);
  EXPECT_EQ(with("region.measured=all").region.measured, simulate::Measured::all);
  EXPECT_EQ(with("mesh.cut_lips=auto").mesh.cut_lips, tissue::LipCut::automatic);
  EXPECT_EQ(with("mesh.cut_lips=always").mesh.cut_lips, tissue::LipCut::always);
  EXPECT_EQ(with("tissue.viscous_form=isotropic").model.viscous_form, fem::ViscousForm::isotropic);
  EXPECT_TRUE(with("support.border=held").support.border_held);
  EXPECT_EQ(with("support.mandible=follow").support.mandible, simulate::Mandible::follow);
  EXPECT_EQ(with("support.mandible=held").support.mandible, simulate::Mandible::held);
  const Scene all = with("drive.points=all");
  EXPECT_TRUE(all.drive.all_points);
  EXPECT_TRUE(all.drive.points.empty());
  EXPECT_TRUE(all.scan.source.embedded && all.motion.source.embedded);
}

}  // namespace
}  // namespace hyperex::scene
