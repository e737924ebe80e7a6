// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All options of a simulation. Each is described here and nowhere else (core/describe.hpp): its
// default, bounds, words and meaning. Scene files, Python and tests walk these descriptions.
#include <array>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::simulate {

enum class Measured { none, all, points };
constexpr auto words_of(Measured) {
  return std::array{Word{"none", Measured::none}, Word{"all", Measured::all},
                    Word{"points", Measured::points}};
}

/// Which part of the skin follows the recording directly; the rest is physical.
struct RegionOptions {
  Measured measured = Measured::none;
  std::vector<std::string> measured_points;  ///< at least one where measured is `points`
  double measured_radius_m = 0.015;          ///< of the skin around them
  double blend_m = 0.005;                    ///< width of the transition from measured to simulated
  bool operator==(const RegionOptions&) const = default;

  static constexpr const char* about = "What follows the recording directly and what is simulated.";
  /// Of the options that have an effect only beside `measured`.
  static constexpr const char* only_where = "region.measured = \"all\" or \"points\"";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(measured),
             "Which part of the face follows the recording directly, while the rest is simulated: "
             "none, all of it, or the surroundings of region.measured_points.");
    v.option(HX_MEMBER(measured_points),
             "Points whose surroundings are measured. At least one where region.measured is "
             "\"points\".",
             {.only_where = only_where});
    v.option(HX_MEMBER(measured_radius_m), "How far the surroundings of a measured point reach.",
             {.unit = kMillimetres, .bounds = {0.001, 0.2}, .only_where = only_where});
    v.option(HX_MEMBER(blend_m), "Width of the transition from measured to simulated.",
             {.unit = kMillimetres, .bounds = {0, 0.1}, .only_where = only_where});
  }
};

enum class Hold { held, sliding, free };
constexpr auto words_of(Hold) {
  return std::array{Word{"sliding", Hold::sliding}, Word{"held", Hold::held},
                    Word{"free", Hold::free}};
}
enum class Mandible { follow, held, free };
constexpr auto words_of(Mandible) {
  return std::array{Word{"follow", Mandible::follow}, Word{"held", Mandible::held},
                    Word{"free", Mandible::free}};
}

/// Of options of SupportOptions that muscles replace (MuscleOptions), or do not use.
inline constexpr const char* kNotByMuscles = "drive.by = \"displacement\" or \"reactions\"";

/// Unit and bounds of an elastic foundation's stiffness per area.
inline constexpr OptionDetails kFoundation{
    .unit = kKilopascalsPerMillimetre, .bounds = {0, 1e12}, .only_where = kNotByMuscles};

/// The tissue slides on the bone on a layer of loose tissue: springs per area between the inner
/// surface and the bone, stiff across the layer, soft along it.
struct BoneLayer {
  double across_pa_per_m = 0, along_pa_per_m = 0;
  bool operator==(const BoneLayer&) const = default;

  static constexpr const char* about = "Springs between tissue and bone, per area.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(across_pa_per_m),
             "Stiffness normal to the bone: the pressure for a displacement of one millimetre.",
             kFoundation);
    v.option(HX_MEMBER(along_pa_per_m),
             "Stiffness tangential to the bone: the shear stress for a displacement of one "
             "millimetre.",
             kFoundation);
  }
};

struct SupportOptions {
  bool border_held = true;
  Hold skull = Hold::sliding;
  Mandible mandible = Mandible::follow;
  BoneLayer skull_layer{1e7, 1e7};     ///< used where skull is sliding
  BoneLayer mandible_layer{3e7, 1e7};  ///< used where the mandible is followed
  /// An elastic foundation that follows the field interpolated between the driven points: springs
  /// per area at the inner surface, everywhere but over the mandible. 0: none.
  double field_pa_per_m = 5e6;
  /// Lips supported by the teeth: springs per area at the inner surface within `teeth_reach_m` of
  /// the lips, outside of skull and mandible. Springs of the lower lip follow the jaw. 0: none.
  BoneLayer teeth_layer{0, 0};
  double teeth_reach_m = 0.014;
  /// Floor of the mouth, between the edge of the mandible and the neck: springs per area at the
  /// inner surface below that edge. Their base moves as the nearest point of the edge, times
  /// exp(-(d / throat_reach_m)^2), where d is the distance to that point. 0: none.
  double throat_pa_per_m = 0, throat_reach_m = 0.09;
  std::vector<std::string> jaw_points;  ///< that carry the jaw; empty: chin points among the driven
  bool operator==(const SupportOptions&) const = default;

