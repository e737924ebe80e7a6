// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/rig/face_rig.hpp"
#include "hyperex/rig/fewer_vertices.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/session/embedded_scan.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/log_note.hpp"
#include "rig_shapes.hpp"

namespace hyperex::cli {
namespace {

struct RigOptions {
  std::filesystem::path scan, landmarks, out;
  std::vector<std::filesystem::path> recipes;
  std::string unit, names = "arkit", skin_tone = "light";
  std::vector<std::string> overrides;
  bool correctives = false;
  int vertices = 0;  ///< 0: all
};

/// Makes text of the numbers that JSON lacks, so that their keys refuse them.
void as_words(nlohmann::json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    value = scene::toml_text(value);
  if (value.is_structured())
    for (nlohmann::json& part : value) as_words(part);
}

/// KEY=VALUE, as hyperex run takes it.
session::Changes changes_of(const std::vector<std::string>& overrides) {
  session::Changes changes;
  for (const std::string& text : overrides) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"--set", 0, text, "no value", "KEY=VALUE, as in tissue.young_kpa=300"});
    const std::string key = text.substr(0, equals);
    try {
      nlohmann::json value = scene::override_value(key, text.substr(equals + 1));
      as_words(value);
      changes.insert_or_assign(key, session::Value::from_json(value.dump()));
    } catch (const nlohmann::json::exception&) {
      throw InputError({"--set", 0, key, text.substr(equals + 1), "text in UTF-8"});
    }
  }
  return changes;
}

/// The error, with the option as the place of values that it gave.
InputError naming_the_option(const InputError& error, const session::Changes& changes) {
  std::vector<InputProblem> problems = error.problems();
  if (problems.empty()) return error;
  for (InputProblem& problem : problems)
    if (problem.file.empty() && std::ranges::any_of(changes, [&](const auto& change) {
          return problem.key.starts_with(change.first);
        }))
      problem.file = "--set";
  return InputError(problems);
}

/// Landmarks are found on the whole scan, and kept.
void thin(session::Face& face, const RigOptions& options) {
  io::Scan& scan = face.scan;
  const Eigen::Index before = scan.mesh.points.rows();
  if (before <= options.vertices) return;
  if (face.landmarks.empty()) {
    std::vector<Note> notes;
    face.landmarks = session::find_landmarks(scan, "no --landmarks", notes);
    for (const Note& note : notes) session::log_note(note);
  }
  const io::Landmarks all =
      anatomy::complete_landmarks(face.landmarks, scan.mesh, options.landmarks.string()).landmarks;
  try {
    rig::ThinnedScan thinned = rig::with_fewer_vertices(scan, all, options.vertices);
    if (thinned.scan.mesh.points.rows() < before)
      std::cerr << fmt::format(
          "{} of {} vertices are kept; the others lie up to {:.2f} mm from their surface\n",
          thinned.scan.mesh.points.rows(), before, 1e3 * thinned.off_m);
    scan = std::move(thinned.scan);
  } catch (const std::invalid_argument& error) {
    throw InputError(options.scan, error.what());
  }
}

session::Face face_of(const RigOptions& options) {
  if (options.scan == "embedded") {
    if (!options.landmarks.empty() || !options.unit.empty())
      throw InputError(
          "embedded has its own landmarks and unit; expected a scan with --landmarks or --unit");
    session::Face face;
    face.scan = session::embedded_scan();
    face.landmarks = anatomy::embedded_face().landmarks;
    return face;
  }
  session::Face face;
  const auto unit = options.unit.empty() ? std::nullopt : io::length_unit(options.unit);
  face.scan = io::read_scan(options.scan, unit);
  if (face.scan.unit_guessed)
    std::cerr << fmt::format("{}: unit {}\n", printable(options.scan.string()),
                             io::unit_note(face.scan));
  if (!options.landmarks.empty()) face.landmarks = io::read_landmarks(options.landmarks);
  if (options.vertices > 0) thin(face, options);
  return face;
}

std::vector<rig::Recipe> recipes_of(const RigOptions& options) {
  std::vector<rig::Recipe> recipes = rig::read_recipes(options.recipes);
  for (const rig::Recipe& recipe : recipes)
    if (const std::string meant = rig::probably_meant(recipe); !meant.empty())
      std::cerr << fmt::format(
          "warning: the recipe {} is added to ARKit's shapes; did you mean {}, which would replace "
          "one?\n",
          recipe.name, meant);
  return recipes;
}

