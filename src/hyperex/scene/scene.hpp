// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A scene: everything one run needs, as plain options. Lengths in metres, SI throughout; the units
// in the names of the file's keys (docs/scene.md) are converted when the file is read.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/reenact/alignment.hpp"
#include "hyperex/reenact/simulation.hpp"
#include "hyperex/tissue/field/options.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::scene {

/// A file of the user's, or what the program carries inside ("embedded" in the scene file).
struct Source {
  bool embedded = false;
  std::filesystem::path file;  ///< empty where embedded
};

struct ScanOptions {
  Source source;                       ///< required; embedded: the canonical face
  std::optional<io::LengthUnit> unit;  ///< none: guessed from the size ("guess")
  std::filesystem::path landmarks;     ///< empty: found on the scan, or the embedded face's own
  std::optional<io::LengthUnit> landmarks_unit;  ///< none: as the file says ("file")
};

struct MotionOptions {
  // One of these four is required.
  Source source;                          ///< named points; embedded: a mouth opening, 2.7 s
  std::filesystem::path recording;        ///< of a camera: a folder or a file
  std::filesystem::path openface, arkit;  ///< expressions: action units, blend shapes
  std::filesystem::path candide;       ///< CANDIDE-3's file, which they move; empty: canonical face
  std::optional<io::LengthUnit> unit;  ///< none: as the file says ("file")
  bool mirrored = false;               ///< the recording's pictures are a mirror's
  std::vector<std::string> rigid_points;  ///< carry the head's pose; empty: chosen automatically
  /// Seconds from the start at which the face is at rest: none (the first sample), one time, or
  /// from and to; each 0 to 3600.
  std::vector<double> rest_s;
  double max_gap_s = 0.2;                      ///< longest gap that is interpolated, 0 to 10
  double gain = 1;                             ///< on all displacements, 0 to 5
  std::vector<motion::PointGain> point_gains;  ///< besides, on single points, each 0 to 5
  double time_scale = 1;                       ///< 2: twice as slow; 0.05 to 20
};

using reenact::AlignmentMethod;
struct AlignmentOptions {
  AlignmentMethod method = AlignmentMethod::nonrigid;
};

using reenact::Measured;
struct RegionOptions {
  Measured measured = Measured::none;
  std::vector<std::string> measured_points;  ///< at least one where measured is `points`
  double measured_radius_m = 0.015;          ///< 1 to 200 mm
  double blend_m = 0.005;                    ///< 0 to 100 mm
};

using tissue::LipCut;
struct ThicknessPoint {
  std::string landmark;
  double thickness_m = 0.01;  ///< 1 to 40 mm
};
struct MeshOptions {
  double element_size_m = 0.0033;  ///< 0.5 to 30 mm
  int layers = 2;                  ///< 1 to 8
  double thickness_m = 0;          ///< 0: published depths, else the same everywhere (1 to 40 mm)
  LipCut cut_lips = LipCut::automatic;
  double trim_border_m = 0;                      ///< 0 to 50 mm
  std::vector<ThicknessPoint> thickness_points;  ///< empty unless thickness_m is 0
};

struct TissueOptions {
  double young_pa = 192.4e3;      ///< > 0, to 1 GPa
  double poisson = 0.495;         ///< -0.99 to 0.4999
  double viscosity_pa_s = 476.8;  ///< 0 to 1e7
  double density_kg_m3 = 1100;    ///< > 0, to 20000
  fem::ViscousForm viscous_form = fem::ViscousForm::isotropic;
  fem::ElementKind element = fem::ElementKind::tet4_star;
  std::string preset;  ///< empty: none
  tissue::Interpolation interpolation = tissue::Interpolation::harmonic;
  bool mirror = false;
  std::filesystem::path per_vertex;  ///< empty: none
  std::vector<tissue::TissuePoint> points;
  std::vector<tissue::TissueRegion> regions;
};

using reenact::BoneLayer;
using reenact::Hold;
using reenact::Mandible;
struct SupportOptions {
  bool border_held = true;
  Hold skull = Hold::sliding;
  BoneLayer skull_layer{1e7, 1e7};  ///< where the skull is sliding; each 0 to 1e12 Pa/m
  Mandible mandible = Mandible::follow;
  BoneLayer mandible_layer{3e7, 1e7};   ///< where the mandible is followed
  double muscle_pa_per_m = 5e6;         ///< 0 to 1e12
  std::vector<std::string> jaw_points;  ///< empty: chosen automatically
};

