// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A scene: all options of a run. Lengths are in metres, all units SI. The units in the names of the
// file's keys (docs/scene.md) are converted when the file is read.
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::scene {

/// A file of the user, or data that are part of the program ("embedded" in the scene file).
struct Source {
  bool embedded = false;
  std::filesystem::path file;  ///< empty where embedded
};

struct ScanOptions {
  Source source;                       ///< required; embedded: the canonical face
  std::optional<io::LengthUnit> unit;  ///< none: guessed from the size ("guess")
  std::filesystem::path landmarks;     ///< empty: found on the scan, or those of the embedded face
  std::optional<io::LengthUnit> landmarks_unit;  ///< none: as the file says ("file")

  static constexpr const char* about = "The face at rest.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(source),
             "The scan: PLY, OBJ, STL, glTF or GLB; or the face that comes with the program.",
             {.key = "file", .required = true});
    v.option(HX_MEMBER(unit),
             "The scan's unit of length. A guess takes the one that makes the face 10 to 30 cm "
             "wide, and says so.",
             {.none = "guess"});
    v.option(HX_MEMBER(landmarks),
             "Named points on the scan: JSON as in docs/landmarks.md, or 3D Slicer's .mrk.json. "
             "Where none is given they are found by the landmark network.");
    v.option(HX_MEMBER(landmarks_unit),
             "The landmarks' unit of length, where it is not the one that their file states.",
             {.none = "file"});
  }
};

struct MotionOptions {
  // One of these four is required.
  Source source;                          ///< named points; embedded: a mouth opening of 2.7 s
  std::filesystem::path recording;        ///< of a camera: a folder or a file
  std::filesystem::path openface, arkit;  ///< expressions: action units, blend shapes
  std::filesystem::path candide;       ///< file of the face model CANDIDE-3; empty: canonical face
  std::filesystem::path rig;           ///< file of a rig that the expressions move; empty: no rig
  std::optional<io::LengthUnit> unit;  ///< none: as the file says ("file")
  bool mirrored = false;               ///< whether the recording's pictures are mirrored
  std::vector<std::string> rigid_points;  ///< determine the head pose; empty: chosen automatically
  /// When the face is at rest, in seconds from the start: empty (the first sample), one time, or a
  /// start and an end.
  std::vector<double> rest_s;
  double start_s = 0;                          ///< where the run begins in the recording
  double max_gap_s = 0.2;                      ///< longest gap that is interpolated
  std::vector<motion::PointGain> point_gains;  ///< in addition to motion.gain
  double time_scale = 1;                       ///< 2: twice as slow

  static constexpr const char* about = "The recorded expression.";
  template <class Visitor>
  static void describe(Visitor& v) {
    describe_sources(v);
    v.option(HX_MEMBER(unit),
             "The recording's unit of length, where it is not the one that the file states.",
             {.none = "file"});
    v.option(HX_MEMBER(rigid_points),
             "Points that move with the skull: the head pose is estimated from them and removed. "
             "Empty: all landmarks of the face, each with a weight that falls with how much it "
             "moves in life; at least three of eye corners, bridge of the nose and temples are "
             "needed.",
             {.least = 3});
    v.option(HX_MEMBER(rest_s),
             "When the face is at rest, from the recording's start: a time, or [from, to], over "
             "which the mean is taken. All displacements are from there. Where the recording "
             "starts in an expression the run begins half a second earlier, at rest, and is led "
             "into it. Empty: the recording's first sample is at rest.",
             {.unit = kSeconds, .bounds = {0, 3600}, .most = 2});
    v.option(HX_MEMBER(start_s),
             "Where in the recording the run begins, in the recording's own seconds; what comes "
             "before is left out, but rest is still where motion.rest_s says. The run leads the "
             "face from rest into it within half a second. time.end_s and all times of outputs "
             "count from the run's beginning.",
             {.unit = kSeconds, .bounds = {0, 36000}, .key = "time.start_s"});
    v.option(HX_MEMBER(max_gap_s),
             "The longest gap in a point's track that is interpolated; a longer one is refused.",
             {.unit = kSeconds, .bounds = {0, 10}});
    v.option(HX_MEMBER(point_gains),
             "A gain on one point, in addition to motion.gain. Other points keep their motion; the "
             "skin between them and the jaw follow the changed point as they follow every driven "
             "point.",
             {.key = "point_gain"});
    v.option(HX_MEMBER(time_scale),
             "Stretches the recording in time: 2 plays it twice as slowly. Gaps and jitter are "
             "judged as recorded; times of time and output are not stretched.",
             {.bounds = {0.05, 20}});
  }

