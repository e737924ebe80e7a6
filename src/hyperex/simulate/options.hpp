// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Everything that a simulation can be told: each option, its default and its range stand here and
// nowhere else. Scene files and bindings fill these structs.
#include <array>
#include <string>
#include <vector>

#include "hyperex/core/bounds.hpp"
#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/fem/solve/linear_solver.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/muscles/force_shape.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::simulate {

enum class Measured { none, all, points };

/// Which part of the skin follows the recording directly; the rest is physical.
struct RegionOptions {
  Measured measured = Measured::none;
  std::vector<std::string> measured_points;  ///< at least one where measured is `points`
  double measured_radius_m = 0.015;          ///< of the skin around them
  double blend_m = 0.005;                    ///< over which measured passes into physical
  static constexpr Bounds measured_radius_m_in{0.001, 0.2}, blend_m_in{0, 0.1};
  bool operator==(const RegionOptions&) const = default;
};

enum class Hold { held, sliding, free };
enum class Mandible { follow, held, free };

/// The tissue slides on the bone on a layer of loose tissue: springs per area between the inner
/// surface and the bone, stiff across the layer, soft along it.
struct BoneLayer {
  double across_pa_per_m = 0, along_pa_per_m = 0;
  bool operator==(const BoneLayer&) const = default;
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
  /// Lips on the teeth: springs per area at the inner surface within `teeth_reach_m` of the lips,
  /// where neither skull nor mandible is; those of the lower lip follow the jaw. 0: none.
  BoneLayer teeth_layer{0, 0};
  double teeth_reach_m = 0.014;
  /// The floor of the mouth hangs between the edge of the mandible and the neck: springs per area
  /// at the inner surface below that edge, towards the motion of its nearest point times
  /// exp(-(d / throat_reach_m)^2) at the distance d to it. 0: none.
  double throat_pa_per_m = 0, throat_reach_m = 0.09;
  std::vector<std::string> jaw_points;  ///< that carry the jaw; empty: chin points among the driven
  static constexpr Bounds stiffness_pa_per_m_in{0, 1e12};  ///< of each of the five
  bool operator==(const SupportOptions&) const = default;
};

enum class DriveBy {
  displacement,  ///< patches of skin are carried to where the points are recorded
  muscles,       ///< forces: muscles, the jaw, and what they leave over at the points
  reactions      ///< forces: those that hold the patches of a run by displacement
};

struct DriveOptions {
  DriveBy by = DriveBy::displacement;
  bool all_points = false;  ///< every point of the motion, whatever `points` holds
  std::vector<std::string> points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57",
                                     "ibug68_8",  "ibug68_58", "ibug68_56"};
  std::vector<std::string> still_points;  ///< landmarks of the skin that are kept where they are
  double patch_radius_m = 0.008;          ///< of the skin that a point moves; 0: the nearest node
  double gain = 1;                        ///< on all displacements
  static constexpr Bounds patch_radius_m_in{0, 0.03};

  /// Names of the points of `motion` that drive, as given; not checked to be in it.
  const std::vector<std::string>& names_in(const motion::Motion& motion) const {
    return all_points ? motion.names : points;
  }
  bool operator==(const DriveOptions&) const = default;
};

/// A factor on muscles' activations: of one ("zyg_major_R"), of a branch of the facial nerve on one
/// side ("zygomatic_R"), or of a side ("side_R").
struct MuscleGain {
  std::string muscle;
  double gain = 1;
  bool operator==(const MuscleGain&) const = default;
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
  static constexpr Bounds gain_in{0, 5};

  /// In the place of SimulationOptions::support's layers.
  BoneLayer skull_layer{2.5e6, 4.8e6}, mandible_layer{3.3e7, 1e7}, teeth_layer{3.1e5, 1.04e6};
  /// The ring of muscle in the lips is denser than other tissue: E is `lip_stiffening` times as
  /// large there, falling off as exp(-(d / lip_reach_m)^2) with the distance d to the lips' points.
  double lip_stiffening = 3.2, lip_reach_m = 0.0085;
  double foundation_pa_per_m = 3.1e5;  ///< under tissue over neither bone
  double teeth_reach_m = 0.013;
  double throat_pa_per_m = 1e6, throat_reach_m = 0.09;
  muscles::ForceShape shape;
  /// A pull's band grows with its activation a: of its force, a / (a + half) acts in a band
  /// `widening` times as wide.
  double widening = 2.3, half = 0.62;

