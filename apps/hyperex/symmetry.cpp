// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "described_option.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/weight_doubts.hpp"
#include "hyperex/expression/wild_weights.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/pose_floor.hpp"
#include "hyperex/metrics/repetition_floor.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/motion/option_error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/motion/try_stabilise.hpp"
#include "hyperex/run/asymmetry_picture.hpp"
#include "hyperex/run/corner_words.hpp"
#include "hyperex/run/earlier_run.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/check_alone.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/session/keyframes.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/recording_jitter.hpp"
#include "hyperex/session/rig_face.hpp"
#include "symmetry_frames.hpp"
#include "symmetry_picture.hpp"
#include "symmetry_print.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;

struct SymmetryOptions {
  fs::path motion, rig, out, excursions, picture, map, map_ply, landmarks;
  scene::OutputOptions output;  // those of a run that apply here
  double rate_hz = 30;
  double end_s = std::numeric_limits<double>::infinity();
  std::string unit, jitter_mm = "auto";
  std::vector<std::string> rigid_points;
  bool keep_head = false;
};

/// The jitter that the run itself used; nothing if its summary contains no such number.
std::optional<session::RecordedJitter> jitter_of_run(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  if (!fs::exists(file)) return std::nullopt;
  const auto summary = nlohmann::json::parse(read_file(file), nullptr, false);
  const auto at = nlohmann::json::json_pointer("/symmetry/jitter_mm");
  if (summary.is_discarded() || !summary.contains(at) || !summary[at].is_number())
    return std::nullopt;
  const double jitter_mm = summary[at].get<double>();
  if (!(jitter_mm >= 0)) return std::nullopt;
  const auto known = nlohmann::json::json_pointer("/symmetry/jitter_known");
  if (summary.contains(known) && summary[known] == false)
    return session::RecordedJitter{
        0, false, "the run's summary.json says that the jitter of its recording is not known"};
  return session::RecordedJitter{
      1e-3 * jitter_mm, true,
      fmt::format("jitter of the recorded points, from the run's summary.json: {:.2f} mm",
                  jitter_mm)};
}

/// The folder of the run that wrote this motion.csv, for the scene or for a variant; empty: no run
/// did.
fs::path run_that_wrote(const fs::path& motion) {
  if (motion.filename() != "motion.csv") return {};
  const fs::path folder = fs::absolute(motion).lexically_normal().parent_path(),
                 variants = folder.parent_path();
  const bool of_variant =
      variants.filename() == "variants" && run::is_folder_of_run(variants.parent_path());
  return of_variant || run::is_folder_of_run(folder) ? folder : fs::path();
}

/// The number given by --jitter-mm; nothing for "auto".
std::optional<double> stated_jitter_mm(const SymmetryOptions& options) {
  if (options.jitter_mm == "auto") return std::nullopt;
  const auto value = io::parse_number(options.jitter_mm);
  if (!value || !(*value >= 0) || !(*value <= 20))
    throw InputError(InputProblem{"symmetry", 0, "--jitter-mm", options.jitter_mm,
                                  "a number from 0 to 20 (mm) or \"auto\""});
  return value;
}

/// `steady`: the motion without the head pose. `run`: the folder of a run, or empty.
session::RecordedJitter jitter_of(const SymmetryOptions& options, const motion::Motion& steady,
                                  const fs::path& run) {
  const auto stated = stated_jitter_mm(options);
  if (!stated) {
    if (const auto of_run = run.empty() ? std::nullopt : jitter_of_run(run)) return *of_run;
    if (!options.rig.empty()) return {0, true, "the points of a rig are exact"};
    return session::recorded_jitter(steady);
  }
  return {1e-3 * *stated, true,
          *stated > 0 ? fmt::format("jitter of the recorded points, as --jitter-mm states it: "
                                    "{:.2f} mm",
                                    *stated)
                      : "points taken as exact, as --jitter-mm 0 states it"};
}