 private:
  template <class Visitor>
  static void describe_sources(Visitor& v) {
    v.option(HX_MEMBER(source),
             "The recording, as named points over time: CSV or TRC; or the mouth opening of 2.7 s "
             "that comes with the program. One of motion.file, motion.recording, motion.openface "
             "and motion.arkit is required; one given by --set replaces the one in the file.",
             {.key = "file"});
    v.option(HX_MEMBER(recording),
             "The recording of a camera, colour and depth: a folder in TUM's layout, a video or "
             ".oni file. The face in it is tracked, as by hyperex track.",
             {.folder_too = true});
    v.option(
        HX_MEMBER(mirrored),
        "The pictures of motion.recording show the world as a mirror does (many selfie videos "
        "do) and are turned back. A video does not state this, and left and right depend on it.");
    v.option(HX_MEMBER(openface),
             "Action-unit intensities over time: a CSV file of OpenFace 2. They move the face "
             "model, whose points are then the recording.");
    v.option(HX_MEMBER(arkit),
             "ARKit blend-shape weights over time: a CSV file with a column time_s, or as Live "
             "Link Face writes it. They move the face model in the same way.");
    v.option(HX_MEMBER(candide),
             "CANDIDE-3's .wfm file, to be the face model for motion.recording, motion.openface "
             "and motion.arkit. Empty: the canonical face.");
    v.option(HX_MEMBER(rig),
             "A glTF or GLB file with morph targets of ARKit's names, as hyperex rig writes it: "
             "motion.arkit or motion.openface moves this rig in place of the canonical face, and "
             "its points are then the recording. Empty: no rig.");
  }
};

struct AlignmentOptions {
  simulate::AlignmentMethod method = simulate::AlignmentMethod::nonrigid;

  static constexpr const char* about = "How the recording is transferred to the scan.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(method),
             "How the recording is aligned with the scan: by a similarity transform of the "
             "landmarks and a smooth correction, by the similarity transform alone, or by the "
             "widths and heights of parts of the face about the nose apex.");
  }
};

enum class TeethShape { arch, none };
constexpr auto words_of(TeethShape) {
  return std::array{Word{"arch", TeethShape::arch}, Word{"none", TeethShape::none}};
}

struct TeethOptions {
  TeethShape shape = TeethShape::arch;  ///< for a jaw without a file
  std::filesystem::path upper, lower;   ///< scans of teeth, in the frame of the scan
  std::optional<io::LengthUnit> unit;   ///< of both; none: that of the scan ("scan")

  static constexpr const char* about =
      "The teeth behind the lips. They are drawn; with contact.teeth the tissue touches them.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(shape),
             "The teeth of a jaw without a scan of its own: an average dental arch fitted behind "
             "lips and cheeks (docs/teeth.md), or none.");
    v.option(HX_MEMBER(upper),
             "A scan of the upper teeth with their gums, in the coordinates of the face scan: PLY, "
             "OBJ, STL, glTF or GLB. Holes are filled.");
    v.option(HX_MEMBER(lower),
             "The same for the lower teeth, in the position at rest. They move with the jaw.");
    v.option(HX_MEMBER(unit),
             "The unit of length of these scans, where it is not that of the face scan.",
             {.none = "scan"});
  }
};