  static constexpr const char* about =
      "What holds the tissue on its inner surface and at its border. Where drive.by = \"muscles\" "
      "the stiffnesses (in kPa/mm) have no effect: muscles have their own.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(
        HX_MEMBER(border_held),
        "The tissue's outer border, from the skin to the inner surface. Even if held, it is free "
        "within 35 mm of the jaw's line and slides over the skull within 35 mm above the brows.",
        {.key = "border", .words = {"held", "free"}});
    v.option(HX_MEMBER(skull),
             "The inner surface over the skull: slides on a loose layer (an elastic foundation), "
             "is fixed, or is free.");
    v.option(HX_MEMBER(skull_layer), "The loose layer over the skull.", {.key = "skull_"});
    v.option(HX_MEMBER(mandible),
             "The inner surface over the mandible: follows the jaw as a rigid bone, is fixed, or "
             "is free.");
    v.option(HX_MEMBER(mandible_layer), "The loose layer over a mandible that moves.",
             {.key = "mandible_"});
    v.option(HX_MEMBER(field_pa_per_m),
             "Stiffness of an elastic foundation under the tissue, except over the mandible. Its "
             "base follows the motion interpolated between the driven points. 0: none.",
             kFoundation);
    v.option(HX_MEMBER(jaw_points),
             "Points whose motion rotates the jaw. Empty: those of the chin that the recording "
             "has. Where drive.by = \"muscles\" all driven points turn it, whatever is given here.",
             {.only_where = kNotByMuscles});
    v.option(HX_MEMBER(teeth_layer), "The layer between lips and teeth.", {.in_scene = false});
    v.option(HX_MEMBER(teeth_reach_m), "How far from the lips that layer reaches.",
             {.unit = kMillimetres, .bounds = {0, 0.1}, .in_scene = false});
    v.option(HX_MEMBER(throat_pa_per_m),
             "Stiffness of an elastic foundation under the floor of the mouth. 0: none.",
             {.unit = kKilopascalsPerMillimetre, .bounds = {0, 1e12}, .in_scene = false});
    v.option(HX_MEMBER(throat_reach_m), "How far from the jaw's edge that foundation follows it.",
             {.unit = kMillimetres, .bounds = {0.001, 1}, .in_scene = false});
  }
};

enum class BonePart { skull, maxilla, mandible, chin };
constexpr auto words_of(BonePart) {
  return std::array{Word{"skull", BonePart::skull}, Word{"maxilla", BonePart::maxilla},
                    Word{"mandible", BonePart::mandible}, Word{"chin", BonePart::chin}};
}

enum class BoneCut {
  standard,  ///< le_fort_1, bsso or genioplasty, as the part has it
  whole,     ///< no cut: the whole skull or mandible
  le_fort_1,
  bsso,
  genioplasty
};
constexpr auto words_of(BoneCut) {
  return std::array{Word{"standard", BoneCut::standard}, Word{"whole", BoneCut::whole},
                    Word{"le_fort_1", BoneCut::le_fort_1}, Word{"bsso", BoneCut::bsso},
                    Word{"genioplasty", BoneCut::genioplasty}};
}

/// A segment of bone that surgery moves (simulate/drive/osteotomy.hpp).
struct BoneMove {
  BonePart part = BonePart::mandible;
  BoneCut cut = BoneCut::standard;
  double cut_shift_m = 0;  ///< of the plane, from its standard place
  /// Along the axes of the face: to the subject's left, up, forward.
  std::vector<double> move_m = {0, 0, 0};
  /// About these axes, in this order.
  std::vector<double> turn_deg = {0, 0, 0};
  bool operator==(const BoneMove&) const = default;

