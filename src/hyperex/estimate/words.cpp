// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/words.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace hyperex::estimate {
namespace {

std::string kpa(double value) {
  return fmt::format("{:.{}f}", value, value < 10 ? 1 : 0);
}

/// "1.42 to 2.31"; "8.1 to 15 kPa".
std::string range_words(const Finding& f, const Range& range) {
  if (f.kind == Finding::Kind::young)
    return fmt::format("{} to {} kPa", kpa(range.low), kpa(range.high));
  return fmt::format("{:.2f} to {:.2f}", range.low, range.high);
}

std::string value_words(const Finding& f) {
  if (f.kind == Finding::Kind::young) return kpa(f.value) + " kPa";
  return fmt::format("{:.2f}", f.value);
}

const char* key_of(Finding::Kind kind) {
  if (kind == Finding::Kind::young) return "young_kpa";
  return kind == Finding::Kind::ratio ? "stiffness_ratio" : "gain";
}

/// "cheek_L is stiffer than cheek_R".
std::string meaning(const Finding& f) {
  const bool above = f.interval.low > 1, below = f.interval.high < 1;
  if (f.kind == Finding::Kind::gain)
    return above   ? "acts more strongly than its counterpart"
           : below ? "acts less strongly than its counterpart"
                   : "no difference from its counterpart is shown";
  const std::size_t slash = f.name.find(" / ");
  const std::string over = f.name.substr(0, slash);
  const std::string under =
      slash == std::string::npos ? "the scene has it" : f.name.substr(slash + 3) + " is";
  if (f.kind == Finding::Kind::young)
    return "Young's modulus, where the scene makes no part stiffer or softer";
  return above   ? fmt::format("{} is stiffer than {}", over, under)
         : below ? fmt::format("{} is softer than {}", over, under)
                 : "no difference is shown";
}

/// Whether the interval excludes 1, no difference. Young's modulus has nothing to differ from.
bool shows_a_difference(const Finding& f) {
  return f.kind != Finding::Kind::young && (f.interval.low > 1 || f.interval.high < 1);
}

std::string answer(const Finding& f, std::size_t recordings) {
  const std::string range = range_words(f, f.interval);
  if (f.determined)
    return fmt::format("{}: {} (95 %: {}): {}.", f.name, value_words(f), range, meaning(f));
  if (shows_a_difference(f))
    return fmt::format("{}: {}, but by how much cannot be determined (95 %: {}).", f.name,
                       meaning(f), range);
  return fmt::format("{}: {} cannot tell (95 %: {}).", f.name,
                     recordings == 1 ? "this recording" : "these recordings", range);
}

std::string sentence(const Finding& f, std::size_t recordings) {
  std::string out = answer(f, recordings);
  out += fmt::format(" Largest part of the interval: {}.", f.parts.front().words);
  if (!f.further.empty())
    out += fmt::format(" A recording of \"{}\" beside {} would narrow it most, to about {}.",
                       f.further, recordings == 1 ? "this one" : "these",
                       range_words(f, f.further_interval));
  return out;
}

nlohmann::json json_of(const Range& range) {
  return {range.low, range.high};
}

}  // namespace

std::vector<std::string> sentences(const Estimate& estimate) {
  std::vector<std::string> out;
  for (const Finding& finding : estimate.findings)
    out.push_back(sentence(finding, estimate.recordings.size()));
  for (const Alike& pair : estimate.alike)
    out.push_back(
        fmt::format("{} and {} move these {} points {} (cosine {:.2f}): their effects "
                    "are hard to tell apart.",
                    pair.a, pair.b, estimate.points.size(),
                    pair.cosine > 0 ? "alike" : "in opposite ways", pair.cosine));
  return out;
}

std::string as_json(const Estimate& estimate) {
  nlohmann::json out;
  for (const Finding& f : estimate.findings) {
    nlohmann::json one{{"name", f.name},
                       {"kind", key_of(f.kind)},
                       {"value", f.value},
                       {"interval_95", json_of(f.interval)},
                       {"laplace_95", json_of(f.laplace)},
                       {"determined", f.determined}};
    for (const ErrorPart& part : f.parts)
      one["parts"].push_back({{"of", part.words}, {"share_of_variance", part.share}});
    if (!f.further.empty())
      one["further_recording"] = {{"expression", f.further},
                                  {"expected_interval_95", json_of(f.further_interval)}};
    out["findings"].push_back(one);
  }
  out["alike"] = nlohmann::json::array();
  for (const Alike& pair : estimate.alike)
    out["alike"].push_back({{"a", pair.a}, {"b", pair.b}, {"cosine", pair.cosine}});
  for (const Observation& seen : estimate.recordings)
    out["recordings"].push_back(
        {{"name", seen.name}, {"peak_s", seen.time_s}, {"noise_mm", 1e3 * seen.noise_m}});
  out["scenes_young_kpa"] = estimate.scenes_young_kpa;
  out["points"] = estimate.points;
  out["fit_rms_mm"] = 1e3 * estimate.rms_m;
  out["model_error_scale"] = estimate.error_scale;
  out["remarks"] = estimate.remarks;
  return out.dump(2) + "\n";
}

}  // namespace hyperex::estimate