struct AnatomyOptions {
  std::filesystem::path ct;               ///< a folder that hyperex ct wrote
  std::filesystem::path skull, mandible;  ///< surfaces, in the frame of the CT or else of the scan
  std::optional<io::LengthUnit> unit;     ///< of both; none: mm with a CT, else that of the scan
  bool any() const { return !ct.empty() || !skull.empty() || !mandible.empty(); }

  static constexpr const char* about =
      "The person's own bones, on which the layer of tissue ends (docs/ct.md). Where none are "
      "given, "
      "thickness and bones are estimated from landmarks.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(ct),
             "A folder that hyperex ct wrote: its skull and mandible, laid on the scan with its "
             "skin, where the scan is not that skin itself.",
             {.folder_too = true});
    v.option(HX_MEMBER(skull),
             "The skull: PLY, OBJ, STL, glTF or GLB, in the coordinates of anatomy.ct if that is "
             "given, otherwise in those of the scan. It need not be closed.");
    v.option(HX_MEMBER(mandible), "The mandible, in the same coordinates, with its heads.");
    v.option(HX_MEMBER(unit),
             "The unit of length of these two files, where it is not that of the scan (with "
             "anatomy.ct: mm).",
             {.none = "scan"});
  }
};

struct OutputOptions {
  bool vtu = true, glb = true, report = true;
  int vtu_every = 1;              ///< writes every n-th frame
  bool vtu_strain = true;         ///< includes the strain tensor
  bool variants_vtu = false;      ///< writes the frames of each variant too
  double glb_tolerance_m = 1e-4;  ///< largest error of any vertex in any frame
  double glb_max_mb = 20;         ///< of performance.glb
  double most_gb = 2;             ///< of all outputs; a run that would write more is refused
  double most_memory_gb = 8;      ///< a run that would take more is refused
  bool error_budget = false;      ///< run the face again with whatever may be wrong
  bool full_paths = false;        ///< write full paths in summary.json and report.html
  double symmetry_floor = 1e-6;
  double lowpass_hz = 6;    ///< cut-off for excursions, speeds and paths; 0: none
  double jitter_m = -1e-3;  ///< of the recorded points; below 0: estimated from the points
  double repetition_m = 0;  ///< 95 % of the differences between two performances; 0: not counted
  face::SkinTone skin_tone = face::SkinTone::light;  ///< where a scan has no colours

  static constexpr const char* about = "What is written.";
  template <class Visitor>
  static void describe(Visitor& v) {
    describe_files(v);
    v.option(HX_MEMBER(error_budget),
             "Run the face twelve times more, with another mesh, landmarks, muscles, stiffness "
             "and law, and state a 95 % interval with its parts for every excursion and for what "
             "each variant changes: error_budget.csv and summary.json (docs/uncertainty.md).");
    v.option(HX_MEMBER(full_paths),
             "Write full paths of the input files into summary.json and report.html. By default "
             "only file names are written, since folder names may contain a patient's name.");
    v.option(HX_MEMBER(skin_tone),
             "The tone of skin in pictures and pages where the scan has neither a texture nor "
             "colours of its own.");
    v.option(HX_MEMBER(symmetry_floor),
             "The least difference of xi that S(t) resolves; at perfect symmetry it would be minus "
             "infinity.",
             {.bounds = {0, 1, true}});
    v.option(HX_MEMBER(jitter_m),
             "Jitter of the recorded points (standard deviation per coordinate), which sets the "
             "noise floor of S(t) (docs/symmetry.md). Below 0: estimated from the fourth "
             "differences of the points in time.",
             {.unit = kMillimetres, .bounds = {-1e-3, 0.02}});
    v.option(HX_MEMBER(repetition_m),
             "A person's own variation, which counts in the floor of a difference between both "
             "sides and in the error budget: 95 % of the differences between two performances are "
             "below this. 0: the recording alone is judged. A posed smile after a week: 1.5 "
             "(docs/symmetry.md).",
             {.unit = kMillimetres, .bounds = {0, 0.02}});
    v.option(HX_MEMBER(lowpass_hz),
             "Cut-off frequency of the zero-phase low-pass filter for tracks of points "
             "with jitter (docs/symmetry.md). 0: no filter.",
             {.unit = kHertz, .bounds = {0, 100}});
  }