  static constexpr const char* about = "A segment of bone that surgery moves.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(part),
             "The bone: the maxilla is the part of the skull below a cut, the chin that of the "
             "mandible.",
             {.required = true});
    v.option(HX_MEMBER(cut),
             "Where it is cut off: as is usual for the part (maxilla: le_fort_1; mandible: bsso; "
             "chin: genioplasty; skull: whole), or whole, without a cut.");
    v.option(HX_MEMBER(cut_shift_m),
             "How far the plane of the cut lies from its standard place: upwards, or forward for "
             "bsso.",
             {.unit = kMillimetres, .bounds = {-0.03, 0.03}});
    v.option(HX_MEMBER(move_m),
             "The movement along the axes of the face: to the subject's left, up, forward.",
             {.unit = kMillimetres, .bounds = {-0.03, 0.03}, .least = 3, .most = 3});
    v.option(HX_MEMBER(turn_deg),
             "Turns about these axes through the segment's centre (docs/surgery.md), in this "
             "order. Positive about the first: the front turns down; about the second: it turns to "
             "the left; about the third: the left side turns up.",
             {.unit = kDegrees, .bounds = {-30, 30}, .least = 3, .most = 3});
  }
};

/// What surgery changes before the recorded forces act.
struct SurgeryOptions {
  std::vector<BoneMove> bones;  ///< applied in turn
  bool operator==(const SurgeryOptions&) const = default;

  static constexpr const char* about =
      "Segments of bone that are moved before the expression begins. Forces must drive the face.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(
        HX_MEMBER(bones),
        "Segments of bone that are moved, one after the other: the mandible before the chin "
        "on it. The face at rest follows them, then the recorded forces act. The lips are kept "
        "from passing through each other, as with contact.lips.",
        {.key = "bone"});
  }
};

enum class DriveBy {
  displacement,  ///< patches of skin are carried to where the points are recorded
  muscles,       ///< forces: muscles, the jaw, and the residual at the points
  reactions      ///< forces: those that hold the patches of a run by displacement
};
constexpr auto words_of(DriveBy) {
  return std::array{Word{"displacement", DriveBy::displacement}, Word{"muscles", DriveBy::muscles},
                    Word{"reactions", DriveBy::reactions}};
}

struct DriveOptions {
  DriveBy by = DriveBy::displacement;
  /// Whatever `points` holds: every point of the motion that skin can follow.
  bool all_points = false;
  std::vector<std::string> points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57",
                                     "ibug68_8",  "ibug68_58", "ibug68_56"};
  std::vector<std::string> still_points;  ///< landmarks of the skin that are kept where they are
  double patch_radius_m = 0.008;          ///< of the skin that a point moves; 0: the nearest node
  double gain = 1;                        ///< on all displacements

  /// Names of the points of `motion` that drive, as given; not checked to be in it. With
  /// `all_points` those of the skull (Motion::skull_points) are left out, and `stomion`, the middle
  /// of the slit between the lips, which belongs to neither of them.
  std::vector<std::string> names_in(const motion::Motion& motion) const;
  bool operator==(const DriveOptions&) const = default;

  static constexpr const char* about = "What moves the face.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.one_or_all(
        HX_MEMBER(points), HX_MEMBER(all_points),
        "Points of the recording that drive the skin; \"all\": all but motion.rigid_points "
        "and stomion, which lies between the lips. Where none are named, brows and lids are "
        "added to the default where one of their points moves by 2 mm, nostrils by 3 mm; with "
        "motion.candide, default points that the model lacks are left out.");
    v.option(
        HX_MEMBER(by),
        "How the recorded points drive the face: the skin is carried to them, whatever the "
        "tissue; or muscles, the jaw and forces at the points are fitted to them "
        "(docs/muscles.md); or forces alone are. Forces are found once, in the scene's tissue, "
        "and variants respond to the same forces. Where it is not given, muscles drive, unless the "
        "variants say otherwise. A scene or variant that sets region.measured or a stiffness of "
        "[support] (in kPa/mm), which muscles do not use, is driven by displacement, with a "
        "warning. A run, hyperex check and the studio say which and why.",
        {.scene_default = "muscles"});
    v.option(HX_MEMBER(patch_radius_m),
             "Radius of the patch of skin that a driven point moves where the lips part; half as "
             "much again where they stay closed. 0 takes the nearest node alone. Muscles use it "
             "where at most 20 of the driven points lie below the nose; with more of them it is "
             "15 mm, whatever is given here. Where muscles drive, patches around points of the "
             "chin fade out over a further 20 mm, unless the radius is 0.",
             {.unit = kMillimetres, .bounds = {0, 0.03}});
    v.option(HX_MEMBER(still_points),
             "Landmarks of the skin that are fixed; none of them may be driven.");
    v.option(HX_MEMBER(gain), "Multiplies all displacements; 1 as recorded.",
             {.bounds = {0, 5}, .key = "motion.gain"});
  }
};

