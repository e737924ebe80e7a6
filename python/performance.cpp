// SPDX-License-Identifier: GPL-3.0-or-later
// The moving face that a run gives, and the report of the run.
#include "performance.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/simulate/load/known_activation.hpp"

namespace hyperex::python {
namespace {

using simulate::MuscleCourse;
using simulate::SimulationReport;

py::object skin_displacement(RunResult& self) {
  if (!self.skin_stack)
    self.skin_stack =
        stacked(self.performance().skin_displacement_m, self.performance().skin_rest.points.rows());
  return self.skin_stack;
}
py::object node_displacement(RunResult& self) {
  if (!self.node_stack)
    self.node_stack =
        stacked(self.performance().node_displacement_m, self.performance().nodes.rows());
  return self.node_stack;
}

/// Counted from the end where below 0, as Python does.
const PointsF& frame_in(const std::vector<PointsF>& frames, py::ssize_t frame) {
  const auto count = static_cast<py::ssize_t>(frames.size());
  if (frame < -count || frame >= count)
    throw py::index_error(fmt::format("frame {} of {}", frame, count));
  return frames[static_cast<std::size_t>(frame < 0 ? frame + count : frame)];
}
py::array frame_of(const py::object& self, const std::vector<PointsF>& frames, py::ssize_t frame) {
  return view(frame_in(frames, frame), self);
}

std::map<std::string, py::array_t<double>> gaze_of(const RunResult& self) {
  const auto& gaze = self.performance().gaze;
  std::map<std::string, py::array_t<double>> columns;
  for (std::size_t c = 0; !gaze.empty() && c < expression::kGazeNames.size(); ++c) {
    py::array_t<double> column(static_cast<py::ssize_t>(gaze.size()));
    for (std::size_t f = 0; f < gaze.size(); ++f)
      column.mutable_at(static_cast<py::ssize_t>(f)) = expression::degrees_of(gaze[f])[c];
    columns.emplace(expression::kGazeNames[c], std::move(column));
  }
  return columns;
}

TriMesh skin_at(const RunResult& self, py::ssize_t frame) {
  const simulate::Performance& p = self.performance();
  return {p.skin_rest.points + frame_in(p.skin_displacement_m, frame).cast<double>(),
          p.skin_rest.triangles};
}

/// Names of the muscles of which `holds(muscle, sample)`. A sample below 0 counts from the end.
template <class Holds>
std::vector<std::string> muscles_in(const MuscleCourse& course, py::ssize_t sample, Holds holds) {
  const auto count = static_cast<py::ssize_t>(course.time_s.size());
  if (sample < -count || sample >= count)
    throw py::index_error(fmt::format("sample {} of {}", sample, count));
  std::vector<std::string> names;
  for (std::size_t m = 0; m < course.names.size(); ++m)
    if (holds(Eigen::Index(m), Eigen::Index(sample < 0 ? sample + count : sample)))
      names.push_back(course.names[m]);
  return names;
}

void bind_muscles(py::module_& m) {
  py::class_<MuscleCourse>(m, "MuscleCourse", "What the muscles do that move a face, over time.")
      .def_readonly("names", &MuscleCourse::names,
                    "\"zyg_major_L\" and so on; empty where no muscles drive.")
      .def_readonly("time_s", &MuscleCourse::time_s, "Of the samples.")
      .def_readonly("activation", &MuscleCourse::activation,
                    "names x samples; at 1 a muscle moves some part of the skin by 10 mm.")
      .def_readonly("sigma", &MuscleCourse::sigma,
                    "Its standard deviation, from the points' errors and the prior.")
      .def_readonly("prior_sigma", &MuscleCourse::prior_sigma, "The same before a point is seen.")
      .def(
          "different_from_zero",
          [](const MuscleCourse& self, py::ssize_t sample) {
            return muscles_in(self, sample, [&](Eigen::Index row, Eigen::Index k) {
              return simulate::differs_from_zero(self.activation(row, k), self.sigma(row, k));
            });
          },
          "sample"_a, "Names of the muscles whose 95 % interval leaves 0 out.")
      .def(
          "mostly_prior",
          [](const MuscleCourse& self, py::ssize_t sample) {
            return muscles_in(self, sample, [&](Eigen::Index row, Eigen::Index k) {
              return !simulate::muscle_words(self, row, k).empty();
            });
          },
          "sample"_a,
          "Names of the muscles whose activation is mostly the prior's choice: the recording "
          "determines less than a third of its variance.")
      .def("__repr__", [](const MuscleCourse& self) {
        return fmt::format("<hyperex.MuscleCourse of {} muscles, {} samples>", self.names.size(),
                           self.time_s.size());
      });
}

void bind_report(py::module_& m) {
  py::class_<SimulationReport>(m, "SimulationReport",
                               "What happened in a run. Seconds are 0 for what could be kept.")
      .def_readonly("free_dofs", &SimulationReport::free_dofs, "Unknowns of the full model.")
      .def_readonly("steps", &SimulationReport::steps)
      .def_readonly("driven_nodes", &SimulationReport::driven_nodes)
      .def_readonly("basis_size", &SimulationReport::basis_size,
                    "Unknowns of the reduced model; 0: the full one was run.")
      .def_readonly("estimated_error", &SimulationReport::estimated_error,
                    "Of the reduced model, over the greatest displacement; -1: none.")
      .def_readonly("verified_error", &SimulationReport::verified_error,
                    "The same, measured (SolverOptions.verify); -1: not measured.")
      .def_readonly("boundary_s", &SimulationReport::boundary_s)
      .def_readonly("assemble_s", &SimulationReport::assemble_s)
      .def_readonly("analyse_s", &SimulationReport::analyse_s)
      .def_readonly("factor_s", &SimulationReport::factor_s)
      .def_readonly("basis_s", &SimulationReport::basis_s)
      .def_readonly("simulate_s", &SimulationReport::simulate_s)
      .def_readonly("skin_s", &SimulationReport::skin_s)
      .def_readonly("forces_found_anew", &SimulationReport::forces_found_anew,
                    "Where forces drive: tissue or support was changed after a run without "
                    "hold_load(), so this run met the recording by other forces.")
      .def_readonly("inverted_tets", &SimulationReport::inverted_tets,
                    "Greatest number of tetrahedra turned inside out in any frame.")
      .def_readonly("greatest_opening_deg", &SimulationReport::greatest_opening_deg, "Of the jaw.")
      .def_readonly("driven_off_mm", &SimulationReport::driven_off_mm,
                    "Greatest distance of a driven point from where it is driven.")
      .def_readonly(
          "lip_overlap_mm", &SimulationReport::lip_overlap_mm,
          "Greatest depth by which the lips pass through each other, each vertex over its rest.")
      .def_readonly("lip_gap_mm", &SimulationReport::lip_gap_mm,
                    "Greatest distance between the lips, over rest.")
      .def_property_readonly(
          "contact_frames", [](const SimulationReport& r) { return r.contact.frames; },
          "In which something touches that would pass through without contact.")
      .def_property_readonly(
          "in_teeth_mm", [](const SimulationReport& r) { return r.contact.teeth_left_mm; },
          "With contact at the teeth: greatest depth of tissue in them, over rest.")
      .def_property_readonly(
          "in_eyes_mm", [](const SimulationReport& r) { return r.contact.eyes_left_mm; },
          "Of lids in eyeballs, likewise.")
      .def_property_readonly(
          "notes",
          [](const SimulationReport& r) {
            std::vector<std::string> texts;
            for (const Note& note : r.notes) texts.push_back(note.text);
            return texts;
          },
          "A sentence each.")
      .def("__repr__", [](const SimulationReport& r) {
        return fmt::format(
            "<hyperex.SimulationReport: {} unknowns, {} in the reduced model, {} steps, lips "
            "{:.1f} "
            "mm apart>",
            r.free_dofs, r.basis_size, r.steps, r.lip_gap_mm);
      });
}

void bind_arrays(py::class_<RunResult>& run) {
  run.def_property_readonly("skin_displacement_m", &skin_displacement,
                            "frames x vertices x 3, float32, metres; made when first asked for.")
      .def(
          "skin_displacement_at",
          [](const py::object& self, py::ssize_t frame) {
            return frame_of(self, self.cast<RunResult&>().performance().skin_displacement_m, frame);
          },
          "frame"_a, "vertices x 3, float32, metres: one frame, without a copy.")
      .def_property_readonly("node_displacement_m", &node_displacement,
                             "frames x nodes x 3, float32, metres, of the tissue.")
      .def(
          "node_displacement_at",
          [](const py::object& self, py::ssize_t frame) {
            return frame_of(self, self.cast<RunResult&>().performance().node_displacement_m, frame);
          },
          "frame"_a, "nodes x 3, float32, metres: one frame, without a copy.")
      .def_property_readonly(
          "frame_time_s",
          [](const py::object& self) {
            return view(self.cast<RunResult&>().performance().frame_time_s, self);
          },
          "Time of each frame, s.")
      .def_property_readonly(
          "gaze", &gaze_of,
          "By the names of gaze.csv (eye_yaw_R_deg ...), an array of one angle per frame, degrees; "
          "yaw above 0: to the subject's left, pitch above 0: up. Empty where the recording does "
          "not have it.")
      .def_property_readonly(
          "nodes_m",
          [](const py::object& self) {
            return view(self.cast<RunResult&>().performance().nodes, self);
          },
          "nodes x 3, metres: the tissue at rest.")
      .def_property_readonly(
          "tets",
          [](const py::object& self) {
            return view(self.cast<RunResult&>().performance().tets, self);
          },
          "|T| x 4 rows of nodes_m.");
}

}  // namespace

void bind_performance(py::module_& m) {
  bind_report(m);
  bind_muscles(m);
  py::class_<RunResult> run(m, "Performance", "A face in motion, in the scan's frame, metres.");
  bind_arrays(run);
  run.def_property_readonly(
         "skin_rest",
         [](const RunResult& self) -> const TriMesh& { return self.performance().skin_rest; },
         "The scan at rest, and vertices appended where its lips were cut.")
      .def_property_readonly(
          "scan_vertices", [](const RunResult& self) { return self.performance().scan_vertices; },
          "The first so many vertices are the scan's own.")
      .def_property_readonly(
          "peak_frame", [](const RunResult& self) { return self.performance().peak_frame; },
          "Where the driven points moved most in the mean.")
      .def_property_readonly(
          "landmarks",
          [](const RunResult& self) -> const motion::Motion& {
            return self.performance().landmarks;
          },
          "A Motion of the landmarks, at the frame times.")
      .def_property_readonly(
          "muscles",
          [](const RunResult& self) -> const MuscleCourse& { return self.performance().muscles; },
          "A MuscleCourse; without names where no muscles drive.")
      .def_property_readonly("driven_names",
                             [](const RunResult& self) { return self.performance().driven_names; })
      .def_property_readonly(
          "report",
          [](const RunResult& self) -> const SimulationReport& { return self.result.report; },
          "A SimulationReport.")
      .def("skin_at", &skin_at, "frame"_a, "The moved skin in one frame, a TriMesh.")
      .def("__repr__", [](const RunResult& self) {
        return fmt::format("<hyperex.Performance of {} frames, {} vertices>",
                           self.performance().frame_time_s.size(),
                           self.performance().skin_rest.points.rows());
      });
}

}  // namespace hyperex::python
