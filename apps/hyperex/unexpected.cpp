// SPDX-License-Identifier: GPL-3.0-or-later
#include "unexpected.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hyperex/scene/keys.hpp"

namespace hyperex::cli {
namespace {

/// What to do where a command lacks an option that others have.
struct InPlaceOf {
  const char *command, *option, *advice;
};
constexpr InPlaceOf kInPlaceOf[] = {
    {"studio", "--set", "put the key into the scene file"},
    {"rig", "--no-cache", "it neither keeps nor uses results of earlier runs"},
};

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// "studio has no --set: put the key into the scene file".
std::string unknown_option(const CLI::App& command, const std::string& option) {
  const std::string refusal = fmt::format("{} has no {}", command.get_name(), option);
  for (const InPlaceOf& known : kInPlaceOf)
    if (command.get_name() == known.command && option == known.option)
      return refusal + ": " + known.advice;
  const std::string near = scene::nearest(option, options_of(command));
  if (!near.empty()) return fmt::format("{} (did you mean {}?)", refusal, near);
  const std::string words =
      command.get_parent() ? "hyperex " + command.get_name() : std::string("hyperex");
  return fmt::format("{}; {} --help lists its options", refusal, words);
}

/// "--set key value" for "--set key=value": the key that has no value; else empty.
std::string setting_without_value(const CLI::App& command) {
  const CLI::Option* set = command.get_option_no_throw("--set");
  if (!set) return "";
  const auto settings = set->results();
  const auto found = std::ranges::find_if(
      settings, [](const std::string& setting) { return setting.find('=') == std::string::npos; });
  return found == settings.end() ? "" : *found;
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

std::string unexpected_of(const CLI::App& command) {
  std::vector<std::string> lines;
  std::string others;
  for (const std::string& argument : command.remaining())
    if (!is_option(argument)) {
      others += (others.empty() ? "" : " ") + argument;
    } else {
      const std::string line = unknown_option(command, argument.substr(0, argument.find('=')));
      if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
    }
  if (const std::string key = setting_without_value(command); !key.empty())
    lines = {fmt::format("--set expects KEY=VALUE: '{}' has no '='", key)};
  // After an unknown option, the others may be its values.
  if (lines.empty())
    lines = {fmt::format("{} does not expect this: {}", command.get_name(), others)};
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

std::string unexpected(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands())
    if (command->remaining_size() > 0) return unexpected_of(*command);
  return unexpected_of(program);
}

}  // namespace hyperex::cli
