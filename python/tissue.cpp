// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of the soft tissue, and what the tissue is made of.
#include "arrays.hpp"
#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "meshes.hpp"
#include "options_class.hpp"

namespace hyperex::python {
namespace {

using simulate::TissueValues;
using tissue::TissueMeshOptions;

void check(const TissueMeshOptions& o) {
  std::vector<InputProblem> problems;
  const auto in = [&](const char* name, double value, const Bounds& bounds, bool or_zero = false) {
    if (bounds.holds(value) || (or_zero && value == 0)) return;
    problems.push_back({{},
                        0,
                        name,
                        fmt::format("{:g}", value),
                        fmt::format("a number from {:g} to {:g}{}", bounds.least, bounds.most,
                                    or_zero ? ", or 0" : "")});
  };
  in("element_size_m", o.element_size_m, o.element_size_m_in);
  in("layers", o.layers, o.layers_in);
  in("thickness_m", o.thickness_m, o.thickness_m_in, true);
  in("trim_border_m", o.trim_border_m, o.trim_border_m_in);
  for (const tissue::DepthRegion& region : o.depth_regions)
    in("depth_regions.depth_m", region.depth_m, o.thickness_m_in);
  if (!problems.empty()) throw InputError(problems);
}

SharedTissueMesh of_face(const Face& face, const TissueMeshOptions& options) {
  check(options);
  return std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.scan.mesh, face.landmarks, options, face.scan.file.string(),
                                session::on_seams(face.scan)));
}

SharedTissueMesh of_surface(const TriMesh& mesh, const io::Landmarks& landmarks,
                            const TissueMeshOptions& options, const std::string& source) {
  check(options);
  return std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(mesh, landmarks, options, source));
}

void bind_mesh_options(py::module_& m) {
  using tissue::DepthRegion;
  using tissue::LipCut;
  OptionsClass<DepthRegion>(m, "DepthRegion", "Thickness in a painted part of the skin.")
      .field("painted", &DepthRegion::painted,
             "A file of weights from 0 to 1, a row a vertex of the scan, or the scan painted red.")
      .field("depth_m", &DepthRegion::depth_m, "Where the weight is 1: 0.001 to 0.04 m.");
  OptionsClass<TissueMeshOptions>(m, "TissueMeshOptions", "How the soft tissue is meshed.")
      .field("element_size_m", &TissueMeshOptions::element_size_m,
             "Edges at the mouth, 0.0005 to 0.03 m; they grow away from it.")
      .field("layers", &TissueMeshOptions::layers, "Of elements under the skin, 1 to 8.")
      .field("thickness_m", &TissueMeshOptions::thickness_m,
             "Of the tissue, 0.001 to 0.04 m; 0: published depths, interpolated.")
      .field("depth_per_vertex", &TissueMeshOptions::depth_per_vertex,
             "A file of thickness_mm, a row a vertex of the scan, where it gives any; empty: none.")
      .list("depth_regions", &TissueMeshOptions::depth_regions, "DepthRegions, applied in turn.")
      .word("cut_lips", &TissueMeshOptions::cut_lips,
            {{"auto", LipCut::automatic}, {"always", LipCut::always}, {"never", LipCut::never}},
            "auto, always or never.")
      .field("trim_border_m", &TissueMeshOptions::trim_border_m,
             "Taken off the scan's outer border, 0 to 0.05 m.");
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
      .def_readonly("notes", &TissueMesh::notes, "What was mended, trimmed or cut.")
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
        if (py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)) {
          self.uniform[p] = value.cast<double>();
          self.element[p].clear();
          return;
        }
        const auto array =
            value.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
        if (array.ndim() == 0)
          self.uniform[p] = *array.data(), self.element[p].clear();
        else
          self.element[p].assign(array.data(), array.data() + array.size());
      },
      doc);
}

}  // namespace

void bind_tissue(py::module_& m) {
  bind_mesh_options(m);
  bind_mesh(m);
  OptionsClass<TissueValues> tissue(
      m, "Tissue", "What the tissue is made of: each a number, or an array of one a tetrahedron.");
  value_field(tissue, "young_pa", tissue::young, "Young's modulus, Pa.");
  value_field(tissue, "viscosity_pa_s", tissue::viscosity, "Pa s.");
  value_field(tissue, "poisson", tissue::poisson, "Poisson's ratio.");
  value_field(tissue, "density_kg_m3", tissue::density, "kg / m^3.");
}

}  // namespace hyperex::python
