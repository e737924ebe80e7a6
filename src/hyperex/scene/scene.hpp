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
#include "hyperex/core/kept_results.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "hyperex/tissue/options.hpp"

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
  std::vector<motion::PointGain> point_gains;  ///< besides, on single points, each 0 to 5
  double time_scale = 1;                       ///< 2: twice as slow; 0.05 to 20
};

struct AlignmentOptions {
  simulate::AlignmentMethod method = simulate::AlignmentMethod::nonrigid;
};

enum class TeethShape { arch, none };

struct TeethOptions {
  TeethShape shape = TeethShape::arch;  ///< of a jaw of which no file is given
  std::filesystem::path upper, lower;   ///< scans of teeth, in the frame of the scan
  std::optional<io::LengthUnit> unit;   ///< of both; none: the scan's ("scan")
};

struct OutputOptions {
  bool vtu = true, glb = true, report = true;
  int vtu_every = 1;              ///< every so many frames; 1 to 10000
  bool vtu_strain = true;         ///< the strain tensor in them
  bool variants_vtu = false;      ///< frames of each variant too
  double glb_tolerance_m = 1e-4;  ///< of any vertex in any frame; 0.01 to 10 mm
  double glb_max_mb = 20;         ///< of performance.glb; 0.1 to 10000
  bool full_paths = false;        ///< of input files, in summary.json and report.html
  double symmetry_floor = 1e-6;   ///< > 0, to 1
  double lowpass_hz = 6;          ///< cut-off for speeds and paths, 0 (none) to 100
  double jitter_m = -1e-3;  ///< of the recorded points; below 0: estimated from them; to 20 mm
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
  tissue::TissueMeshOptions mesh;
  tissue::TissueFieldOptions tissue;
  simulate::ModelOptions model;
  simulate::RegionOptions region;
  simulate::SupportOptions support;
  simulate::MuscleOptions muscles;  ///< `own`: the program's as the two below change it
  std::filesystem::path muscles_file;
  std::vector<std::string> muscles_without;
  simulate::DriveOptions drive;  ///< gain: of the key motion.gain
  simulate::ContactOptions contact;
  TeethOptions teeth;
  simulate::SolverOptions solver;
  /// peak_time_s, still_times_s (up to 12; none: spread_frames()): of the section output.
  simulate::TimeOptions time;
  OutputOptions output;
  std::vector<Variant> variants;  ///< [[variant]], in the file's order

  std::filesystem::path file;             ///< the scene file
  std::map<std::string, Origin> origins;  ///< of each key that was given, e.g. "time.step_s"
  KeptResults kept;  ///< where found landmarks and tracked recordings are kept; nowhere by default
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

/// The same of a text that stands in the place of the file's own; the file need not be there.
Scene read_scene_text(const std::string& text, const std::filesystem::path& file);

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
