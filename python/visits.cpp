// SPDX-License-Identifier: GPL-3.0-or-later
// What changed between visits.
#include <fmt/format.h>

#include "bind.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visits_page.hpp"
#include "hyperex/visits/visits_table.hpp"

namespace hyperex::python {
namespace {

using namespace visits;
using Pair = std::pair<double, double>;

std::optional<Pair> pair_of(const std::optional<Interval>& interval) {
  if (!interval) return std::nullopt;
  return Pair{interval->low, interval->high};
}

void bind_figures(py::module_& m) {
  py::class_<VisitValue>(m, "VisitValue", "A measure at one visit: the mean of its recordings.")
      .def_readonly("value", &VisitValue::value)
      .def_property_readonly(
          "measured", [](const VisitValue& self) { return pair_of(self.measured); },
          "95 % interval by measurement alone; None: not known.")
      .def_readonly("recordings", &VisitValue::recordings);
  py::class_<Change>(m, "VisitChange", "The difference of a visit from the first.")
      .def_readonly("value", &Change::value)
      .def_property_readonly(
          "interval", [](const Change& self) { return pair_of(self.all); },
          "95 %, with repetition; None: not known, as the error of measurement is not.")
      .def_property_readonly(
          "measured", [](const Change& self) { return pair_of(self.measured); },
          "95 %, by measurement alone; None: not known.")
      .def_property_readonly(
          "beyond", [](const Change& self) { return words_of(self.beyond); },
          "Whether 0 lies outside the interval: \"yes\", \"no\" or \"cannot tell\".")
      .def_readonly("largest", &Change::largest, "The largest part of the error.");
  py::class_<MeasureOverVisits>(m, "MeasureOverVisits", "One measure at all visits.")
      .def_property_readonly("key", [](const MeasureOverVisits& s) { return s.measure.key; })
      .def_property_readonly("words", [](const MeasureOverVisits& s) { return s.measure.words; })
      .def_property_readonly(
          "side", [](const MeasureOverVisits& s) { return s.measure.side; },
          "\"R\", \"L\" or \"\".")
      .def_property_readonly(
          "unit", [](const MeasureOverVisits& s) { return s.measure.unit; },
          "\"mm\", \"degrees\" or \"%\".")
      .def_readonly("values", &MeasureOverVisits::values, "A visit; None: not measured.")
      .def_readonly("changes", &MeasureOverVisits::changes,
                    "A visit; None for the first, and where faces differ in scale.")
      .def("__repr__", [](const MeasureOverVisits& s) {
        return fmt::format("<hyperex.MeasureOverVisits {} {}>", s.measure.key, s.measure.side);
      });
}

}  // namespace

void bind_visits(py::module_& m) {
  bind_figures(m);
  py::class_<Comparison>(m, "Visits", "What changed between a patient's visits.")
      .def_readonly("measures", &Comparison::measures)
      .def_property_readonly("labels",
                             [](const Comparison& self) {
                               std::vector<std::string> labels;
                               for (const VisitEntry& visit : self.file.visits)
                                 labels.push_back(visit.label);
                               return labels;
                             })
      .def_property_readonly(
          "summary", [](const Comparison& self) { return summary(self); }, "In sentences.")
      .def_property_readonly(
          "remarks",
          [](const Comparison& self) {
            std::vector<std::string> all = choices(self);
            for (const auto& more : {doubts(self), remarks(self)})
              all.insert(all.end(), more.begin(), more.end());
            return all;
          },
          "What the reader must know of the recordings.")
      .def(
          "__getitem__",
          [](const Comparison& self, const std::pair<std::string, std::string>& name) {
            for (const MeasureOverVisits& one : self.measures)
              if (one.measure.key == name.first && one.measure.side == name.second) return one;
            throw py::key_error(name.first + ", " + name.second);
          },
          "key_and_side"_a, "visits[\"corner_excursion\", \"R\"].")
      .def(
          "write_page",
          [](const Comparison& self, const std::filesystem::path& file) {
            write_visits_page(file, self);
          },
          "file"_a, Unlocked(), "HTML that prints on one page of A4.")
      .def(
          "write_table",
          [](const Comparison& self, const std::filesystem::path& file) {
            write_visits_table(file, self);
          },
          "file"_a, Unlocked(), "CSV.");
  m.def(
      "compare_visits",
      [](const std::filesystem::path& file) { return compare_visits(read_visits(file)); }, "file"_a,
      Unlocked(), "As `hyperex visits FILE` (docs/visits.md).");
}

}  // namespace hyperex::python