/// Warns if the jitter is unknown: then no figure above the floors is decided.
void warn_of_unknown(const session::RecordedJitter& jitter) {
  if (!jitter.known)
    spdlog::warn(
        "{}; how much of a difference between the sides is noise is not known; --jitter-mm X "
        "states the jitter, 0 for exact points",
        jitter.how);
}

void report_guessed_unit(const motion::Motion& motion) {
  if (const std::string unit = session::guessed_unit(motion); !unit.empty())
    std::cerr << "motion: " << unit << "; --unit states it\n";
}

/// Says which points hold the head's pose, as the user did not name them.
void report_still_points(const motion::StillPoints& still) {
  if (!still.names.empty())
    std::cerr << motion::still_points_sentence(still)
              << "; --rigid-points changes that, --keep-head keeps the head in\n";
}

/// Without --rigid-points, the pose is that of the points that the recording itself shows to be
/// still, as hyperex new names them, or of the face's landmarks. Where there are neither, the head
/// stays in.
motion::StabilisedMotion without_head(const motion::Motion& motion,
                                      const SymmetryOptions& options) {
  if (options.keep_head) return motion::with_head_kept(motion);
  if (!options.rig.empty()) return motion::with_still_head(motion);
  if (!options.rigid_points.empty()) {
    try {
      return motion::stabilise(motion, {.rigid_points = options.rigid_points});
    } catch (const motion::OptionError& error) {
      throw InputError(error.sentence("--rigid-points"));
    }
  }
  motion::StillPoints still = motion::points_to_hold_the_head(motion);
  motion::TriedPose tried = still.by_landmarks.empty()
                                ? motion::try_stabilise(motion, still.names, "--rigid-points")
                                : motion::TriedPose{std::move(still.by_landmarks.front()), ""};
  if (!tried.why_not.empty())
    std::cerr << "head pose is not taken out, and excursions contain it: " << tried.why_not << '\n';
  else
    report_still_points(still);
  return std::move(tried.steady);
}

/// S(t). If the motion lacks points that S(t) needs but has a pair of points to measure, a message
/// says so and the curve stays empty; the excursions are still printed, written and drawn.
metrics::SymmetryCurve curve_of(const motion::Motion& motion, const SymmetryOptions& options) {
  const bool excursions_alone = metrics::symmetry_columns(motion).empty() &&
                                !metrics::excursions_of(motion, 0, 0).pairs.empty();
  try {
    return metrics::symmetry_of(motion, options.output.symmetry_floor);
  } catch (const InputError& error) {
    if (!excursions_alone) throw;
    std::cerr << "S(t) is left out: " << error.what() << '\n';
    return metrics::symmetry_without_points(motion, options.output.symmetry_floor);
  }
}

void write_map(const SymmetryOptions& options, const SurfaceFrames& frames,
               const std::vector<PointsF>& displacement, const metrics::Asymmetry& map) {
  const auto worst = static_cast<size_t>(map.worst_frame);
  const TriMesh moved{frames.rest.points + displacement[worst].cast<double>(),
                      frames.rest.triangles};
  const Eigen::VectorXf map_mm = metrics::asymmetry_mm(map.plane, map.pairs, displacement[worst]);
  const std::string note = fmt::format(
      "the face less its reflection, less the same at rest, at {:.2f} s; face rms {:.2f} mm, mouth "
      "rms {:.2f} mm",
      frames.tracks.time_s[worst], map.frames[worst].face_rms_mm, map.frames[worst].mouth_rms_mm);
  if (!options.map.empty())
    render::write_png(options.map, run::draw_asymmetry(
                                       moved, map_mm, map, frames.landmarks,
                                       "Asymmetry of " + options.motion.filename().string(), note));
  if (!options.map_ply.empty())
    io::write_ply(options.map_ply, moved, frames.unit, {{"asymmetry_mm", map_mm}});
}

/// Says whose sides are measured. `run`: its folder where they are those of a simulated face.
void report_whose_sides(const fs::path& run) {
  if (!run.empty())
    std::cout << fmt::format(
        "the sides are those of the face that the run in {} simulated, where a side that is not "
        "recorded moves as is usual; for recorded sides give the recording itself\n",
        printable(run.filename().string()));
}