/// A factor on muscles' activations: of one ("zyg_major_R"), of a branch of the facial nerve on one
/// side ("zygomatic_R"), or of a side ("side_R").
struct MuscleGain {
  std::string muscle;
  double gain = 1;
  bool operator==(const MuscleGain&) const = default;

  static constexpr const char* about = "A factor on activations.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(muscle), "A muscle with its side, a branch with its side, or a side.");
    v.option(HX_MEMBER(gain), "Multiplies the activations.", {.bounds = {0, 5}});
  }
};

/// Muscles and what they pull against, where DriveOptions::by is `muscles`. The constants were
/// chosen together on one rig and two real faces (docs/muscles.md).
struct MuscleOptions {
  muscles::MuscleTable own;  ///< empty: muscles::muscle_template()
  const muscles::MuscleTable& table() const {
    return own.empty() ? muscles::muscle_template() : own;
  }
  std::vector<MuscleGain> gains;
  bool mirrored = false;  ///< each muscle takes the activation of its counterpart

  /// Used instead of the layers of SimulationOptions::support.
  BoneLayer skull_layer{2.5e6, 6e6}, mandible_layer{3.3e7, 1e7}, teeth_layer{3.1e5, 1.04e6};
  /// The ring of muscle in the lips is denser than other tissue: E is `lip_stiffening` times as
  /// large there, falling off as exp(-(d / lip_reach_m)^2) with the distance d to the lips' points.
  double lip_stiffening = 2, lip_reach_m = 0.0085;
  double foundation_pa_per_m = 3.1e5;  ///< under tissue over neither bone
  double teeth_reach_m = 0.013;
  double throat_pa_per_m = 1e6, throat_reach_m = 0.09;
  muscles::ForceShape shape;
  muscles::FoldShape fold;
  /// A pull's band grows with its activation a: of its force, a / (a + half) acts in a band
  /// `widening` times as wide.
  double widening = 2.3, half = 0.62;

  /// Error (1 sigma) of a point's displacement where few points are driven (kFewPoints).
  double few_sigma_m = 0.0008;
  double many_sigma_m = 0.0016;    ///< the same where more points are driven
  double activation_sigma = 0.29;  ///< prior 1 sigma of an activation
  double ring_sigma = 0.15;        ///< the same for muscles that act as rings
  double tone_sigma = 0.16;        ///< the same below rest, for muscles that may relax
  /// Prior 1 sigma of the jaw's slide aside, up and forward: its heads glide forward on the skull,
  /// and hardly aside.
  Vec3 slide_sigma_m{0.001, 0.003, 0.0045};
  /// Prior correlation of a muscle's activation with that of its counterpart.
  double side_correlation = 0.3;
  /// Radius of the patches of skin over which the residual at many points is spread; at few points
  /// it is DriveOptions::patch_radius_m.
  double many_patch_m = 0.015;
  /// In the patches around driven points, the displacement is a mixture: this share of the
  /// displacement by the muscle or the jaw, and the rest of the field interpolated between the
  /// points. In order: muscles of the cheek (TemplateMuscle::cheek) and all other muscles with few
  /// points, all muscles with many points, the jaw. A muscle may have its own share
  /// (TemplateMuscle::few_share).
  double few_cheek_share = 1, few_lip_share = 0.4, many_muscle_share = 0.6, jaw_share = 0.5;
  /// Between the driven points, the displacement of the skin by muscles is corrected towards that
  /// of shapes of real faces (shape_correction.hpp). Here: the standard deviation of the error of
  /// these shapes at a point, their share of the difference, the length over which it is smoothed,
  /// and the distances from the driven points at which the correction begins and reaches its full
  /// value.
  bool shape_prior = true;
  double shape_sigma_m = 0.0015, shape_share = 0.7, shape_smoothing_m = 0.008;
  double shape_clear_m = 0.0035, shape_reach_m = 0.012;
  bool operator==(const MuscleOptions&) const = default;