struct DriveOptions {
  bool all_points = false;  ///< every point of the motion; `points` is then empty
  std::vector<std::string> points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57",
                                     "ibug68_8",  "ibug68_58", "ibug68_56"};
  double patch_radius_m = 0.008;          ///< 0 to 30 mm
  std::vector<std::string> still_points;  ///< held still on the skin
};

using reenact::SolverMethod;
struct SolverOptions {
  SolverMethod method = SolverMethod::reduced;
  fem::LinearSolver linear = fem::LinearSolver::automatic;
  double tolerance = 1e-3;                          ///< 1e-9 to 0.1, of the largest displacement
  double newmark_beta = 0.25, newmark_gamma = 0.5;  ///< 2 beta >= gamma >= 1/2, at most 1
  bool verify = false;
};

struct TimeOptions {
  double step_s = 0.002;      ///< 1e-6 to 0.1
  double end_s = 0;           ///< 0: the end of the motion; to 600
  double frame_rate_hz = 30;  ///< 1 to 1000
};

struct OutputOptions {
  double peak_time_s = -1;  ///< below 0: where the driven points moved most in the mean; to 600
  bool vtu = true, glb = true, report = true;
  int vtu_every = 1;              ///< every so many frames; 1 to 10000
  bool vtu_strain = true;         ///< the strain tensor in them
  bool variants_vtu = false;      ///< frames of each variant too
  double glb_tolerance_m = 1e-4;  ///< of any vertex in any frame; 0.01 to 10 mm
  double glb_max_mb = 20;         ///< of performance.glb; 0.1 to 10000
  bool full_paths = false;        ///< of input files, in summary.json and report.html
  double symmetry_floor = 1e-6;   ///< > 0, to 1
  double lowpass_hz = 6;          ///< cut-off for speeds and paths, 0 (none) to 100
  double jitter_m = -1e-3;  ///< of the recorded points; below 0: from tracking, else none; to 20 mm
  std::vector<double> contact_times_s;  ///< up to 12, rising, 0 to 600; empty: spread_frames()
};

/// Where a value came from.
struct Origin {
  std::filesystem::path file;  ///< the scene file, or "--set"
  int line = 0;                ///< 1-based; 0 where a line means nothing
};

struct Variant;

struct Scene {
  std::string title;
  ScanOptions scan;
  MotionOptions motion;
  AlignmentOptions alignment;
  RegionOptions region;
  MeshOptions mesh;
  TissueOptions tissue;
  SupportOptions support;
  DriveOptions drive;
  SolverOptions solver;
  TimeOptions time;
  OutputOptions output;
  std::vector<Variant> variants;  ///< [[variant]], in the file's order

  std::filesystem::path file;             ///< the scene file
  std::map<std::string, Origin> origins;  ///< of each key that was given, e.g. "time.step_s"
};

/// The same face and motion with other tissue, support or drive: what a run compares with the
/// scene itself.
struct Variant {
  std::string name;        ///< printable ASCII
  std::string folder;      ///< of its outputs: the name, '_' for what is awkward in a path
  nlohmann::json changes;  ///< "tissue.young_kpa": 400, as given
  Scene scene;             ///< with the changes; its own variants are empty
};

/// Sections whose keys a variant may change: what a run does again for each of them.
const std::vector<std::string>& variant_sections();

/// Reads a scene file (TOML, docs/scene.md), then `overrides` ("KEY=VALUE", the last wins, VALUE in
/// TOML or a bare string). Paths in the file are relative to it, those of overrides to the current
/// folder. Throws InputError with all problems at once, a line each: a torn file, unknown keys,
/// wrong types, values out of range, keys or files that are missing.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same problems, not thrown; empty for a sound scene.
std::vector<InputProblem> problems_of(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides = {});

/// A problem found later (e.g. a point that the motion does not hold) with the value of `key`,
/// pointing to where that was given.
InputProblem problem_at(const Scene& scene, const std::string& key, const std::string& expected);

/// All options by section and key, in the units of the key names, defaults included.
nlohmann::json options_json(const Scene& scene);

/// The page docs/scene.md: every key with its type, unit, default and allowed values.
std::string reference_markdown();

}  // namespace hyperex::scene