/// Writes the requested files and prints the remaining results. `run`: as above. `doubtful`:
/// whether a warning doubts the figures.
void report(const SymmetryOptions& options, const fs::path& run,
            const metrics::SymmetryMeasures& all, const session::RecordedJitter& jitter,
            const motion::StabilisedMotion& steady, bool doubtful) {
  for (const std::string& stand_in : all.curve.stand_ins)
    std::cerr << "stand-in for " << stand_in << '\n';
  const std::string whose = run.empty() ? options.motion.filename().string()
                                        : "the simulated face of " + run.filename().string();
  if (!options.picture.empty())
    render::write_png(options.picture, draw(all, "Symmetry of " + whose));
  if (!options.excursions.empty())
    metrics::write_excursions_csv(options.excursions, all.excursions);
  if (!options.out.empty()) metrics::write_symmetry_csv(options.out, all);
  report_whose_sides(run);
  std::cout << run::corners_line(all.excursions, doubtful);
  if (options.out.empty() && all.curve.known()) print_curve(all.curve);
  print_excursions(all.excursions);
  print_head_uncertainty(steady, jitter);
  print_summary(all, jitter, doubtful);
}

/// The excursions, judged by jitter, the head's pose and repetition. Points of a rig have a still
/// head.
metrics::Excursions judged_excursions(const SymmetryOptions& options,
                                      const motion::StabilisedMotion& steady,
                                      const session::RecordedJitter& jitter) {
  metrics::Excursions out =
      metrics::excursions_of(steady.motion, jitter.jitter_m, options.output.lowpass_hz);
  metrics::set_known(
      out, {.jitter = jitter.known, .head = !options.rig.empty() || !steady.poses.empty()});
  metrics::add_pose_floors(out,
                           metrics::pose_variances(steady.motion, steady.poses, out.lowpass_hz));
  metrics::add_repetition_floor(out, 1e3 * options.output.repetition_m);
  return out;
}

void run_surfaces(const SymmetryOptions& options, std::optional<io::LengthUnit> unit) {
  SurfaceFrames frames =
      read_surface_frames(options.motion, options.landmarks, unit, options.rate_hz);
  const motion::StabilisedMotion stabilised = options.keep_head
                                                  ? motion::with_head_kept(frames.tracks)
                                                  : steady(frames, options.rigid_points);
  std::vector<PointsF> displacement;
  for (const Points& at : frames.positions)
    displacement.push_back((at - frames.rest.points).cast<float>());
  const session::RecordedJitter jitter = jitter_of(options, frames.tracks, {});
  warn_of_unknown(jitter);
  metrics::SymmetryMeasures all;
  all.curve = metrics::symmetry_of(frames.tracks, options.output.symmetry_floor, jitter.jitter_m);
  all.excursions = judged_excursions(options, stabilised, jitter);
  all.map =
      metrics::asymmetry_of(metrics::rest_asymmetry(frames.rest, frames.landmarks), displacement);
  if (!all.map->plane.note.empty()) std::cerr << all.map->plane.note << '\n';
  write_map(options, frames, displacement, *all.map);
  report(options, {}, all, jitter, stabilised, false);
}

/// Throws InputError for points that hold the head's pose where it is not estimated.
void check_rigid_points(const SymmetryOptions& options) {
  if (!options.rig.empty() && !options.rigid_points.empty())
    throw InputError(InputProblem{"symmetry", 0, "--rigid-points",
                                  fmt::format("{}", fmt::join(options.rigid_points, ",")),
                                  "none, as the weights of --rig move a face whose head stays "
                                  "where it is"});
}

/// The files of a folder. Each of them may be a frame.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

void check_outputs_of(const SymmetryOptions& options, const std::vector<fs::path>& inputs) {
  check_outputs({options.out, options.excursions, options.picture, options.map, options.map_ply},
                inputs);
  check_output_kinds({{options.out, {".csv"}, "time_s,xi_", {",S_ln,floor"}},
                      {options.excursions, {".csv"}, "point,excursion_", {"excursion_ratio_R_L"}},
                      png_output(options.picture),
                      png_output(options.map),
                      {options.map_ply, {".ply"}, "ply", {" asymmetry_mm\n"}}});
}

