// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/keys.hpp"

#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/fields.hpp"
#include "hyperex/tissue/field/presets.hpp"

namespace hyperex::scene {
namespace {

// The field `member` of whatever options struct is handed in, const or not.
#define AT(member)             \
  [](auto& options) -> auto& { \
    return options.member;     \
  }

using io::LengthUnit;
using MaybeUnit = std::optional<LengthUnit>;
const Unit none{""}, millimetres{"mm", 1, 1000}, seconds{"s"}, stiffness{"kPa/mm", 1000000, 1};

// The rooms' own options: their ranges are stated there.
using Mesh = tissue::TissueMeshOptions;
using Region = simulate::RegionOptions;
using Support = simulate::SupportOptions;
using Drive = simulate::DriveOptions;
using Solver = simulate::SolverOptions;
using Time = simulate::TimeOptions;
using simulate::AlignmentMethod;
using simulate::DriveBy;
using simulate::Hold;
using simulate::Mandible;
using simulate::Measured;
using simulate::SolverMethod;

/// The bounds of an option in the unit of its key.
Range in(const Bounds& bounds, const Unit& unit) {
  return {unit.from_si(bounds.least), unit.from_si(bounds.most)};
}
Range or_zero(Range range) {
  range.or_zero = true;
  return range;
}

std::vector<std::pair<std::string, MaybeUnit>> units_or(const std::string& otherwise) {
  return {{"mm", LengthUnit::millimetre},
          {"cm", LengthUnit::centimetre},
          {"m", LengthUnit::metre},
          {otherwise, std::nullopt}};
}

std::vector<Key> input_keys() {
  return {
      text<Scene>("title", AT(title), 0, "Heads the report."),
      source<Scene>(
          "scan.file", AT(scan.source), true,
          "The scan: PLY, OBJ, STL, glTF or GLB; or the face that comes with the program."),
      choice<Scene, MaybeUnit>("scan.unit", AT(scan.unit), units_or("guess"),
                               "The scan's unit of length. A guess takes the one that makes the "
                               "face 10 to 30 cm wide, and says so."),
      path<Scene>(
          "scan.landmarks", AT(scan.landmarks),
          "Named points on the scan: JSON as in docs/landmarks.md, or 3D Slicer's .mrk.json. "
          "Where none is given they are found by the landmark network."),
      choice<Scene, MaybeUnit>("scan.landmarks_unit", AT(scan.landmarks_unit), units_or("file"),
                               "The landmarks' unit of length, where it is not the one that their "
                               "file states."),
      source<Scene>(
          "motion.file", AT(motion.source), false,
          "The recording, as named points over time: CSV or TRC; or the mouth opening of 2.7 s "
          "that comes with the program. One of motion.file, motion.recording, motion.openface and "
          "motion.arkit is required; one given by --set replaces the one in the file."),
      path<Scene>(
          "motion.recording", AT(motion.recording),
          "The recording of a camera, colour and depth: a folder in TUM's layout, a video or .oni "
          "file. The face in it is tracked, as by hyperex track.",
          true),
      flag<Scene>("motion.mirrored", AT(motion.mirrored),
                  "The pictures of motion.recording show the world as a mirror does (many selfie "
                  "videos do) and are turned back; a video does not tell, and left and right "
                  "depend on it."),
      path<Scene>("motion.openface", AT(motion.openface),
                  "Action-unit intensities over time: a CSV file of OpenFace 2. They move the face "
                  "model, whose points are then the recording."),
      path<Scene>("motion.arkit", AT(motion.arkit),
                  "ARKit blend-shape weights over time: a CSV file with a column time_s, or as "
                  "Live Link Face writes it. They move the face model in the same way."),
      path<Scene>("motion.candide", AT(motion.candide),
                  "CANDIDE-3's .wfm file, to be the face model for motion.recording, "
                  "motion.openface and motion.arkit. Empty: the canonical face."),
      choice<Scene, MaybeUnit>("motion.unit", AT(motion.unit), units_or("file"),
                               "The recording's unit of length, where it is not the one that the "
                               "file states."),
      names<Scene>(
          "motion.rigid_points", AT(motion.rigid_points), 3,
          "Points that move with the skull: the head pose is estimated from them and removed. "
          "Empty: all landmarks of the face, each with a weight that falls with how much it moves "
          "in life; at least three of eye corners, bridge of the nose and temples are needed."),
      time_or_stretch<Scene>(
          "motion.rest_s", seconds, AT(motion.rest_s), {0, 3600},
          "When the face is at rest, from the recording's start: a time, or [from, to], over which "
          "the mean is taken. All displacements are from there. Where the recording starts in an "
          "expression the run begins half a second earlier, at rest, and is led into it. Empty: "
          "the recording's first sample is at rest."),
      number<Scene>("motion.max_gap_s", seconds, AT(motion.max_gap_s), {0, 10},
                    "The longest gap in a point's track that is interpolated; a longer one is "
                    "refused."),
      number<Scene>("motion.gain", none, AT(drive.gain), {0, 5},
                    "Multiplies all displacements; 1 as recorded."),
      rows<Scene, motion::PointGain>(
          "motion.point_gain", AT(motion.point_gains),
          {text<motion::PointGain>("point", AT(point), 1, "A point of the recording."),
           number<motion::PointGain>("gain", none, AT(gain), {0, 5},
                                     "Multiplies its displacement.")},
          "A gain on one point, in addition to motion.gain. Other points keep their motion; the "
          "skin between them and the jaw follow the changed point as they follow every driven "
          "point."),
      number<Scene>("motion.time_scale", none, AT(motion.time_scale), {0.05, 20},
                    "Stretches the recording in time: 2 plays it twice as slowly. Gaps and "
                    "jitter are judged as recorded; times of time and output are not stretched."),
      choice<Scene, AlignmentMethod>(
          "alignment.method", AT(alignment.method),
          {{"nonrigid", AlignmentMethod::nonrigid},
           {"similarity", AlignmentMethod::similarity},
           {"normalised", AlignmentMethod::normalised}},
          "How the recording is aligned with the scan: by a similarity transform of the landmarks "
          "and a smooth correction, by the similarity transform alone, or by the widths and "
          "heights of parts of the face about the nose apex."),
      choice<Scene, Measured>(
          "region.measured", AT(region.measured),
          {{"none", Measured::none}, {"all", Measured::all}, {"points", Measured::points}},
          "Which part of the face follows the recording directly, while the rest is simulated: "
          "none, all of it, or the surroundings of region.measured_points."),
      names<Scene>("region.measured_points", AT(region.measured_points), 0,
                   "Points whose surroundings are measured. At least one where region.measured is "
                   "\"points\"."),
      number<Scene>("region.measured_radius_mm", millimetres, AT(region.measured_radius_m),
                    in(Region::measured_radius_m_in, millimetres),
                    "How far the surroundings of a measured point reach."),
      number<Scene>("region.blend_mm", millimetres, AT(region.blend_m),
                    in(Region::blend_m_in, millimetres),
                    "Width of the transition from measured to simulated."),
  };
}

const Unit kilopascals{"kPa", 1000, 1}, pascal_seconds{"Pa s"}, density_unit{"kg/m^3"};
/// What the material may have, in the unit of the key.
Range range_of(tissue::Parameter parameter) {
  const tissue::ParameterInfo& info = tissue::parameter_info(parameter);
  return {info.least / info.si, info.most / info.si};
}

/// A parameter of the whole tissue. Where it is not given the preset's holds, or the default, and
/// is what the echo shows.
Key uniform_parameter(std::string name, Unit unit, tissue::Parameter parameter,
                      std::string description) {
  Key key = number<Scene>(
      std::move(name),
      unit, [parameter](auto& scene) -> auto& { return scene.tissue.uniform[parameter]; },
      range_of(parameter), std::move(description));
  key.get = [unit, parameter](const Scene& scene) -> nlohmann::json {
    const std::optional<double>& given = scene.tissue.uniform[parameter];
    return unit.from_si(given ? *given : tissue::uniform_parameters(scene.tissue)[parameter]);
  };
  return key;
}

/// Parameters of a point or a region, each given or not.
template <class Row>
std::vector<Field<Row>> given_parameters() {
  using namespace tissue;
  return {maybe_number<Row>("young_kpa", kilopascals, AT(value[young]), range_of(young),
                            "Young's modulus there."),
          maybe_number<Row>("viscosity_pa_s", pascal_seconds, AT(value[viscosity]),
                            range_of(viscosity), "Viscosity there."),
          maybe_number<Row>("poisson", none, AT(value[poisson]), range_of(poisson),
                            "Poisson's ratio there."),
          maybe_number<Row>("density_kg_m3", density_unit, AT(value[density]), range_of(density),
                            "Density there.")};
}

std::vector<Field<tissue::TissuePoint>> point_columns() {
  using Row = tissue::TissuePoint;
  std::vector<Field<Row>> columns = {
      text<Row>("landmark", AT(landmark), 1,
                "A landmark of the scan, with its side (cheek_R) or without (cheek: both)."),
      optional(choice<Row, std::string>("side", AT(side), {{"L", "L"}, {"R", "R"}, {"", ""}},
                                        "The subject's own side, where the landmark's name "
                                        "has none."))};
  for (auto& column : given_parameters<Row>()) columns.push_back(std::move(column));
  return columns;
}

std::vector<Field<tissue::TissueRegion>> region_columns() {
  using Row = tissue::TissueRegion;
  using namespace tissue;
  constexpr Range factor_range{0, 1000, true};
  std::vector<Field<Row>> columns = {
      optional(text<Row>("name", AT(name), 1,
                         "A part of the face, as cheek_R or lips (hyperex presets lists them).")),
      optional(names<Row>("scar", AT(scar), 2,
                          "Instead of name: landmarks along a scar, whose straight segments are "
                          "projected onto the skin.")),
      optional(places<Row>("scar_points_mm", millimetres, AT(scar_points_m),
                           "Instead: points along a scar, in the scan's coordinates.")),
      optional(path<Row>(
          "painted", AT(painted),
          "Instead: the scan painted red where the change applies (PLY, OBJ, GLB with vertex "
          "colours), or a CSV or PLY file with one weight from 0 to 1 per vertex.")),
      optional(number<Row>("width_mm", millimetres, AT(width_m), {0.5, 100},
                           "Width of a scar; 4 where not given.")),
      optional(number<Row>(
          "blend_mm", millimetres, AT(blend_m), {0, 100},
          "Width of the transition at the rim, half of it outside; 4 where not given."))};
  for (auto& column : given_parameters<Row>()) columns.push_back(std::move(column));
  columns.push_back(maybe_number<Row>("young_factor", none, AT(factor[young]), factor_range,
                                      "Multiplies Young's modulus there."));
  columns.push_back(maybe_number<Row>("viscosity_factor", none, AT(factor[viscosity]), {0, 1000},
                                      "Multiplies the viscosity there."));
  columns.push_back(maybe_number<Row>("poisson_factor", none, AT(factor[poisson]), {-1000, 1000},
                                      "Multiplies Poisson's ratio there."));
  columns.push_back(maybe_number<Row>("density_factor", none, AT(factor[density]), factor_range,
                                      "Multiplies the density there."));
  return columns;
}

std::vector<Key> model_keys() {
  return {
      number<Scene>("mesh.element_size_mm", millimetres, AT(mesh.element_size_m),
                    in(Mesh::element_size_m_in, millimetres),
                    "Edge length of the tetrahedra along the skin."),
      integer<Scene>("mesh.layers", AT(mesh.layers), in(Mesh::layers_in, none),
                     "Layers of elements between the skin and the inner surface."),
      number<Scene>("mesh.thickness_mm", millimetres, AT(mesh.thickness_m),
                    or_zero(in(Mesh::thickness_m_in, millimetres)),
                    "Thickness of the soft tissue, the same everywhere. 0: from published depths "
                    "at landmarks, interpolated."),
      choice<Scene, tissue::LipCut>(
          "mesh.cut_lips", AT(mesh.cut_lips),
          {{"auto", tissue::LipCut::automatic},
           {"always", tissue::LipCut::always},
           {"never", tissue::LipCut::never}},
          "Whether the scan is cut between the lips: \"auto\" cuts where they are joined."),
      number<Scene>("mesh.trim_border_mm", millimetres, AT(mesh.trim_border_m),
                    in(Mesh::trim_border_m_in, millimetres),
                    "Takes off a strip of this width along the scan's outer border."),
      rows<Scene, tissue::DepthAt>(
          "mesh.thickness_point", AT(mesh.depths),
          {text<tissue::DepthAt>("landmark", AT(landmark), 1, "A landmark of the scan."),
           number<tissue::DepthAt>("thickness_mm", millimetres, AT(depth_m),
                                   in(Mesh::thickness_m_in, millimetres),
                                   "Thickness of the soft tissue there.")},
          "Thickness at a landmark, instead of the published depth there; interpolated in between. "
          "Only where mesh.thickness_mm is 0."),
      path<Scene>(
          "mesh.thickness_per_vertex", AT(mesh.depth_per_vertex),
          "Thickness for each vertex of the scan: a CSV file with a column thickness_mm and "
          "one row per vertex, or a PLY file with such a vertex property; 1 to 40. An empty "
          "cell (in PLY: nan) keeps the thickness that the other keys give."),
      rows<Scene, tissue::DepthRegion>(
          "mesh.thickness_region", AT(mesh.depth_regions),
          {path<tissue::DepthRegion>(
               "painted", AT(painted),
               "The scan painted red where the tissue is of this thickness (PLY, OBJ, GLB with "
               "vertex colours), or a CSV or PLY file with one weight from 0 to 1 per vertex."),
           number<tissue::DepthRegion>("thickness_mm", millimetres, AT(depth_m),
                                       in(Mesh::thickness_m_in, millimetres),
                                       "Thickness of the soft tissue where the weight is 1.")},
          "Thickness in a painted part of the face, applied after all of the above and in the "
          "order of the file."),
      uniform_parameter(
          "tissue.young_kpa", kilopascals, tissue::young,
          "Young's modulus E. The springs of [support] do not scale with it. Where drive.by = "
          "\"muscles\", E rises towards the lips, up to 3.2 times this value (docs/muscles.md)."),
      uniform_parameter(
          "tissue.poisson", none, tissue::poisson,
          "Poisson's ratio. With tissue.element = \"tet4\" the tissue moves too little near 0.5."),
      uniform_parameter("tissue.viscosity_pa_s", pascal_seconds, tissue::viscosity,
                        "Viscosity eta, of changes of shape."),
      uniform_parameter("tissue.density_kg_m3", density_unit, tissue::density, "Density."),
      choice<Scene, fem::ViscousForm>(
          "tissue.viscous_form", AT(model.viscous_form),
          {{"isotropic", fem::ViscousForm::isotropic}, {"printed", fem::ViscousForm::printed}},
          "The viscous tensor: Stokes' law, or the tensor printed in the thesis (docs/theory.md), "
          "which is not isotropic."),
      choice<Scene, fem::ElementKind>(
          "tissue.element", AT(model.element),
          {{"tet4", fem::ElementKind::tet4}, {"tet4-star", fem::ElementKind::tet4_star}},
          "The finite element: linear tetrahedra, plain, or with the change of volume averaged "
          "over patches, which does not lock near poisson = 0.5 (docs/elements.md)."),
      choice<Scene, simulate::Strain>(
          "tissue.strain", AT(model.strain),
          {{"linear", simulate::Strain::linear}, {"finite", simulate::Strain::finite}},
          "Small strain and rotation, where one factorisation serves all steps; or finite strain "
          "and rotation with a hyperelastic law, about ten times as slow (docs/mechanics.md)."),
      choice<Scene, fem::HyperelasticLaw>(
          "tissue.law", AT(model.law.law),
          {{"neo-hookean", fem::HyperelasticLaw::neo_hookean},
           {"isochoric-neo-hookean", fem::HyperelasticLaw::isochoric_neo_hookean},
           {"yeoh", fem::HyperelasticLaw::yeoh},
           {"mooney-rivlin", fem::HyperelasticLaw::mooney_rivlin}},
          "The hyperelastic law where tissue.strain = \"finite\". Its stiffness at small strain is "
          "that of tissue.young_kpa and tissue.poisson."),
      number<Scene>("tissue.yeoh_c20", none, AT(model.law.c20), {-10, 100},
                    "C20 / C10 of tissue.law = \"yeoh\", a ratio. C10 is no key: it follows from "
                    "tissue.young_kpa = 4 (1 + poisson) C10. The default is of facial tissue "
                    "(C10 2.5 kPa, C20 1.175 kPa, so young_kpa = 15)."),
      number<Scene>("tissue.yeoh_c30", none, AT(model.law.c30), {0, 100},
                    "C30 / C10 of tissue.law = \"yeoh\", a ratio."),
      number<Scene>("tissue.mooney_c01", none, AT(model.law.c01), {0, 100},
                    "C01 / C10 of tissue.law = \"mooney-rivlin\", a ratio: tissue.young_kpa = "
                    "4 (1 + poisson) (C10 + C01)."),
      rows<Scene, fem::MaxwellBranch>(
          "tissue.maxwell", AT(model.law.branches),
          {number<fem::MaxwellBranch>(
               "ratio", none, AT(ratio), {0, 100},
               "Instantaneous stress of the branch, as a ratio to that of the law."),
           number<fem::MaxwellBranch>("relaxation_s", seconds, AT(relaxation_s), {1e-6, 1e6},
                                      "Relaxation time: the time in which that stress falls to 1/e "
                                      "at a constant stretch.")},
          "A Maxwell branch (a spring and a dashpot in series), parallel to the law and the "
          "viscosity: tissue held at a stretch relaxes. tissue.young_kpa is the long-term "
          "stiffness. Only where tissue.strain = \"finite\"."),
      text<Scene>("tissue.preset", AT(tissue.preset), 0,
                  "Published parameters by name (hyperex presets lists them with their sources); "
                  "keys given here replace its values. Empty: none."),
      choice<Scene, tissue::Interpolation>(
          "tissue.interpolation", AT(tissue.interpolation),
          {{"harmonic", tissue::Interpolation::harmonic},
           {"linear", tissue::Interpolation::linear}},
          "How parameters at points are interpolated over the face: as a harmonic field on the "
          "skin, or linearly over triangles of points in the frontal view (docs/tissue.md)."),
      flag<Scene>("tissue.mirror", AT(tissue.mirror),
                  "Entries of [[tissue.point]] and [[tissue.region]] for one side are mirrored to "
                  "the other."),
      path<Scene>("tissue.per_vertex", AT(tissue.per_vertex),
                  "Parameters for each vertex of the scan: a CSV file with columns young_kpa, "
                  "viscosity_pa_s, poisson or density_kg_m3 and one row per vertex, or a PLY file "
                  "with such vertex properties. An empty cell (in PLY: nan) keeps the value that "
                  "the other keys give."),
      rows<Scene, tissue::TissuePoint>(
          "tissue.point", AT(tissue.points), point_columns(),
          "Parameters at a landmark, interpolated over the face instead of the uniform ones. At "
          "least one of them must be given."),
      rows<Scene, tissue::TissueRegion>(
          "tissue.region", AT(tissue.regions), region_columns(),
          "A change within a part of the face, applied after the points and in the order of the "
          "file: values or factors in a named region or along a scar."),
      choice<Scene, bool>("support.border", AT(support.border_held),
                          {{"held", true}, {"free", false}},
                          "The tissue's outer border, from the skin to the inner surface."),
      choice<Scene, Hold>("support.skull", AT(support.skull),
                          {{"sliding", Hold::sliding}, {"held", Hold::held}, {"free", Hold::free}},
                          "The inner surface over the skull: slides on a loose layer (an elastic "
                          "foundation), is fixed, or is free."),
      number<Scene>("support.skull_across_kpa_per_mm", stiffness,
                    AT(support.skull_layer.across_pa_per_m),
                    in(Support::stiffness_pa_per_m_in, stiffness),
                    "Stiffness of the loose layer over the skull, normal to the bone: the pressure "
                    "for a displacement of one millimetre."),
      number<Scene>("support.skull_along_kpa_per_mm", stiffness,
                    AT(support.skull_layer.along_pa_per_m),
                    in(Support::stiffness_pa_per_m_in, stiffness),
                    "The same tangential to the bone: the shear stress for a displacement of one "
                    "millimetre."),
      choice<Scene, Mandible>(
          "support.mandible", AT(support.mandible),
          {{"follow", Mandible::follow}, {"held", Mandible::held}, {"free", Mandible::free}},
          "The inner surface over the mandible: follows the jaw as a rigid bone, is fixed, or is "
          "free."),
      number<Scene>("support.mandible_across_kpa_per_mm", stiffness,
                    AT(support.mandible_layer.across_pa_per_m),
                    in(Support::stiffness_pa_per_m_in, stiffness),
                    "As support.skull_across_kpa_per_mm, over a mandible that moves."),
      number<Scene>("support.mandible_along_kpa_per_mm", stiffness,
                    AT(support.mandible_layer.along_pa_per_m),
                    in(Support::stiffness_pa_per_m_in, stiffness),
                    "As support.skull_along_kpa_per_mm, over a mandible that moves."),
      number<Scene>(
          "support.field_kpa_per_mm", stiffness, AT(support.field_pa_per_m),
          in(Support::stiffness_pa_per_m_in, stiffness),
          "Stiffness of an elastic foundation under the tissue, except over the mandible. Its base "
          "follows the motion interpolated between the driven points. 0: none."),
      names<Scene>(
          "support.jaw_points", AT(support.jaw_points), 0,
          "Points whose motion rotates the jaw. Empty: those of the chin that the recording has."),
  };
}

std::vector<Key> run_keys() {
  return {
      names_or_all<Scene>(
          "drive.points", AT(drive.points), AT(drive.all_points),
          "Points of the recording that drive the skin. With motion.candide and no points named: "
          "those of the default that the model has."),
      choice<Scene, DriveBy>(
          "drive.by", AT(drive.by),
          {{"displacement", DriveBy::displacement},
           {"muscles", DriveBy::muscles},
           {"reactions", DriveBy::reactions}},
          "What the points are: places that the skin is carried to, whatever the tissue; or what "
          "muscles, the jaw and forces at the points are found from (docs/muscles.md), or forces "
          "alone. Forces are found once, in the scene's tissue, and variants answer the same "
          "forces. Where it is not given: \"displacement\" where the scene or a variant sets a key "
          "of "
          "[support] (but jaw_points) or [region]; else \"muscles\" where there are variants; else "
          "\"displacement\" where the mouth opens by more than 0.2 of the distance between the "
          "outer "
          "corners of the eyes while its own corners part by less than 0.004 of it, as by the jaw "
          "alone, and \"muscles\" for every other motion. The run says which and why."),
      number<Scene>(
          "drive.patch_radius_mm", millimetres, AT(drive.patch_radius_m),
          in(Drive::patch_radius_m_in, millimetres),
          "Radius of the patch of skin that a driven point moves where the lips part; half "
          "as much again where they stay closed. 0 takes the nearest node alone."),
      names<Scene>("drive.still_points", AT(drive.still_points), 0,
                   "Points of the skin that are fixed."),
      path<Scene>(
          "muscles.file", AT(muscles_file),
          "Your own muscles, as tables [[muscle]] (docs/muscles.md): one with the name of a muscle "
          "of the program replaces it, others are added. The same for all variants."),
      names<Scene>(
          "muscles.without", AT(muscles_without), 0,
          "Muscles to leave out, by their names without the side. The same for all variants."),
      factors<Scene, simulate::MuscleGain>(
          "muscles.gain", AT(muscles.gains), &simulate::MuscleGain::muscle,
          &simulate::MuscleGain::gain, muscles::gain_names(),
          in(simulate::MuscleOptions::gain_in, none),
          "Factors on activations as they were found: of one muscle, of those that a branch of the "
          "facial nerve moves on one side, or of a side; 0 is a palsy. Several multiply."),
      flag<Scene>("muscles.mirrored", AT(muscles.mirrored),
                  "Each muscle takes the activation of its counterpart on the other side."),
      choice<Scene, TeethShape>("teeth.shape", AT(teeth.shape),
                                {{"arch", TeethShape::arch}, {"none", TeethShape::none}},
                                "The teeth of a jaw without a scan of its own: an average dental "
                                "arch fitted behind lips and cheeks (docs/teeth.md), or none."),
      path<Scene>("teeth.upper", AT(teeth.upper),
                  "A scan of the upper teeth with their gums, in the coordinates of the face scan: "
                  "PLY, OBJ, STL, glTF or GLB. Holes are filled."),
      path<Scene>("teeth.lower", AT(teeth.lower),
                  "The same for the lower teeth, in the position at rest. They move with the jaw."),
      choice<Scene, MaybeUnit>(
          "teeth.unit", AT(teeth.unit), units_or("scan"),
          "The unit of length of these scans, where it is not that of the face scan."),
      flag<Scene>("contact.lips", AT(contact.lips),
                  "The lips may touch but not pass through each other, without friction. Each "
                  "frame is corrected separately, in static equilibrium. Recorded points then end "
                  "where they are recorded only as far as no lip is in their way."),
      flag<Scene>("contact.teeth", AT(contact.teeth),
                  "The inner side of lips and cheeks may touch the teeth of both jaws but not pass "
                  "through them, in the same way. The lower teeth move with the jaw."),
      flag<Scene>("contact.eyes", AT(contact.eyes),
                  "The lids may touch eyeballs, which are fitted behind them, but not pass through "
                  "them, in the same way."),
      choice<Scene, SolverMethod>(
          "solver.method", AT(solver.method),
          {{"reduced", SolverMethod::reduced}, {"direct", SolverMethod::direct}},
          "A reduced model: the equations projected onto the modes that the input excites, to "
          "solver.tolerance; or all degrees of freedom at every step."),
      choice<Scene, fem::LinearSolver>(
          "solver.linear", AT(solver.linear),
          {{"auto", fem::LinearSolver::automatic},
           {"cholesky", fem::LinearSolver::cholesky},
           {"iterative", fem::LinearSolver::iterative}},
          "How linear systems are solved: by Cholesky factorisation; by conjugate gradients "
          "preconditioned with overlapping subdomains, which takes less memory and more time; or "
          "by the first where it fits into memory, else the second."),
      number<Scene>("solver.tolerance", none, AT(solver.tolerance), in(Solver::tolerance_in, none),
                    "Allowed error of the reduced model by its own estimate, relative to the "
                    "largest displacement."),
      number<Scene>("solver.newmark_beta", none, AT(solver.newmark_beta),
                    in(Solver::newmark_beta_in, none), "beta of Newmark's method."),
      number<Scene>("solver.newmark_gamma", none, AT(solver.newmark_gamma),
                    in(Solver::newmark_gamma_in, none),
                    "gamma (delta) of Newmark's method; above 0.5 it damps. At most twice "
                    "solver.newmark_beta."),
      flag<Scene>("solver.verify", AT(solver.verify),
                  "Run the full model too and report the true error of the reduced one."),
      number<Scene>("solver.finite_step_s", seconds, AT(solver.finite_step_s),
                    in(Solver::finite_step_s_in, seconds),
                    "The time step where tissue.strain = \"finite\"; it is halved where it does "
                    "not converge. 0: the time between frames."),
      number<Scene>(
          "solver.finite_tolerance", none, AT(solver.finite_tolerance),
          in(Solver::finite_tolerance_in, none),
          "Error of a step's iterations at finite strain, relative to the largest displacement."),
      flag<Scene>(
          "solver.full_newton", AT(solver.full_newton),
          "At finite strain, factorise the matrix in each iteration and not once per step."),
      number<Scene>("time.step_s", seconds, AT(time.step_s), in(Time::step_s_in, seconds),
                    "The time step."),
      number<Scene>("time.end_s", seconds, AT(time.end_s), in(Time::end_s_in, seconds),
                    "When the simulation ends; after the recording its last sample is kept. 0: at "
                    "the end of the recording."),
      number<Scene>("time.frame_rate_hz", {"Hz"}, AT(time.frame_rate_hz),
                    in(Time::frame_rate_hz_in, none),
                    "Frames written per second. They need not coincide with time steps."),
      number<Scene>("output.peak_time_s", seconds, AT(time.peak_time_s),
                    in(Time::peak_time_s_in, seconds),
                    "Time of skin_peak.ply. Below 0: when the mean displacement of the driven "
                    "points is greatest."),
      flag<Scene>(
          "output.vtu", AT(output.vtu),
          "Write frames.pvd and frames/: the tissue over time, for ParaView. The points are "
          "at rest in every frame; the filter Warp By Vector moves them."),
      integer<Scene>("output.vtu_every", AT(output.vtu_every), {1, 10000},
                     "Write only every n-th frame there: 3 takes a third of the space."),
      flag<Scene>("output.vtu_strain", AT(output.vtu_strain),
                  "Write the strain tensors there; at finite strain also stress tensors and "
                  "principal stretches."),
      flag<Scene>("output.variants_vtu", AT(output.variants_vtu),
                  "Write them for each variant too, into its folder."),
      flag<Scene>("output.glb", AT(output.glb),
                  "Write performance.glb, of each variant too: the moving skin for Blender and "
                  "other programs that read glTF."),
      number<Scene>("output.glb_tolerance_mm", millimetres, AT(output.glb_tolerance_m), {0.01, 10},
                    "The greatest allowed error of any vertex of performance.glb in any frame. A "
                    "larger tolerance needs fewer shape keys and makes a smaller file."),
      number<Scene>("output.glb_max_mb", {"MB"}, AT(output.glb_max_mb), {0.1, 10000},
                    "The largest size of performance.glb. Where output.glb_tolerance_mm needs "
                    "more, shape keys are left out and a warning states the remaining error."),
      flag<Scene>("output.report", AT(output.report), "Write report.html."),
      flag<Scene>(
          "output.full_paths", AT(output.full_paths),
          "Write full paths of the input files into summary.json and report.html. By default only "
          "file names are written, since folder names may contain a patient's name."),
      number<Scene>("output.symmetry_floor", none, AT(output.symmetry_floor), {0, 1, true},
                    "The least difference of xi that S(t) resolves; at perfect symmetry it would "
                    "be minus infinity."),
      number<Scene>("output.jitter_mm", millimetres, AT(output.jitter_m), {-1, 20},
                    "Jitter of the recorded points (standard deviation per coordinate), which sets "
                    "the noise floor of S(t) (docs/symmetry.md). Below 0: estimated from the "
                    "fourth differences of the points in time."),
      number<Scene>("output.lowpass_hz", none, AT(output.lowpass_hz), {0, 100},
                    "Cut-off frequency of the zero-phase low-pass filter for speeds and paths of "
                    "points with jitter (docs/symmetry.md). 0: no filter."),
      numbers<Scene>("output.contact_times_s", seconds, AT(time.still_times_s),
                     in(Time::still_times_s_in, seconds), 0, 12,
                     "Times of the pictures in contact_sheet.png. None: five times over the run, "
                     "with the peak among them."),
  };
}
#undef AT

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {"", "At the top of the file, before any section."},
      {"scan", "The face at rest."},
      {"motion", "The recorded expression."},
      {"alignment", "How the recording is transferred to the scan."},
      {"region", "What follows the recording directly and what is simulated."},
      {"mesh", "The volume of soft tissue."},
      {"tissue", "The material."},
      {"support", "What holds the tissue on its inner surface and at its border."},
      {"drive", "What moves it."},
      {"muscles", "Muscles, where they are what moves it (`drive.by`)."},
      {"teeth",
       "The teeth behind the lips. They are drawn; with contact.teeth the tissue touches them."},
      {"contact", "Which surfaces may not pass through each other."},
      {"solver", "How the equations of motion are solved."},
      {"time", "Steps and frames."},
      {"output", "What is written."},
  };
  return all;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> table = input_keys();
    for (auto& part : {model_keys(), run_keys()})
      table.insert(table.end(), part.begin(), part.end());
    return table;
  }();
  return all;
}

bool speaks_of_displacement(const std::string& key) {
  return key.starts_with("region.") ||
         (key.starts_with("support.") && !key.starts_with("support.jaw_points"));
}

const Key* find_key(const std::string& name) {
  for (const Key& key : keys())
    if (key.name == name) return &key;
  return nullptr;
}

}  // namespace hyperex::scene