 private:
  template <class Visitor>
  static void describe_files(Visitor& v) {
    v.option(HX_MEMBER(vtu),
             "Write frames.pvd and frames/: the tissue over time, for ParaView. The points are at "
             "rest in every frame; the filter Warp By Vector moves them.");
    v.option(HX_MEMBER(vtu_every),
             "Write only every n-th frame there: 3 takes a third of the space.",
             {.bounds = {1, 10000}});
    v.option(HX_MEMBER(vtu_strain),
             "Write the strain tensors there; at finite strain also stress tensors and principal "
             "stretches.");
    v.option(HX_MEMBER(variants_vtu), "Write them for each variant too, into its folder.");
    v.option(HX_MEMBER(glb),
             "Write performance.glb, of each variant too: the moving skin for Blender and other "
             "programs that read glTF.");
    v.option(HX_MEMBER(glb_tolerance_m),
             "The greatest allowed error of any vertex of performance.glb in any frame. A larger "
             "tolerance needs fewer shape keys and makes a smaller file.",
             {.unit = kMillimetres, .bounds = {1e-5, 0.01}});
    v.option(HX_MEMBER(glb_max_mb),
             "The largest size of performance.glb. Where output.glb_tolerance_mm needs more, shape "
             "keys are left out and a warning states the remaining error.",
             {.unit = kMegabytes, .bounds = {0.1, 10000}});
    v.option(HX_MEMBER(report), "Write report.html.");
    v.option(HX_MEMBER(most_gb),
             "The most that a run may write, by an estimate: one that would write more does not "
             "begin. hyperex check states the estimate.",
             {.unit = kGigabytes, .bounds = {0.01, 1e6}});
    v.option(HX_MEMBER(most_memory_gb),
             "The most memory that a run may take, by an estimate: one that would take more does "
             "not begin. hyperex check states the estimate.",
             {.unit = kGigabytes, .bounds = {0.1, 1e6}});
  }
};

/// A face and its motion that a calling program passes in memory, instead of scan.file and
/// motion.file.
struct GivenFace {
  std::shared_ptr<const io::Scan> scan;          ///< null: the files that the scene names are read
  io::Landmarks landmarks;                       ///< metres, the scan's frame; empty: found on it
  std::shared_ptr<const motion::Motion> motion;  ///< as recorded, in metres, with the head pose
  /// The motion was made of weights of blend shapes (expression::motion_of()), as that of
  /// motion.arkit.
  bool of_weights = false;
};

/// Where a value came from.
struct Origin {
  std::filesystem::path file;  ///< the scene file, or "--set"
  int line = 0;                ///< 1-based; 0 where there is no line
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
  simulate::MuscleOptions muscles;  ///< `own`: the program's, changed by the next two
  std::filesystem::path muscles_file;
  std::vector<std::string> muscles_without;
  simulate::DriveOptions drive;  ///< its gain has the key motion.gain
  simulate::ContactOptions contact;
  simulate::SurgeryOptions surgery;
  TeethOptions teeth;
  AnatomyOptions anatomy;
  simulate::SolverOptions solver;
  /// peak_time_s and still_times_s (up to 12; none: spread_frames()) belong to the section output.
  simulate::TimeOptions time;
  OutputOptions output;
  std::vector<Variant> variants;  ///< [[variant]], in the file's order

  std::filesystem::path file;             ///< the scene file
  std::map<std::string, Origin> origins;  ///< of each key that was given, e.g. "time.step_s"
  GivenFace given;
  KeptResults kept;  ///< where found landmarks and tracked recordings are kept; nowhere by default

