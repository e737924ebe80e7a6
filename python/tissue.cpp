// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of the soft tissue, and what the tissue is made of.
#include <algorithm>
#include <cmath>
#include <utility>

#include "arrays.hpp"
#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "meshes.hpp"
#include "options_class.hpp"
#include "refuse.hpp"
#include "warn_user.hpp"

namespace hyperex::python {
namespace {

using simulate::TissueValues;
using tissue::TissueMeshOptions;

SharedTissueMesh of_face(const Face& face, const TissueMeshOptions& options) {
  return std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.scan.mesh, face.landmarks, options, face.scan.file.string(),
                                session::on_seams(face.scan)));
}

SharedTissueMesh of_surface(const TriMesh& mesh, const io::Landmarks& landmarks,
                            const TissueMeshOptions& options, const std::string& source) {
  return std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(mesh, landmarks, options, source));
}

void bind_mesh(py::module_& m) {
  using tissue::TissueMesh;
  py::class_<TissueMesh, SharedTissueMesh>(
      m, "TissueMesh", "A scan made ready for simulation: a layer of tetrahedra under its skin.")
      .def_readonly("skin", &TissueMesh::skin,
                    "The scan, and vertices appended where its lips were cut; metres.")
      .def_readonly("scan_vertices", &TissueMesh::scan_vertices,
                    "The first so many points of the skin are the scan's own.")
      .def_property_readonly(
          "nodes_m",
          [](const py::object& self) { return view(self.cast<TissueMesh&>().volume.nodes, self); },
          "|N| x 3, metres; those of the skin come first.")
      .def_property_readonly(
          "tets",
          [](const py::object& self) { return view(self.cast<TissueMesh&>().volume.tets, self); },
          "|T| x 4 rows of nodes_m.")
      .def_property_readonly(
          "thickness_m",
          [](const py::object& self) {
            return view(self.cast<TissueMesh&>().volume.thickness_m, self);
          },
          "Of the tissue under each node of the skin, as built.")
      .def_readonly("mean_distance_mm", &TissueMesh::mean_distance_mm,
                    "From the scan's vertices to the simulated skin.")
      .def_readonly("max_distance_mm", &TissueMesh::max_distance_mm)
      .def_property_readonly(
          "notes", [](const TissueMesh& mesh) { return texts_of(mesh.notes); },
          "What was mended, trimmed or cut.")
      .def("__repr__", [](const TissueMesh& mesh) {
        return fmt::format("<hyperex.TissueMesh of {} nodes, {} tetrahedra>",
                           mesh.volume.nodes.rows(), mesh.volume.tets.rows());
      });
  m.def("build_tissue_mesh", &of_face, "face"_a,
        py::arg_v("options", TissueMeshOptions{}, "TissueMeshOptions()"), Unlocked(),
        "Cuts joined lips, mends small holes and builds the layer of tetrahedra; takes a second or "
        "two.");
  m.def("build_tissue_mesh", &of_surface, "mesh"_a, "landmarks"_a,
        py::arg_v("options", TissueMeshOptions{}, "TissueMeshOptions()"), "source"_a = "mesh",
        Unlocked(), "The same from a surface and its landmarks (completed: complete_landmarks).");
}

/// Refuses values out of the bounds that scenes have, as soon as they are given.
void refuse_out_of_bounds(tissue::Parameter p, const std::vector<double>& values, const char* one) {
  const tissue::ParameterInfo& info = tissue::parameter_info(p);
  for (const double value : values)
    if (!tissue::is_allowed(p, value))
      refuse("tissue." + info.name, fmt::format("{:g}", value),
             fmt::format("{} {}", one, info.allowed_si));
}

/// Below a kilopascal everywhere is more often a value in kilopascals than tissue that soft.
void warn_of_kilopascals(tissue::Parameter p, const std::vector<double>& values) {
  constexpr double soft_pa = 1000;
  if (p != tissue::young || values.empty()) return;
  const double stiffest_pa = *std::ranges::max_element(values);
  if (stiffest_pa >= soft_pa) return;
  warn_user({{"", Severity::warning,
              fmt::format("tissue.young_pa = {0:g} Pa: expected pascals; {0:g} kPa are {1:g} Pa",
                          stiffest_pa, 1e3 * stiffest_pa),
              ""}});
}

/// A number for all the tissue, or one for each tetrahedron.
void value_field(OptionsClass<TissueValues>& tissue, const char* name, tissue::Parameter p,
                 const char* doc) {
  tissue.custom(
      name,
      [p](const TissueValues& self) -> py::object {
        if (self.element[p].empty()) return py::float_(self.uniform[p]);
        return py::array_t<double>(py::ssize_t(self.element[p].size()), self.element[p].data());
      },
      [p](TissueValues& self, py::handle value) {
        const auto array =
            value.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
        std::vector<double> given(array.data(), array.data() + array.size());
        const bool uniform = array.ndim() == 0;
        refuse_out_of_bounds(p, given, uniform ? "a number" : "numbers");
        warn_of_kilopascals(p, given);
        if (uniform) {
          self.uniform[p] = given.front();
          given.clear();
        }
        self.element[p] = std::move(given);
      },
      "float | NDArray[np.float64]", doc);
}

}  // namespace

void bind_tissue(py::module_& m) {
  OptionsClass<tissue::DepthAt>(m, "DepthAt");
  OptionsClass<tissue::DepthRegion>(m, "DepthRegion");
  OptionsClass<TissueMeshOptions>(m, "TissueMeshOptions");
  bind_mesh(m);
  OptionsClass<TissueValues> tissue(
      m, "Tissue", "What the tissue is made of: each a number, or an array of one a tetrahedron.");
  value_field(tissue, "young_pa", tissue::young, "Young's modulus, Pa.");
  value_field(tissue, "viscosity_pa_s", tissue::viscosity, "Pa s.");
  value_field(tissue, "poisson", tissue::poisson, "Poisson's ratio.");
  value_field(tissue, "density_kg_m3", tissue::density, "kg / m^3.");
  tissue.custom(
      "volume_ratio",
      [](const TissueValues& self) -> py::object {
        if (self.volume_ratio.empty()) return py::none();
        return py::array_t<double>(py::ssize_t(self.volume_ratio.size()), self.volume_ratio.data());
      },
      [](TissueValues& self, py::handle value) {
        if (value.is_none()) return self.volume_ratio.clear();
        const auto array =
            value.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
        const std::vector<double> given(array.data(), array.data() + array.size());
        for (const double ratio : given)
          if (!(ratio > 0) || !std::isfinite(ratio))
            refuse("tissue.volume_ratio", fmt::format("{:g}", ratio), "positive numbers");
        self.volume_ratio = given;
      },
      "NDArray[np.float64] | None",
      "Volume at rest over that of the mesh, one per tetrahedron, as of filler; None: 1.");
}

}  // namespace hyperex::python