  /// The constants above are not options: only members that a scene may change are described.
  static constexpr const char* about = "Muscles, where they move the face (`drive.by`).";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.factors(HX_MEMBER(gains), [] { return muscles::gain_names(); },
              "Factors on activations as they were found: of one muscle, of those that a branch "
              "of the facial nerve moves on one side, or of a side; 0 is a palsy. Several "
              "multiply.",
              {.key = "gain"});
    v.option(HX_MEMBER(mirrored),
             "Each muscle takes the activation of its counterpart on the other side.");
    v.option(HX_MEMBER(shape_prior),
             "Between the driven points the skin follows the tissue and, in part, how real faces "
             "move with such points; false: the tissue alone.");
  }
};

enum class Strain {
  linear,  ///< small strain and rotation: one factorisation serves all steps
  finite   ///< any strain and rotation: a factorisation or more in each step
};
constexpr auto words_of(Strain) {
  return std::array{Word{"linear", Strain::linear}, Word{"finite", Strain::finite}};
}

/// The same without gains and mirroring: forces as they were found.
MuscleOptions as_recorded(MuscleOptions options);

/// The material law of the tissue, and the kind of element.
struct ModelOptions {
  fem::ElementKind element = fem::ElementKind::tet4_star;
  fem::ViscousForm viscous_form = fem::ViscousForm::isotropic;
  Strain strain = Strain::linear;
  fem::Hyperelastic law;  ///< of finite strain; E, nu and eta are TissueValues'
  bool operator==(const ModelOptions&) const = default;

  static constexpr const char* about = "What the tissue is made of, and its elements.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(viscous_form),
             "The viscous tensor: Stokes' law, or the tensor printed in the thesis "
             "(docs/theory.md), which is not isotropic.");
    v.option(HX_MEMBER(element),
             "The finite element: linear tetrahedra, plain, or with the change of volume averaged "
             "over patches, which does not lock near poisson = 0.5 (docs/elements.md).");
    v.option(HX_MEMBER(strain),
             "Small strain and rotation, where one factorisation serves all steps; or finite "
             "strain and rotation with a hyperelastic law, about ten times as slow "
             "(docs/mechanics.md).");
    v.option(HX_MEMBER(law), "", {.key = ""});
  }
};

/// One value everywhere or, where `element` is not empty (tissue/field), one per tetrahedron.
struct TissueValues {
  tissue::TissueParameters uniform = tissue::default_parameters;
  std::array<std::vector<double>, tissue::parameter_count> element{};  ///< of all or of none

  /// Volume at rest over that of the mesh, per tetrahedron; empty: 1.
  std::vector<double> volume_ratio = {};

  /// The material of `tets` tetrahedra. Asserts that the values are allowed (tissue::is_allowed).
  fem::Material material(std::size_t tets, fem::ViscousForm viscous_form) const;
  bool operator==(const TissueValues&) const = default;
};