/// The recorded points, or those of the rig that the recorded weights move.
motion::Motion read(const SymmetryOptions& options, const fs::path& file,
                    std::optional<io::LengthUnit> unit) {
  if (options.rig.empty()) return motion::read_motion(file, unit);
  const expression::FaceModel rig =
      session::rig_face(options.rig, KeptResults(user_cache_folder()));
  const expression::MendedShapes mended =
      expression::without_wild_weights(expression::read_arkit(file));
  for (const std::string& doubt :
       {wild_weights_sentence(mended), doubtful_weights_sentence(mended)})
    if (!doubt.empty()) spdlog::warn("{}", doubt);
  const expression::BlendShapes& shapes = mended.shapes;
  const expression::MissingSides missing = expression::missing_sides(shapes);
  if (missing.doubtful) spdlog::warn("{}", missing.text);
  std::vector<std::string> notes = shapes.notes;
  if (!missing.doubtful && !missing.text.empty()) notes.push_back(missing.text);
  notes.insert(notes.end(), shapes.misspelt.begin(), shapes.misspelt.end());
  motion::Motion motion = expression::motion_of(shapes, rig, notes);
  for (const std::string& note : notes) std::cerr << note << '\n';
  return motion;
}

/// That nothing moves. A run has warned of its recording.
std::optional<Note> stillness_warning(const fs::path& run_folder, const motion::Motion& steady) {
  if (!run_folder.empty()) return std::nullopt;
  return session::stillness_warning(steady, false);
}

/// That a measured recording seems to start or to end in an expression. Weights know their rest,
/// and a run has warned of its recording.
std::vector<Note> extent_warnings(const SymmetryOptions& options, const fs::path& run_folder,
                                  const motion::Motion& steady) {
  std::vector<Note> warnings;
  if (!run_folder.empty()) return warnings;
  if (options.rig.empty()) return session::extent_warnings(steady);
  add(warnings, session::end_warning(steady));
  return warnings;
}

void run(const SymmetryOptions& options) {
  stated_jitter_mm(options);  // throws before the work begins
  check_rigid_points(options);
  std::optional<io::LengthUnit> unit;
  if (!options.unit.empty()) unit = io::length_unit(options.unit);
  fs::path file = options.motion, run_folder;
  if (fs::is_directory(file)) {
    if (!fs::exists(file / "motion.csv")) {
      std::vector<fs::path> inputs = files_in(file);
      inputs.push_back(options.landmarks);
      check_outputs_of(options, inputs);
      return run_surfaces(options, unit);
    }
    run_folder = file;
    file /= "motion.csv";
  }
  check_outputs_of(options, {file, options.rig});
  if (!options.map.empty() || !options.map_ply.empty())
    throw InputError(InputProblem{"symmetry", 0, options.map.empty() ? "--map-ply" : "--map", "",
                                  "a folder of surfaces; points alone have no map"});
  const session::Readings readings =
      options.rig.empty() ? session::Readings::measured : session::Readings::of_weights;
  auto [motion, warnings] = session::cleaned_recording(
      motion::until(read(options, file, unit), options.end_s, "--end-s"), readings);
  report_guessed_unit(motion);
  if (const auto keyframes = session::keyframes_note(motion, readings))
    std::cerr << keyframes->text << '\n';
  const std::vector<Note> checked = session::check_alone(motion, readings);
  metrics::SymmetryMeasures all;
  all.curve = curve_of(motion, options);
  const motion::StabilisedMotion stabilised = without_head(motion, options);
  const motion::Motion& steady = stabilised.motion;
  if (!steady.head_pose.empty()) {
    add(warnings, session::check_steady(steady, readings));
    append(warnings, extent_warnings(options, run_folder, steady));
  }
  add(warnings, stillness_warning(run_folder, steady));
  add(warnings, session::coarse_warning(motion, readings));
  append(warnings, checked);
  for (const Note& warning : warnings) spdlog::warn("{}", warning.text);
  const session::RecordedJitter jitter = jitter_of(options, steady, run_folder);
  warn_of_unknown(jitter);
  if (jitter.jitter_m > 0 && all.curve.known())
    all.curve = metrics::symmetry_of(motion, options.output.symmetry_floor, jitter.jitter_m);
  all.excursions = judged_excursions(options, stabilised, jitter);
  const fs::path simulated = options.rig.empty() ? run_that_wrote(file) : fs::path();
  report(options, simulated, all, jitter, stabilised,
         std::ranges::any_of(warnings, session::doubts_figures));
}