rig::FaceRig rig_of(const RigOptions& options, const std::vector<rig::Recipe>& recipes) {
  session::Face face = face_of(options);
  const session::Changes changes = changes_of(options.overrides);
  try {
    return rig::make_rig(
        std::move(face), changes, session::log_note,
        options.correctives ? rig::Correctives::of_clashing_pairs : rig::Correctives::none,
        recipes);
  } catch (const InputError& error) {
    throw naming_the_option(error, changes);
  }
}

/// Unreal's Live Link names ARKit's curves with a first capital: EyeBlinkLeft, JawOpen. Both names
/// of a corrective's get one: JawOpen_MouthClose.
void name_as_unreal_does(std::vector<report::RigShape>& shapes) {
  for (report::RigShape& shape : shapes) {
    char before = '_';
    for (char& letter : shape.name) {
      if (before == '_' && letter >= 'a' && letter <= 'z') letter += 'A' - 'a';
      before = letter;
    }
  }
}

void run(const RigOptions& options) {
  std::vector<std::filesystem::path> inputs = options.recipes;
  inputs.insert(inputs.end(), {options.scan, options.landmarks});
  check_outputs({options.out}, inputs);
  check_output_kinds({{options.out, {".glb"}, "glTF", {"hyperex"}}});
  take_library_memory();
  const std::vector<rig::Recipe> recipes = recipes_of(options);
  rig::FaceRig made = rig_of(options, recipes);
  for (const std::string& side : made.closed_eyes)
    std::cerr << fmt::format(
        "warning: the scan's {} eye is closed: shapes of its lids and of gaze move nothing\n",
        side == "Left" ? "left" : "right");
  const std::vector<std::string> remarks = remarks_on_shapes(made, recipes);
  if (options.names == "unreal") name_as_unreal_does(made.shapes);
  double bytes = 0;
  {
    Progress progress("writing the rig", 0);
    bytes = report::write_rig_glb(options.out, made.performance, *made.scan, made.teeth.get(),
                                  made.jaw_axis_m, made.shapes,
                                  *value_of<face::SkinTone>(options.skin_tone));
  }
  print_shapes(made, remarks, options.out.string(), bytes);
}

}  // namespace

void add_rig(CLI::App& program) {
  auto options = std::make_shared<RigOptions>();
  CLI::App* command = program.add_subcommand(
      "rig", "Make ARKit's 52 blend shapes of a scan, by its muscles and its jaw");
  command
      ->add_option("SCAN", options->scan,
                   "PLY, OBJ, STL, glTF or GLB; or embedded, the face that comes with the program")
      ->required();
  command->add_option("--out", options->out, "Where to write it (.glb)")->required();
  command->add_option("--landmarks", options->landmarks,
                      "Landmarks on the scan (default: they are found on the scan)");
  command->add_option("--unit", options->unit, "Unit of the scan")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command
      ->add_option("--names", options->names,
                   "Names of the shapes: arkit (jawOpen) or unreal (JawOpen, as its Live Link has "
                   "them)")
      ->check(CLI::IsMember({"arkit", "unreal"}))
      ->capture_default_str();
  command
      ->add_option("--skin-tone", options->skin_tone,
                   "Skin of a scan with neither a texture nor colours")
      ->check(CLI::IsMember({"light", "medium", "dark"}))
      ->capture_default_str();
  command
      ->add_option("--vertices", options->vertices,
                   "Thin the scan to about that many vertices (default: all up to 60,000)")
      ->check(CLI::Range(3000, 1000000));
  command
      ->add_option("--recipes", options->recipes,
                   "TOML file with shapes of your own, as weights of ARKit's: more shapes, or "
                   "others in the place of ARKit's (docs/rig.md); can be repeated")
      ->allow_extra_args(false);
  command->add_flag("--correctives", options->correctives,
                    "Also write shapes for combinations that are no sum of two, as "
                    "jawOpen_mouthClose; the weight of each is the product of the two weights");
  command
      ->add_option("--set", options->overrides,
                   "Override a key of a scene (docs/scene.md), as of muscles or tissue; can be "
                   "repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->footer("Example: hyperex rig me.ply --out me_rig.glb");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
