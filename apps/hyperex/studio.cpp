// SPDX-License-Identifier: GPL-3.0-or-later
#include "../studio/studio.hpp"

#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/version.hpp"

namespace hyperex::cli {

namespace {

/// Left and right depend on whether the picture is mirrored. This cannot be detected in a colour
/// picture.
void check_device(const std::string& device, const std::string& mirrored) {
  if (device.empty()) {
    if (!mirrored.empty()) throw InputError("studio: --mirrored is for a camera: give --device");
    return;
  }
  if (device.starts_with("webcam") && mirrored.empty())
    throw InputError("studio: " + device +
                     ": does its picture show the world as a mirror does? Say --mirrored yes or "
                     "--mirrored no: left and right depend on it");
}

}  // namespace

void add_studio(CLI::App& program) {
  auto options = std::make_shared<studio::StudioOptions>();
  options->save_into = ".";
  auto mirrored = std::make_shared<std::string>();
  auto no_browser = std::make_shared<bool>(false), no_cache = std::make_shared<bool>(false),
       no_bands = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand(
      "studio",
      "Open a face in the browser, change its tissue and muscles, and see the effect at once");
  command->add_option("SCENE", options->started,
                      "Scene file or scan; without one the face that comes with the program");
  command->add_option(
      "--save-into", options->save_into,
      "Folder for saved files, made if it is missing. Only files that this studio wrote are ever "
      "overwritten [default: the current folder]");
  command->add_option("--port", options->port, "Port on this machine [default: one that is free]");
  command->add_option("--device", options->device,
                      "A camera to track a face with, live: kinect, openni, openni:URI, webcam:N, "
                      "or play:RECORDING, which plays a recording at its own pace");
  command
      ->add_option("--mirrored", *mirrored,
                   "Whether the camera's pictures are mirrored. Required for a webcam")
      ->check(CLI::IsMember({"yes", "no"}))
      ->option_text("yes|no");
  command->add_flag("--no-browser", *no_browser, "Print the address, but do not open a browser");
  command->add_flag("--no-cache", *no_cache, "Neither keep nor use results of earlier runs");
  command->add_flag("--no-bands", *no_bands,
                    "Do not compute error bands of curves while nothing else is to do, which keeps "
                    "the processors idle, as on battery");
  command->footer("Example: hyperex studio examples/demo.toml");
  command->callback([=] {
    take_library_memory();
    Progress::silence(true);
    check_device(options->device, *mirrored);
    options->mirrored = *mirrored == "yes";
    options->open_browser = !*no_browser;
    options->bands = !*no_bands;
    options->version = version();
    if (!*no_cache) options->kept = KeptResults(user_cache_folder());
    studio::run_studio(*options);
  });
}

}  // namespace hyperex::cli