  /// 1 sigma: of the error of a point's displacement where few points are driven (up to
  /// kFewPoints) and where many are; of an activation before a point is seen, on the side below
  /// rest of those that may relax; of rings; of the jaw's slide.
  double few_sigma_m = 0.0008, many_sigma_m = 0.0016;
  double activation_sigma = 0.406, ring_sigma = 0.12, tone_sigma = 0.09, slide_sigma_m = 0.0028;
  /// Correlation of a muscle's activation with that of its counterpart, before a point is seen.
  double side_correlation = 0.3;
  /// Radius of the patches of skin at many points, over which what muscles leave over is spread; at
  /// few it is DriveOptions::patch_radius_m.
  double many_patch_m = 0.015;
  /// In the patches around driven points: this share of the shape that a muscle or the jaw gives
  /// the skin there, the rest of the field between the points; 1: all of it. Of muscles of the
  /// cheek (TemplateMuscle::cheek) and of all others at few points, of all muscles at many, of the
  /// jaw.
  double few_cheek_share = 0.65, few_lip_share = 0.3, many_muscle_share = 0.4, jaw_share = 0.6;
  bool operator==(const MuscleOptions&) const = default;
};

enum class Strain {
  linear,  ///< small strain and rotation: one factorisation serves all steps
  finite   ///< any strain and rotation: a factorisation or more in each step
};

/// The same without gains and mirroring: forces as they were found.
MuscleOptions as_recorded(MuscleOptions options);

/// What the tissue is made of, and the elements that stand for it.
struct ModelOptions {
  fem::ElementKind element = fem::ElementKind::tet4_star;
  fem::ViscousForm viscous_form = fem::ViscousForm::isotropic;
  Strain strain = Strain::linear;
  fem::Hyperelastic law;  ///< of finite strain; E, nu and eta are TissueValues'
  bool operator==(const ModelOptions&) const = default;
};

/// One value everywhere, or where `element` is not empty (tissue/field) one a tetrahedron.
struct TissueValues {
  tissue::TissueParameters uniform = tissue::default_parameters;
  std::array<std::vector<double>, tissue::parameter_count> element{};  ///< of all or of none

  /// Of `tets` tetrahedra. Values are allowed ones (tissue::is_allowed): asserted.
  fem::Material material(std::size_t tets, fem::ViscousForm viscous_form) const;
  bool operator==(const TissueValues&) const = default;
};

enum class SolverMethod {
  reduced,  ///< projected onto the motions that the input makes, to a checked tolerance
  direct    ///< all unknowns at every step
};

struct SolverOptions {
  SolverMethod method = SolverMethod::reduced;
  fem::LinearSolver linear = fem::LinearSolver::automatic;
  double tolerance = 1e-3;     ///< of the reduced model, over the greatest displacement
  double newmark_beta = 0.25;  ///< 2 beta >= gamma
  double newmark_gamma = 0.5;
  bool verify = false;  ///< run the full model too and measure the reduced one's error
  /// Of finite strain: the length of a step (0: that of a frame), halved where it does not
  /// converge; the error of the iterations in a step over the greatest displacement; whether the
  /// matrix is factored anew in each of them.
  double finite_step_s = 0, finite_tolerance = 1e-3;
  bool full_newton = false;
  static constexpr Bounds finite_step_s_in{0, 0.5}, finite_tolerance_in{1e-9, 0.1};
  static constexpr Bounds tolerance_in{1e-9, 0.1}, newmark_beta_in{0.25, 1},
      newmark_gamma_in{0.5, 1};
  bool operator==(const SolverOptions&) const = default;
};

/// What tissue may not pass through (mouth_contact.hpp). Streams know no contact.
struct ContactOptions {
  bool lips = false;   ///< the lips each other
  bool teeth = false;  ///< the mouth's side of the tissue those of Simulator::set_obstacles()
  bool eyes = false;   ///< the lids the eyeballs, likewise
  bool any() const { return lips || teeth || eyes; }
  /// Patches of skin that are carried to where points are recorded (DriveBy::displacement) give way
  /// to contact as springs per area of this stiffness; without contact they end where they are
  /// driven.
  double patch_pa_per_m = 2e8;
  /// Where forces drive, driven points near the lips stay where the motion without contact has
  /// them, but for this share of the tissue's own compliance: what touches in a recording touched
  /// already when it was recorded.
  double point_give = 0.5;
  static constexpr Bounds patch_pa_per_m_in{1e5, 1e12}, point_give_in{1e-6, 1e6};
  bool operator==(const ContactOptions&) const = default;
};

struct TimeOptions {
  double step_s = 0.002;
  double end_s = 0;  ///< 0: the end of the motion; past it, its last sample is held
  double frame_rate_hz = 30;
  double peak_time_s = -1;            ///< below 0: where the driven points moved most in the mean
  std::vector<double> still_times_s;  ///< extra shapes wanted, for pictures
  static constexpr Bounds step_s_in{1e-6, 0.1}, end_s_in{0, 600}, frame_rate_hz_in{1, 1000},
      peak_time_s_in{-1, 600}, still_times_s_in{0, 600};
  bool operator==(const TimeOptions&) const = default;
};

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
  TimeOptions time;
  bool operator==(const SimulationOptions&) const = default;
};

/// Throws InputError naming each option that is out of its range, with its value and the range.
void check(const SimulationOptions& options);

}  // namespace hyperex::simulate
