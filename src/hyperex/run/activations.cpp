// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/activations.hpp"

#include <fmt/format.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/io/csv.hpp"
#include "hyperex/simulate/load/known_activation.hpp"

namespace hyperex::run {

Eigen::Index most_active_sample(const simulate::MuscleCourse& muscles) {
  Eigen::Index at = 0;
  muscles.activation.cwiseAbs().colwise().sum().maxCoeff(&at);
  return at;
}

namespace {

/// The muscles' numbers, of each pair the right one first, as in every other table.
std::vector<std::size_t> right_first(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  for (std::size_t m = 0; m + 1 < names.size(); ++m) {
    const std::string& name = names[m];
    if (name.ends_with("_L") && names[m + 1] == name.substr(0, name.size() - 1) + "R")
      std::swap(order[m], order[m + 1]);
  }
  return order;
}

void add_group(const simulate::MuscleCourse& muscles, Eigen::Index row, Eigen::Index at,
               nlohmann::ordered_json& groups) {
  const std::string& name = muscles.groups[std::size_t(row)];
  const std::string side = name.substr(name.size() - 1);
  auto& group = groups[name.substr(0, name.size() - 2)];
  group["activation"][side] = muscles.group_activation(row, at);
  group["sigma"][side] = muscles.group_sigma(row, at);
  group["determined"][side] = simulate::group_share(muscles, row, at);
  if (std::string words = simulate::group_words(muscles, row, at); !words.empty())
    group["note"][side] = std::move(words);
}

void add_muscles(const simulate::MuscleCourse& muscles, Eigen::Index at,
                 nlohmann::ordered_json& json) {
  auto active = nlohmann::ordered_json::array(), of_prior = active;
  for (const std::size_t m : right_first(muscles.names)) {
    const auto row = Eigen::Index(m);
    if (simulate::differs_from_zero(muscles.activation(row, at), muscles.sigma(row, at)))
      active.push_back(muscles.names[m]);
    if (!simulate::muscle_words(muscles, row, at).empty()) of_prior.push_back(muscles.names[m]);
  }
  json["count"] = muscles.names.size();
  json["differ_from_zero"] = std::move(active);
  json["mostly_prior"] = std::move(of_prior);
}

}  // namespace

void write_activations_csv(const std::filesystem::path& file,
                           const simulate::MuscleCourse& muscles) {
  std::vector<std::string> columns = {"time_s", "jaw_opening_deg"};
  const std::vector<std::size_t> order = right_first(muscles.names);
  for (const std::size_t m : order) {
    columns.push_back(muscles.names[m]);
    columns.push_back(muscles.names[m] + "_sigma");
  }
  io::write_csv(file, columns, static_cast<long>(muscles.time_s.size()),
                [&](long row, std::vector<double>& values) {
                  values[0] = muscles.time_s[std::size_t(row)];
                  values[1] = muscles.jaw_opening_deg[row];
                  for (std::size_t i = 0; i < order.size(); ++i) {
                    const auto m = Eigen::Index(order[i]);
                    values[2 + 2 * i] = muscles.activation(m, row);
                    values[3 + 2 * i] = muscles.sigma(m, row);
                  }
                });
}

nlohmann::ordered_json activations_json(const simulate::MuscleCourse& muscles) {
  nlohmann::ordered_json json;
  if (muscles.groups.empty()) return json;
  const Eigen::Index at = most_active_sample(muscles);
  json["time_s"] = muscles.time_s[std::size_t(at)];
  json["jaw_opening_deg"] = muscles.jaw_opening_deg[at];
  for (std::size_t g = 0; g < muscles.groups.size(); ++g)
    add_group(muscles, Eigen::Index(g), at, json["groups"]);
  add_muscles(muscles, at, json);
  json["reading"] =
      muscles.few_points
          ? "so few points leave most of an activation to the prior: a means of moving the face, "
            "not a measurement of muscles"
          : "sums over muscles that points on the skin can hardly distinguish; sigma includes the "
            "points' errors and the prior, not wrong lines or tissue";
  return json;
}

std::string activations_line(const nlohmann::ordered_json& summary) {
  const auto found = summary.find("muscles");
  if (found == summary.end() || !found->is_object() || !found->contains("mostly_prior")) return "";
  return fmt::format(
      "activations of the {} muscles at {:.2f} s: different from 0 (95 %) {}, {} {}\n",
      (*found)["count"].get<std::size_t>(), (*found)["time_s"].get<double>(),
      (*found)["differ_from_zero"].size(), simulate::kMostlyPriorWords,
      (*found)["mostly_prior"].size());
}

}  // namespace hyperex::run