enum class SolverMethod {
  reduced,  ///< projected onto the motions that the input makes, to a checked tolerance
  direct    ///< all unknowns at every step
};
constexpr auto words_of(SolverMethod) {
  return std::array{Word{"reduced", SolverMethod::reduced}, Word{"direct", SolverMethod::direct}};
}

struct SolverOptions {
  SolverMethod method = SolverMethod::reduced;
  double tolerance = 1e-3;     ///< of the reduced model, over the greatest displacement
  double newmark_beta = 0.25;  ///< 2 beta >= gamma
  double newmark_gamma = 0.5;
  bool verify = false;  ///< run the full model too and measure the reduced one's error
  /// At finite strain: length of a step, halved where it does not converge. 0: that of a frame.
  double finite_step_s = 0;
  /// At finite strain: error of a step's iterations over the greatest displacement.
  double finite_tolerance = 1e-3;
  bool full_newton = false;  ///< at finite strain: factor the matrix in each iteration
  bool operator==(const SolverOptions&) const = default;

  static constexpr const char* about = "How the equations of motion are solved.";
  template <class Visitor>
  static void describe(Visitor& v) {
    constexpr const char* finite = fem::Hyperelastic::only_where;
    v.option(HX_MEMBER(method),
             "A reduced model: the equations projected onto the modes that the input excites, to "
             "solver.tolerance; or all degrees of freedom at every step.");
    v.option(HX_MEMBER(tolerance),
             "Allowed error of the reduced model by its own estimate, relative to the largest "
             "displacement.",
             {.bounds = {1e-9, 0.1}});
    v.option(HX_MEMBER(newmark_beta), "beta of Newmark's method.", {.bounds = {0.25, 1}});
    v.option(HX_MEMBER(newmark_gamma),
             "gamma (delta) of Newmark's method; above 0.5 it damps. At most twice "
             "solver.newmark_beta.",
             {.bounds = {0.5, 1}});
    v.option(HX_MEMBER(verify),
             "Run the full model too and report the true error of the reduced one.");
    // Shorter steps would take impractically long.
    v.option(HX_MEMBER(finite_step_s),
             "The time step where tissue.strain = \"finite\"; it is halved where it does not "
             "converge. 0: the time between frames.",
             {.unit = kSeconds, .bounds = {1e-4, 0.5, false, true}, .only_where = finite});
    v.option(HX_MEMBER(finite_tolerance),
             "Error of a step's iterations at finite strain, relative to the largest displacement.",
             {.bounds = {1e-9, 0.1}, .only_where = finite});
    v.option(HX_MEMBER(full_newton),
             "At finite strain, factorise the matrix in each iteration and not once per step.",
             {.only_where = finite});
  }
};

/// Contact: bodies that tissue may not pass through (mouth_contact.hpp). Streams have no contact.
struct ContactOptions {
  bool lips = false;  ///< lips with each other
  bool teeth =
      false;          ///< the inner side of the tissue with the teeth of Simulator::set_obstacles()
  bool eyes = false;  ///< the lids with its eyeballs
  bool any() const { return lips || teeth || eyes; }
  /// Patches of skin with prescribed motion (DriveBy::displacement) yield to contact like springs
  /// of this stiffness per area. Without contact they follow their prescribed motion.
  double patch_pa_per_m = 2e8;
  /// If forces drive: contact moves driven points near the lips only by this share of the tissue's
  /// own compliance. The recording already contains the effect of contact on these points.
  double point_give = 0.5;
  bool operator==(const ContactOptions&) const = default;

  static constexpr const char* about = "Which surfaces may not pass through each other.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(lips),
             "The lips may touch but not pass through each other, without friction. Each frame is "
             "corrected separately, in static equilibrium. Recorded points then end where they are "
             "recorded only as far as no lip is in their way. The default is true at linear "
             "strain. It is false where tissue.strain is \"finite\" in the scene or a variant, as "
             "contact there takes minutes.",
             {.scene_default = "true"});
    v.option(HX_MEMBER(teeth),
             "The inner side of lips and cheeks may touch the teeth of both jaws but not pass "
             "through them, in the same way. The lower teeth move with the jaw.");
    v.option(HX_MEMBER(eyes),
             "The lids may touch eyeballs, which are fitted behind them, but not pass through "
             "them, in the same way.");
    v.option(HX_MEMBER(patch_pa_per_m),
             "Stiffness of the springs that hold driven patches where something touches.",
             {.unit = kKilopascalsPerMillimetre, .bounds = {1e5, 1e12}, .in_scene = false});
    v.option(HX_MEMBER(point_give),
             "Where forces drive: how far driven points yield, relative to the tissue's own "
             "compliance.",
             {.bounds = {1e-6, 1e6}, .in_scene = false});
  }
};

