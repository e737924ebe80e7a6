// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/tracking_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hyperex/report/page_data.hpp"
#include "hyperex/report/page_template.hpp"
#include "hyperex/report/tracking_channels.hpp"

namespace hyperex::report {
namespace {

using nlohmann::json;

constexpr int kMost = std::numeric_limits<std::int16_t>::max();
constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::min();

double finest_step(const std::string& unit) {
  if (unit.empty()) return 0.001;
  return unit == "%" ? 0.1 : 0.01;
}

json channel_json(const TrackingChannel& channel, BinaryBlock& block) {
  double largest = 0;
  for (const double value : channel.values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  double step = finest_step(channel.unit);
  while (largest / step > kMost) step *= 10;
  std::vector<std::int16_t> steps;
  steps.reserve(channel.values.size());
  for (const double value : channel.values)
    steps.push_back(std::isfinite(value) ? std::int16_t(std::lround(value / step)) : kNone);
  return {{"group", channel.group}, {"name", channel.name}, {"facs", channel.facs},
          {"unit", channel.unit},   {"step", step},         {"values", block.add(steps)}};
}

/// Frames in a row that are not valid for the same reason, as rows of `frames`.
json faults_json(const TrackingCurves& curves, const tracking::Tracking& tracking) {
  json runs = json::array();
  for (std::size_t i = 0; i < curves.frames.size(); ++i) {
    const tracking::TrackedFrame& frame = tracking.frames[curves.frames[i]];
    if (frame.valid) continue;
    if (!runs.empty() && runs.back()["last"] == i - 1 && runs.back()["fault"] == frame.fault)
      runs.back()["last"] = i;
    else
      runs.push_back({{"first", i}, {"last", i}, {"fault", frame.fault}});
  }
  return runs;
}

std::string last_part(const std::string& recording) {
  std::filesystem::path path = std::filesystem::path(recording).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string name = path.filename().string();
  return name.empty() || name == "." ? recording : name;
}

json tracking_manifest(const TrackingPageInput& input, BinaryBlock& block) {
  const tracking::Tracking& tracking = input.tracking;
  const TrackingCurves curves = tracking_curves(input.model, tracking);
  const double start_s = curves.time_s.empty() ? 0 : curves.time_s.front();
  json time_s = json::array();
  std::vector<int> index;
  for (std::size_t i = 0; i < curves.frames.size(); ++i) {
    time_s.push_back(std::round((curves.time_s[i] - start_s) * 1e6) / 1e6);
    index.push_back(int(tracking.frames[curves.frames[i]].index));
  }
  json channels = json::array();
  for (const auto& channel : curves.channels) channels.push_back(channel_json(channel, block));
  const auto& frames = tracking.frames;
  const auto valid =
      std::count_if(frames.begin(), frames.end(), [](const auto& frame) { return frame.valid; });
  return {{"version", 1},
          {"recording", last_part(input.recording)},
          {"model",
           {{"name", input.model.name},
            {"vertices", input.model.vertex_count()},
            {"units", input.model.animation_units.size()}}},
          {"metric", tracking.neutral->metric},
          {"eye_distance_mm", input.eye_distance_mm},
          {"notes", input.notes},
          {"frames", frames.size()},
          {"valid", valid},
          {"start_s", start_s},
          {"time_s", time_s},
          {"index", block.add(index)},
          {"reference", curves.reference},
          {"faults", faults_json(curves, tracking)},
          {"channels", channels}};
}

}  // namespace

void write_tracking_page(const std::filesystem::path& file, const TrackingPageInput& input) {
  BinaryBlock block;
  const json manifest = tracking_manifest(input, block);
  write_page(file, page_template(Page::tracking), manifest, block);
}

}  // namespace hyperex::report