  static constexpr const char* about = "At the top of the file, before any section.";
  /// Each member that is a struct is a section of the file. A section has the member's name unless
  /// a key is given.
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(title), "Heads the report.");
    v.option(HX_MEMBER(scan), "");
    v.option(HX_MEMBER(motion), "");
    v.option(HX_MEMBER(alignment), "");
    v.option(HX_MEMBER(region), "");
    v.option(HX_MEMBER(mesh), "");
    v.option(HX_MEMBER(anatomy), "");
    v.option(HX_MEMBER(tissue), "");
    v.option(HX_MEMBER(model), "", {.key = "tissue."});
    v.option(HX_MEMBER(support), "");
    v.option(HX_MEMBER(drive), "");
    v.option(HX_MEMBER(muscles), "");
    v.option(HX_MEMBER(muscles_file),
             "Your own muscles, as tables [[muscle]] (docs/muscles.md): one with the name of a "
             "muscle of the program replaces it, others are added. The same for all variants.",
             {.key = "muscles.file"});
    v.option(HX_MEMBER(muscles_without),
             "Muscles to leave out, by their names without the side. The same for all variants.",
             {.key = "muscles.without"});
    v.option(HX_MEMBER(teeth), "");
    v.option(HX_MEMBER(contact), "");
    v.option(HX_MEMBER(surgery), "");
    v.option(HX_MEMBER(solver), "");
    v.option(HX_MEMBER(time), "");
    v.option(HX_MEMBER(output), "");
  }
};

/// The same face and motion with another tissue, support or drive, which a run compares with the
/// scene itself.
struct Variant {
  std::string name;        ///< printable ASCII
  std::string folder;      ///< of its outputs: the name, '_' for characters awkward in a path
  nlohmann::json changes;  ///< "tissue.young_kpa": 400, as given
  Scene scene;             ///< with the changes; its own variants are empty
  std::size_t number = 0;  ///< among the [[variant]] of the file, from 0

  /// Begins the names of its keys in messages: "variant[0].".
  std::string owner() const { return "variant[" + std::to_string(number) + "]."; }
};

/// A [[variant]] that cannot be used, where the caller does without such ones.
struct LeftOutVariant {
  std::size_t number = 0;  ///< among the [[variant]] of the file, from 0
  std::string name;        ///< as given; empty where there is none
  std::string why;         ///< the sentences of an InputError, one per line
};

/// The sections whose keys a variant may change. A run repeats these steps for each variant.
const std::vector<std::string>& variant_sections();

/// Reads a scene file (TOML, docs/scene.md), then `overrides` ("KEY=VALUE"; the last one of a key
/// wins; VALUE is TOML, JSON or a bare string). Paths in the file are relative to it, paths in
/// overrides to the current folder. Throws one InputError with all problems, one line each: invalid
/// TOML, unknown keys, wrong types, values out of range, missing keys or files.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same, but reads `text` in place of the content of `file`, which need not exist. With
/// `left_out`, a wrong [[variant]] throws nothing: it is missing in the scene and is added there.
Scene read_scene_text(const std::string& text, const std::filesystem::path& file,
                      std::vector<LeftOutVariant>* left_out = nullptr);

/// Takes its variants out of a scene that was read. Where contact.lips was not given, it is what a
/// scene without variants has.
void leave_out_variants(Scene& scene);

/// The same problems, returned instead of thrown; empty for a valid scene.
std::vector<InputProblem> problems_of(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides = {});

/// A problem that is found later (for example a point that the motion does not have), with the
/// value of `key` and the place where it was given.
InputProblem problem_at(const Scene& scene, const std::string& key, const std::string& expected);

/// All options by section and key, in the units of the key names, defaults included.
nlohmann::json options_json(const Scene& scene);

/// The page docs/scene.md: every key with its type, unit, default and allowed values.
std::string reference_markdown();

}  // namespace hyperex::scene
