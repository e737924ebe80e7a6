// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/estimate.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/estimate/words.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/run/earlier_run.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;

struct EstimateOptions {
  fs::path scene, out;
  std::vector<std::string> overrides;
  std::vector<std::string> weights;
  estimate::Request request;
};

/// "FILE:POINT:GRAMS"; the file's name may contain colons.
estimate::HungWeight weight_of(const std::string& text) {
  const std::size_t last = text.rfind(':');
  const std::size_t middle =
      last == std::string::npos || last == 0 ? last : text.rfind(':', last - 1);
  const auto grams =
      middle == std::string::npos ? std::nullopt : io::parse_number(text.substr(last + 1));
  if (!grams || middle == last || middle == 0 || last == middle + 1)
    throw InputError(InputProblem{{}, 0, "--weight", text, "FILE:POINT:GRAMS"});
  return {text.substr(0, middle), text.substr(middle + 1, last - middle - 1), 1e-3 * *grams};
}

void run(const EstimateOptions& options) {
  estimate::Request request = options.request;
  for (const std::string& text : options.weights) request.weights.push_back(weight_of(text));
  const scene::Scene scene = scene::read_scene(options.scene, options.overrides);
  std::vector<fs::path> inputs = run::files_named_by(scene);
  inputs.insert(inputs.end(), request.recordings.begin(), request.recordings.end());
  inputs.push_back(request.lying);
  for (const estimate::HungWeight& weight : request.weights) inputs.push_back(weight.recording);
  check_outputs({options.out}, inputs);
  check_output_kinds({{options.out, {".json"}, "{", {"\"findings\"", "\"model_error_scale\""}}});
  const estimate::Estimate found = estimate::estimate(scene, request);
  for (const std::string& remark : found.remarks) spdlog::warn("{}", remark);
  for (const estimate::Observation& seen : found.recordings)
    std::cout << (seen.load < 0 ? fmt::format("{}: peak at {:.2f} s\n", seen.name, seen.time_s)
                                : fmt::format("{}: {} samples under the load, from {:.2f} s\n",
                                              seen.name, seen.samples, seen.time_s));
  std::cout << fmt::format("{} points; observed less modelled {:.2f} mm rms\n\n",
                           found.points.size(), 1e3 * found.rms_m);
  for (const std::string& sentence : estimate::sentences(found)) std::cout << sentence << '\n';
  std::cout << "Both sides are assumed to be tried alike. This is no medical device.\n";
  if (!options.out.empty())
    write_file_atomically(options.out, [&](std::ostream& out) { out << estimate::as_json(found); });
}

}  // namespace

void add_estimate(CLI::App& program) {
  auto options = std::make_shared<EstimateOptions>();
  CLI::App* command = program.add_subcommand(
      "estimate",
      "How much stiffer one part of the tissue is than another, and how strongly a muscle acts, "
      "from recordings of a face: each answer has a 95 % interval, or says that the recordings "
      "cannot tell and which further expression would help most (docs/uncertainty.md).");
  command->add_option("SCENE", options->scene, "The scene (TOML): scan and first recording")
      ->required();
  command->add_option("--recording", options->request.recordings,
                      "A recording of another expression of the same face, of the same kind as the "
                      "scene's; can be repeated");
  command->add_option("--stiffness", options->request.stiffness,
                      "A ratio to find: cheek_L:cheek_R, or cheek_L (to what the scene has there), "
                      "or tissue.region[0] (a scar or painted part of the scene); can be repeated");
  command->add_option("--gain", options->request.gains,
                      "A muscle, or a branch of the facial nerve on one side, whose strength to "
                      "find: zyg_major_R, zygomatic_R; can be repeated");
  command->add_option(
      "--lying", options->request.lying,
      "Points of the relaxed face (CSV, TRC), upright in the first sample and lying "
      "face up at the end: gravity is a known load, which tells how stiff the tissue "
      "is");
  command->add_option(
      "--weight", options->weights,
      "Points of the relaxed face, without a weight in the first sample and with "
      "one at the end that hangs from a landmark: FILE:POINT:GRAMS; can be repeated");
  command->add_option("--set", options->overrides, "Override a key of the scene; can be repeated");
  command->add_option("--out", options->out, "Write everything here (.json)");
  command->footer(
      "Example:\n  hyperex estimate patient.toml --recording pucker.csv --stiffness "
      "cheek_L:cheek_R");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
