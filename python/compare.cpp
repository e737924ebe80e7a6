// SPDX-License-Identifier: GPL-3.0-or-later
// Distances: to another scan, between two runs, of a face from its own reflection.
#include "arrays.hpp"
#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "options_class.hpp"
#include "performance.hpp"

namespace hyperex::python {
namespace {

using namespace metrics;

std::map<std::string, std::vector<int>> regions(const Points& rest_m,
                                                const io::Landmarks& landmarks) {
  std::map<std::string, std::vector<int>> all;
  for (const Region& region : regions_of(rest_m, landmarks).regions)
    all[region.name] = region.vertices;
  return all;
}

DistanceStatistics statistics(const Eigen::VectorXd& distance_m,
                              const std::optional<std::vector<int>>& vertices) {
  if (!vertices) return statistics_of(distance_m);
  for (const int v : *vertices)
    if (v < 0 || v >= distance_m.size())
      throw py::index_error(fmt::format("vertex {} of {}", v, distance_m.size()));
  return statistics_of(distance_m, *vertices);
}

VariantDifference difference(const RunResult& a, const RunResult& b,
                             std::optional<int> peak_frame) {
  return variant_difference(a.performance().skin_displacement_m,
                            b.performance().skin_displacement_m,
                            peak_frame.value_or(a.performance().peak_frame));
}

Asymmetry asymmetry(const RunResult& run, const io::Landmarks& landmarks) {
  session::Inputs inputs;
  inputs.landmarks = landmarks;
  return asymmetry_of(session::rest_asymmetry(*run.mesh, inputs),
                      run.performance().skin_displacement_m);
}

Eigen::VectorXf asymmetry_map(const RunResult& run, const Asymmetry& of, int frame) {
  const auto& frames = run.performance().skin_displacement_m;
  if (frame < 0 || frame >= int(frames.size()))
    throw py::index_error(fmt::format("frame {} of {}", frame, frames.size()));
  const auto& d = frames[static_cast<std::size_t>(frame)];
  if (d.rows() != Eigen::Index(of.pairs.vertices.size()))
    throw InputError(InputProblem{{},
                                  0,
                                  "asymmetry",
                                  fmt::format("{} vertices", of.pairs.vertices.size()),
                                  fmt::format("that of a face of {}", d.rows())});
  return asymmetry_mm(of.plane, of.pairs, d);
}

template <double AsymmetrySummary::*Member>
py::array of_frames(const Asymmetry& self) {
  py::array_t<double> values(py::ssize_t(self.frames.size()));
  for (std::size_t f = 0; f < self.frames.size(); ++f)
    values.mutable_at(f) = self.frames[f].*Member;
  return values;
}

void bind_distances(py::module_& m) {
  py::class_<DistanceStatistics>(m, "DistanceStatistics", "Of distances, mm.")
      .def_readonly("mean_mm", &DistanceStatistics::mean_mm)
      .def_readonly("median_mm", &DistanceStatistics::median_mm)
      .def_readonly("rms_mm", &DistanceStatistics::rms_mm)
      .def_readonly("p95_mm", &DistanceStatistics::p95_mm)
      .def_readonly("max_mm", &DistanceStatistics::max_mm)
      .def_readonly("count", &DistanceStatistics::count)
      .def("__repr__", [](const DistanceStatistics& s) {
        return fmt::format(
            "<hyperex.DistanceStatistics: mean {:.3f} mm, median {:.3f}, rms {:.3f}, p95 {:.3f}, "
            "max {:.3f}, {} points>",
            s.mean_mm, s.median_mm, s.rms_mm, s.p95_mm, s.max_mm, s.count);
      });
  m.def("distance_to_surface", &distance_to_surface, "points_m"_a, "surface"_a, Unlocked(),
        "From each point (|V| x 3, metres) to the closest point of a TriMesh: |V|, metres.");
  m.def("statistics_of", &statistics, "distance_m"_a, "vertices"_a = py::none(),
        "Of all distances (metres), or of those of the listed vertices.");
  m.def("regions_of", &regions, "rest_m"_a, "landmarks"_a,
        "Parts of the face on a scan at rest: name -> rows of rest_m.");
}

}  // namespace

void bind_compare(py::module_& m) {
  bind_distances(m);
  const auto column = [](const auto member) {
    return [member](const py::object& self) {
      return view(self.cast<VariantDifference&>().*member, self);
    };
  };
  py::class_<VariantDifference>(m, "VariantDifference", "How far apart two runs are, a vertex.")
      .def_property_readonly("greatest_m", column(&VariantDifference::greatest_m), "Of any frame.")
      .def_property_readonly("at_peak_m", column(&VariantDifference::at_peak_m))
      .def_property_readonly("rms_m", column(&VariantDifference::rms_m), "Over all frames.")
      .def_property_readonly("change_at_peak_m", column(&VariantDifference::change_at_peak_m),
                             "|u_b| - |u_a|: below 0 where b moves less.")
      .def_property_readonly("frame_rms_m", column(&VariantDifference::frame_rms_m),
                             "Over the vertices, a frame.")
      .def_property_readonly("frame_max_m", column(&VariantDifference::frame_max_m));
  m.def("variant_difference", &difference, "a"_a, "b"_a, "peak_frame"_a = py::none(), Unlocked(),
        "Of two Performances of one skin at the same times.");
  py::class_<Asymmetry>(m, "Asymmetry", "A moving face against its own reflection.")
      .def_property_readonly(
          "plane_normal", [](const Asymmetry& self) { return self.plane.normal; },
          "Of the midsagittal plane, towards the subject's left.")
      .def_property_readonly("plane_offset_m",
                             [](const Asymmetry& self) { return self.plane.offset_m; })
      .def_readonly("rest_rms_mm", &Asymmetry::rest_rms_mm, "Of the face at rest.")
      .def_property_readonly("face_rms_mm", &of_frames<&AsymmetrySummary::face_rms_mm>,
                             "Over the face, a frame.")
      .def_property_readonly("mouth_rms_mm", &of_frames<&AsymmetrySummary::mouth_rms_mm>)
      .def_readonly("worst_frame", &Asymmetry::worst_frame);
  m.def("asymmetry_of", &asymmetry, "performance"_a, "landmarks"_a, Unlocked(),
        "Of all frames. `landmarks`: those of the face at rest (metres).");
  m.def("asymmetry_map_mm", &asymmetry_map, "performance"_a, "asymmetry"_a, "frame"_a, Unlocked(),
        "Of each vertex in one frame, mm; NaN without a counterpart.");
}

}  // namespace hyperex::python
