// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/output_directory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/ct/outputs.hpp"
#include "hyperex/ct/summary.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;

struct CtCommand {
  ct::CtOptions ct;
  fs::path out;
  std::string seed_skull, seed_mandible, frame = "patient";
};

/// "x,y,z" in mm.
Vec3 point_of(const char* option, const std::string& text) {
  std::istringstream in(text);
  Vec3 p;
  char comma = ',';
  for (int a = 0; a < 3; ++a) {
    if (a > 0 && (!(in >> comma) || comma != ',')) in.setstate(std::ios::failbit);
    in >> p[a];
  }
  if (in.fail() || !(in >> std::ws).eof())
    throw InputError(
        {option, 0, "", text, "three numbers x,y,z (mm, in the frame of the outputs)"});
  return 1e-3 * p;
}

void check(CtCommand& options) {
  if (options.seed_skull.empty() != options.seed_mandible.empty())
    throw InputError(
        "--seed-skull and --seed-mandible are given together; expected both or neither");
  if (!options.seed_skull.empty())
    options.ct.seeds = ct::Seeds{point_of("--seed-skull", options.seed_skull),
                                 point_of("--seed-mandible", options.seed_mandible)};
  const auto& own = options.ct.own;
  if (!own.labels.empty() && !(own.skull.empty() && own.mandible.empty()))
    throw InputError("--labels and --skull or --mandible: expected one segmentation");
  if (own.skull.empty() != own.mandible.empty())
    throw InputError(own.mandible.empty() ? "--skull alone: expected --mandible too"
                                          : "--mandible alone: expected --skull too");
  if (own.given() && options.ct.seeds)
    throw InputError("a segmentation of your own needs no seeds; expected one of them");
  options.ct.own.frame =
      options.frame == "face" ? ct::SurfaceFrame::face : ct::SurfaceFrame::patient;
}

void run(CtCommand& options) {
  check(options);
  const auto& own = options.ct.own;
  OutputDirectory folder(options.out, ct::files_of_earlier_ct,
                         {options.ct.source, own.skull, own.mandible, own.labels});
  const ct::CtFace face = ct::face_of_ct(options.ct);
  for (const std::string& note : face.notes) spdlog::info("{}", note);
  for (const std::string& warning : face.warnings) spdlog::warn("{}", warning);
  try {
    ct::write_ct(face, folder.path());
    folder.commit();
  } catch (const InputError& error) {
    throw InputError(folder.with_own_name(error.what()));
  }
  for (const std::string& line : ct::summary_lines(face)) std::cout << line << '\n';
  std::cout << fmt::format("written to {}\nThis is no medical device.\n",
                           printable(options.out.string()));
}

void add_own_bones(CLI::App& command, CtCommand& options) {
  auto& own = options.ct.own;
  command.add_option("--skull", own.skull, "Your own skull (STL or PLY, mm) in the place of ours");
  command.add_option("--mandible", own.mandible, "Your own mandible (STL or PLY, mm)");
  command
      .add_option("--bones-frame", options.frame,
                  "Frame of those: patient (DICOM, as 3D Slicer writes them) or face")
      ->capture_default_str()
      ->check(CLI::IsMember({"patient", "face"}));
  command.add_option("--labels", own.labels,
                     "Your own labels (.nrrd, .nii, .nii.gz) in the place of ours");
  command.add_option("--skull-label", own.skull_label, "The skull's number in them")
      ->capture_default_str();
  command.add_option("--mandible-label", own.mandible_label, "The mandible's")
      ->capture_default_str();
}

}  // namespace

void add_ct(CLI::App& program) {
  auto options = std::make_shared<CtCommand>();
  CLI::App* command = program.add_subcommand(
      "ct",
      "Skin, skull and mandible of a CT, and the thickness of the soft tissue between them "
      "(docs/ct.md). No medical device.");
  command
      ->add_option("SERIES", options->ct.source,
                   "A folder of DICOM files, a .zip of one, or a .nii, .nii.gz or .nrrd file")
      ->required();
  command
      ->add_option(
          "--out", options->out,
          "Where to write it: new, empty or of an earlier call; appears complete or not at all")
      ->required();
  command->add_option("--series", options->ct.series.number,
                      "Which series, where there are several (1, 2 ...)");
  command
      ->add_option("--skin-hu", options->ct.skin_hu, "Value of the skin's surface (default: found)")
      ->check(CLI::Range(-1e6, 1e6));
  command
      ->add_option("--bone-hu", options->ct.bone_hu, "Value of the bones' surface (default: found)")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_option("--seed-skull", options->seed_skull,
                      "A point in the skull (x,y,z in mm, frame of the outputs), if jaw and skull "
                      "are not separated");
  command->add_option("--seed-mandible", options->seed_mandible, "A point in the mandible");
  add_own_bones(*command, *options);
  command->footer("Example: hyperex ct head_ct.zip --out ct");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