struct TimeOptions {
  double step_s = 0.002;
  double end_s = 0;  ///< 0: the end of the motion; past it, its last sample is held
  double frame_rate_hz = 30;
  double peak_time_s = -1;            ///< below 0: where the driven points moved most in the mean
  std::vector<double> still_times_s;  ///< extra shapes wanted, for pictures
  bool operator==(const TimeOptions&) const = default;

  static constexpr const char* about = "Steps and frames.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(step_s), "The time step.", {.unit = kSeconds, .bounds = {1e-6, 0.1}});
    v.option(HX_MEMBER(end_s),
             "When the simulation ends, counted from its start and not from the recording's; after "
             "the recording its last sample is kept. 0: at the end of the recording.",
             {.unit = kSeconds, .bounds = {0, 600}});
    v.option(
        HX_MEMBER(frame_rate_hz),
        "Frames written per second, from 0 to the end: a run of 1 s at 30 Hz has 31, the last at "
        "1 s. They need not coincide with time steps.",
        {.unit = kHertz, .bounds = {1, 1000}});
    v.option(HX_MEMBER(peak_time_s),
             "Time of skin_peak.ply. Below 0: when the mean displacement of the driven points is "
             "greatest.",
             {.unit = kSeconds, .bounds = {-1, 600}, .key = "output.peak_time_s"});
    v.option(HX_MEMBER(still_times_s),
             "Times of the pictures in contact_sheet.png. None: five times over the run, with the "
             "peak among them.",
             {.unit = kSeconds, .bounds = {0, 600}, .key = "output.picture_times_s", .most = 12});
  }
};

/// How many frames a run of `end_s` has: at 0, 1 / frame_rate_hz, 2 / frame_rate_hz, ... up to and
/// with its end, so that the last sample of a recording is written too. At least 1.
int frame_count(const TimeOptions& time, double end_s);

/// The input at all steps is kept: more would fill the memory.
inline constexpr double kMostSteps = 2e6;

struct SimulationOptions {
  ModelOptions model;
  TissueValues tissue;
  SupportOptions support;
  DriveOptions drive;
  MuscleOptions muscles;
  RegionOptions region;
  SolverOptions solver;
  ContactOptions contact;
  SurgeryOptions surgery;
  TimeOptions time;
  bool operator==(const SimulationOptions&) const = default;

  static constexpr const char* about = "All options of a Simulator.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(model), ModelOptions::about);
    v.option(HX_MEMBER(tissue), "The material: a Tissue.");
    v.option(HX_MEMBER(support), SupportOptions::about);
    v.option(HX_MEMBER(drive), DriveOptions::about);
    v.option(HX_MEMBER(muscles), MuscleOptions::about);
    v.option(HX_MEMBER(region), RegionOptions::about);
    v.option(HX_MEMBER(solver), SolverOptions::about);
    v.option(HX_MEMBER(contact), ContactOptions::about);
    v.option(HX_MEMBER(surgery), SurgeryOptions::about);
    v.option(HX_MEMBER(time), TimeOptions::about);
  }
};

/// The cut that BoneCut::standard means.
BoneCut usual_cut(BonePart part);

/// In words, the cuts that the part of `move` may have; empty where its cut is one of them.
std::string expected_cut(const BoneMove& move);

/// Throws InputError naming each option that is out of its bounds, and each conflict.
void check(const SimulationOptions& options);

}  // namespace hyperex::simulate