/// Options that concern a folder of surfaces.
void add_surface_options(CLI::App& command, SymmetryOptions& options) {
  command.add_option("--map", options.map,
                     "For surfaces: draw the frame of largest asymmetry (PNG) here");
  command.add_option("--map-ply", options.map_ply,
                     "For surfaces: write that frame with the attribute asymmetry_mm (PLY) here");
  command.add_option("--landmarks", options.landmarks,
                     "For surfaces: landmarks of the first (JSON)");
  command.add_option("--rate-hz", options.rate_hz, "For surfaces: frames per second")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

/// Options that say what is taken for noise.
void add_noise_options(CLI::App& command, SymmetryOptions& options) {
  using Output = scene::OutputOptions;
  add_described(command, "--floor", options.output, &Output::symmetry_floor);
  command
      .add_option("--jitter-mm", options.jitter_mm,
                  "Jitter of the points (standard deviation per coordinate, mm), which sets the "
                  "noise floor. auto: for a run's folder the value in its summary.json, else "
                  "estimated from the fourth differences of the points in time; 0: exact points. "
                  "Where none shows it is unknown, and no difference above the floors is decided")
      ->capture_default_str();
  add_described(command, "--repetition-mm", options.output, &Output::repetition_m);
  add_described(command, "--lowpass-hz", options.output, &Output::lowpass_hz);
}

}  // namespace

void add_symmetry(CLI::App& program) {
  auto options = std::make_shared<SymmetryOptions>();
  CLI::App* command = program.add_subcommand(
      "symmetry",
      "Symmetry of a motion: the relative change of the distances from each mouth corner to its "
      "side's eye, lid, nose wing and lip (xi_R, xi_L), S = ln |xi_L - xi_R| with its noise floor, "
      "how far and how fast the points of both sides move, and of surfaces a map of their "
      "asymmetry (docs/symmetry.md). No medical device.");
  command
      ->add_option("MOTION", options->motion,
                   "Named points over time, CSV or TRC; a run's folder, for the sides of the face "
                   "that it simulated; or a folder of PLY or OBJ files, one per frame, the first "
                   "at rest")
      ->required();
  command->add_option("--rig", options->rig,
                      "A glTF or GLB file with morph targets of ARKit's names: MOTION has their "
                      "weights over time (CSV), and the rig's landmarks are measured");
  command->add_option("--out", options->out, "Write the curves (CSV) here");
  command->add_option("--excursions", options->excursions,
                      "Write one row per pair of points (CSV) here");
  command->add_option("--picture", options->picture, "Write a plot (PNG) here");
  add_surface_options(*command, *options);
  add_noise_options(*command, *options);
  command
      ->add_option("--end-s", options->end_s,
                   "For points: leave out the samples after this time (s)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--keep-head", options->keep_head,
                    "Do not remove the head pose before measuring excursions. No difference of "
                    "excursions is decided then, as the head's motion may make it");
  command
      ->add_option(
          "--rigid-points", options->rigid_points,
          "Points that carry the head's pose, with commas; of surfaces, names of --landmarks "
          "(default: points beside the landmarks that keep still against each other, else all "
          "landmarks)")
      ->delimiter(',')
      ->excludes("--keep-head");
  command->add_option("--unit", options->unit, "Unit of the motion (default: guessed)")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->footer(
      "Examples:\n  hyperex symmetry recording.csv --out symmetry.csv --picture symmetry.png\n"
      "  hyperex symmetry weights.csv --rig me_rig.glb");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
