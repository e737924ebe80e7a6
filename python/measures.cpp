// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of a motion: excursions, symmetry.
#include <cmath>
#include <optional>

#include "arrays.hpp"
#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "options_class.hpp"
#include "performance.hpp"

namespace hyperex::python {
namespace {

using namespace metrics;
using motion::Motion;

void refuse_unless(bool sound, const char* key, double value, const char* expected) {
  if (!sound) throw InputError(InputProblem{{}, 0, key, fmt::format("{:g}", value), expected});
}

std::vector<int> columns_of(const Motion& motion, const std::vector<std::string>& names) {
  std::vector<int> columns;
  for (const std::string& name : names) {
    columns.push_back(motion.index_of(name));
    if (columns.back() < 0)
      throw InputError(InputProblem{{}, 0, "names", name, "names of points of the motion"});
  }
  if (names.empty()) throw InputError(InputProblem{{}, 0, "names", "none", "at least one point"});
  return columns;
}

py::array array_of(const std::vector<double>& values) {
  return py::array_t<double>(py::ssize_t(values.size()), values.data());
}

void bind_excursion_change(py::module_& m) {
  py::class_<ExcursionChange>(m, "ExcursionChange",
                              "The change of one side's excursion between two runs.")
      .def_readonly("from_mm", &ExcursionChange::from_mm)
      .def_readonly("to_mm", &ExcursionChange::to_mm)
      .def_property_readonly("change_mm", &ExcursionChange::change_mm)
      .def_readonly(
          "band_mm", &ExcursionChange::band_mm,
          "Uncertainty of the change due to the mesh (by the twins) and jitter (95 %); NaN without "
          "twins, and where the jitter is not known.")
      .def_readonly("known_band_mm", &ExcursionChange::known_band_mm,
                    "The same without a jitter that is not known; NaN without twins.")
      .def_property_readonly(
          "decided",
          [](const ExcursionChange& self) -> py::object {
            const double decided = self.decided();
            if (std::isnan(decided)) return py::none();
            return py::bool_(decided == 1);
          },
          "Whether the change is larger than its band; None without twins, and where it is larger "
          "than known_band_mm but the jitter is not known.")
      .def("__repr__", [](const ExcursionChange& change) {
        return fmt::format("<hyperex.ExcursionChange {:+.2f} ± {:.2f} mm>", change.change_mm(),
                           change.band_mm);
      });
  m.def(
      "change_of",
      [](const PairExcursion& before, const PairExcursion& after, const std::string& side,
         const py::object& jitter_m) {
        if (!jitter_m.is_none() &&
            PyErr_WarnEx(PyExc_DeprecationWarning,
                         "jitter_m has no effect: the jitter counts with which excursions_of() "
                         "made `before`",
                         1) != 0)
          throw py::error_already_set();
        if (side != "L" && side != "R")
          throw InputError(InputProblem{{}, 0, "side", side, "\"L\" or \"R\""});
        return change_of(before, after, side == "L" ? Side::left : Side::right);
      },
      "before"_a, "after"_a, "side"_a, "jitter_m"_a = py::none(),
      "What the excursion of a side changes by from one run to another of the same recording, and "
      "its band: the ± of `hyperex run`.");
}

void bind_excursions(py::module_& m) {
  py::class_<SideExcursion>(m, "SideExcursion", "Of one side of a pair of points.")
      .def_readonly("excursion_mm", &SideExcursion::excursion_mm,
                    "Largest distance of the smoothed path from its first sample.")
      .def_readonly("path_mm", &SideExcursion::path_mm, "Length of the whole way, smoothed.")
      .def_readonly("peak_speed_mm_s", &SideExcursion::peak_speed_mm_s, "Largest speed, smoothed.");
  py::class_<PairExcursion>(m, "PairExcursion", "A point and its counterpart on the other side.")
      .def_readonly("name", &PairExcursion::name, "\"cheilion\", \"ibug68_48/54\" (right/left).")
      .def_readonly("left", &PairExcursion::left_side, "The subject's left.")
      .def_readonly("right", &PairExcursion::right_side)
      .def_readonly("excursion_ratio", &PairExcursion::excursion_ratio, "Right over left, or NaN.")
      .def_readonly("path_ratio", &PairExcursion::path_ratio)
      .def_readonly("speed_ratio", &PairExcursion::speed_ratio)
      .def_readonly("speed_correlation", &PairExcursion::speed_correlation)
      .def_property_readonly("difference_mm", &PairExcursion::difference_mm, "Left less right.")
      .def_readonly("undecided", &PairExcursion::undecided,
                    "The excursions differ by less than jitter, the mesh and the head's pose "
                    "together explain, as far as these are known.")
      .def_property_readonly(
          "decided",
          [](const PairExcursion& self) -> py::object {
            const auto decided = self.decided(self.undecided);
            return decided ? py::object(py::bool_(*decided)) : py::object(py::none());
          },
          "Whether the excursions differ by more than all noise explains; None if they differ by "
          "more than what is known of it, but the jitter is not known.")
      .def("__repr__", [](const PairExcursion& pair) {
        return fmt::format("<hyperex.PairExcursion {}: left {:.2f} mm, right {:.2f} mm>", pair.name,
                           pair.left_side.excursion_mm, pair.right_side.excursion_mm);
      });
  py::class_<Excursions>(m, "Excursions", "Of all pairs of points of a motion.")
      .def_readonly("pairs", &Excursions::pairs)
      .def(
          "__getitem__",
          [](const Excursions& self, const std::string& name) {
            for (const PairExcursion& pair : self.pairs)
              if (pair.name == name) return pair;
            throw py::key_error(name);
          },
          "name"_a, "The pair of that name.")
      .def_property_readonly(
          "commissure_left_mm",
          [](const Excursions& self) { return array_of(self.commissure.left_mm); },
          "Of the left corner of the mouth: distance from rest, a sample.")
      .def_property_readonly("commissure_right_mm", [](const Excursions& self) {
        return array_of(self.commissure.right_mm);
      });
  m.def(
      "excursions_of",
      [](const Motion& motion, double jitter_m, double lowpass_hz,
         const std::optional<Motion>& twin) {
        refuse_unless(jitter_m >= 0, "jitter_m", jitter_m, "a number from 0 (m)");
        refuse_unless(lowpass_hz >= 0, "lowpass_hz", lowpass_hz, "a number from 0 (Hz)");
        Excursions excursions = excursions_of(motion, jitter_m, lowpass_hz);
        if (!twin) return excursions;
        if (twin->names != motion.names || twin->positions.size() != motion.positions.size())
          throw InputError(
              InputProblem{{}, 0, "twin", "another motion", "the names and samples of the motion"});
        add_mesh_floor(excursions, motion, *twin);
        return excursions;
      },
      "motion"_a, "jitter_m"_a = 0.0, "lowpass_hz"_a = kUsualLowpass_hz, "twin"_a = py::none(),
      Unlocked(),
      "How far both points of each pair travel. `jitter_m` is that of the recorded points; `twin`: "
      "the landmarks of a run of the mirrored motion (Scene.mirrored_motion), which shows the "
      "effect of the mesh on a figure.");
  m.def("write_excursions_csv", &write_excursions_csv, "file"_a, "excursions"_a, Unlocked(),
        "A row a pair of points.");
  m.def(
      "distance_from_rest_mm",
      [](const Motion& motion, const std::vector<std::string>& names) {
        return array_of(distance_from_rest_mm(motion, columns_of(motion, names)));
      },
      "motion"_a, "names"_a,
      "Distance of the mean of the named points from its place in the first sample: mm, a "
      "sample; NaN where not measured.");
}

void bind_symmetry(py::module_& m) {
  py::class_<SymmetryCurve>(m, "SymmetryCurve",
                            "S(t) = ln |xi_L - xi_R|; smaller: both sides stretch more alike. It "
                            "does not say how far they move in mm, and grades no palsy.")
      .def_property_readonly("time_s",
                             [](const SymmetryCurve& self) { return array_of(self.time_s); })
      .def_property_readonly(
          "xi_left", [](const SymmetryCurve& self) { return array_of(self.xi_left); },
          "Summed relative changes of four distances to the left corner of the mouth.")
      .def_property_readonly("xi_right",
                             [](const SymmetryCurve& self) { return array_of(self.xi_right); })
      .def_property_readonly(
          "s", [](const SymmetryCurve& self) { return array_of(self.s); }, "Natural logarithm.")
      .def_property_readonly(
          "floors", [](const SymmetryCurve& self) { return array_of(self.floors()); },
          "What |xi_L - xi_R| of a symmetric motion stays under; empty where not known.")
      .def_readonly("stand_ins", &SymmetryCurve::stand_ins, "Points used for absent ones.");
  m.def(
      "symmetry_of",
      [](const Motion& landmarks, double floor, double jitter_m) {
        return symmetry_of(landmarks, floor, jitter_m);
      },
      "landmarks"_a, "floor"_a = 1e-6, "jitter_m"_a = 0.0, Unlocked(),
      "S(t) of the named points of a motion.");
  m.def("jitter_at_rest", &jitter_at_rest, "landmarks"_a, "window_s"_a = 0.5, Unlocked(),
        "Standard deviation of a coordinate in the quietest window, m.");
}

}  // namespace

void bind_measures(py::module_& m) {
  bind_excursions(m);
  bind_excursion_change(m);
  bind_symmetry(m);
}

}  // namespace hyperex::python
