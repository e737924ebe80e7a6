// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/sample/sample_data.hpp"

namespace hyperex::cli {
namespace {

void write_sample(const std::filesystem::path& folder) {
  take_library_memory();
  sample::write_sample_data(folder);
  std::cout << fmt::format(
      "written to {0}:\n"
      "  second_face.ply            another person's face, with second_face_landmarks.json\n"
      "  flawed_scan.ply            the same face as scanned: noise, holes, joined lips\n"
      "  recording                  colour and depth of it: a one-sided smile, an open mouth\n"
      "  recording/truth_*.csv      where its points and its head truly were\n"
      "  sample.json                the noise, and all files\n"
      "next: hyperex new {0}/flawed_scan.ply {0}/recording --out mine.toml\n"
      "      hyperex track --score {0}/recording\n",
      printable(folder.string()));
}

}  // namespace

void add_sample(CLI::App& program) {
  auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command = program.add_subcommand(
      "sample",
      "Make data to try the program with: a second face, a scan of it with faults, and a recording "
      "of colour and depth with its truth");
  command
      ->add_option("FOLDER", *folder,
                   "Where to write it: new, empty or of an earlier call; appears complete or not "
                   "at all")
      ->required();
  command->footer(
      "Example: hyperex sample out/sample\n"
      "The same bytes every time, some 4 MB. Scenes that use them: examples/second_face.toml,\n"
      "examples/flawed_scan.toml, examples/recorded_smile.toml.");
  command->callback([folder] { write_sample(*folder); });
}

}  // namespace hyperex::cli
