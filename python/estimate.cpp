// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates of tissue and muscles from recordings.
#include "hyperex/estimate/estimate.hpp"

#include <fmt/format.h>

#include <optional>

#include "bind.hpp"
#include "hyperex/estimate/words.hpp"

namespace hyperex::python {
namespace {

using namespace estimate;
using Pair = std::pair<double, double>;
using Paths = std::vector<std::filesystem::path>;
using Names = std::vector<std::string>;

Pair pair_of(const Range& range) {
  return {range.low, range.high};
}

/// Recording, landmark, kilograms.
using Weights = std::vector<std::tuple<std::filesystem::path, std::string, double>>;

Estimate estimated(const std::filesystem::path& scene, const Paths& recordings,
                   const Names& stiffness, const Names& gains,
                   const std::optional<std::filesystem::path>& lying, const Weights& weights) {
  Request request{.recordings = recordings,
                  .stiffness = stiffness,
                  .gains = gains,
                  .lying = lying.value_or(""),
                  .weights = {},
                  .assumptions = {}};
  for (const auto& [recording, point, mass_kg] : weights)
    request.weights.push_back({recording, point, mass_kg});
  return estimate::estimate(scene::read_scene(scene), request);
}

const char* kind_of(Finding::Kind kind) {
  if (kind == Finding::Kind::young) return "young_kpa";
  return kind == Finding::Kind::ratio ? "ratio" : "gain";
}

}  // namespace

void bind_estimate(py::module_& m) {
  py::class_<Finding>(m, "Finding",
                      "A ratio of stiffness, the gain of a muscle, or the tissue's stiffness.")
      .def_readonly("name", &Finding::name)
      .def_property_readonly(
          "kind", [](const Finding& self) { return kind_of(self.kind); },
          "\"ratio\", \"gain\", or \"young_kpa\".")
      .def_readonly("value", &Finding::value)
      .def_property_readonly(
          "interval", [](const Finding& self) { return pair_of(self.interval); },
          "95 %, by profile likelihood.")
      .def_readonly(
          "determined", &Finding::determined,
          "Whether the interval is narrow enough to be an answer. If not, it may still exclude 1.")
      .def_property_readonly(
          "largest_part", [](const Finding& self) { return self.parts.front().words; },
          "What makes the interval wide.")
      .def_readonly("further", &Finding::further,
                    "The expression whose recording would narrow it most; may be empty.")
      .def_property_readonly(
          "further_interval", [](const Finding& self) { return pair_of(self.further_interval); },
          "The interval expected then.")
      .def("__repr__", [](const Finding& self) {
        return fmt::format("<hyperex.Finding {}: {:.2f}, {:.2f} to {:.2f}>", self.name, self.value,
                           self.interval.low, self.interval.high);
      });
  py::class_<Estimate>(m, "Estimate", "What recordings tell of tissue and muscles.")
      .def_readonly("findings", &Estimate::findings, "Ratios, then gains, as asked for.")
      .def_readonly("points", &Estimate::points)
      .def_readonly("remarks", &Estimate::remarks)
      .def_property_readonly("summary", [](const Estimate& self) { return sentences(self); })
      .def(
          "json", [](const Estimate& self) { return as_json(self); },
          "Everything, as hyperex estimate --out writes it.");
  m.def("estimate", &estimated, "scene"_a, py::kw_only(), "recordings"_a = Paths(),
        "stiffness"_a = Names(), "gains"_a = Names(), "lying"_a = py::none(),
        "weights"_a = Weights(), Unlocked(),
        "As `hyperex estimate SCENE` (docs/uncertainty.md). `weights`: recording, landmark, kg.");
}

}  // namespace hyperex::python
