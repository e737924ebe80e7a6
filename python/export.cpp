// SPDX-License-Identifier: GPL-3.0-or-later
// Files for other programs: glTF, PLY, frames for ParaView.
#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/report/glb.hpp"
#include "hyperex/run/frames.hpp"
#include "hyperex/session/thinned_scan.hpp"
#include "options_class.hpp"
#include "performance.hpp"
#include "refuse.hpp"

namespace hyperex::python {
namespace {

using Path = std::filesystem::path;

report::GlbReport glb(const Path& file, const RunResult& run, const io::Scan& scan,
                      double tolerance_m, double max_mb) {
  if (!(tolerance_m > 0)) refuse("tolerance_m", fmt::format("{:g}", tolerance_m), "above 0 (m)");
  const report::GlbOptions options{tolerance_m, 1e6 * max_mb};
  if (const auto& full = run.mesh->full; full && scan.mesh.points.rows() == full->scan_vertices)
    return report::write_glb(file, run.performance(),
                             session::thinned_scan(scan, *full, run.mesh->skin), options);
  if (scan.mesh.points.rows() != run.performance().scan_vertices)
    refuse("scan", fmt::format("{} points", scan.mesh.points.rows()),
           fmt::format("the scan that was simulated, of {}", run.performance().scan_vertices));
  return report::write_glb(file, run.performance(), scan, options);
}

void ply(const Path& file, const TriMesh& mesh, const std::string& unit,
         const std::map<std::string, Eigen::VectorXf>& scalars) {
  std::vector<io::VertexScalar> list;
  for (const auto& [name, values] : scalars) {
    if (values.size() != mesh.points.rows())
      refuse(name, fmt::format("{} values", values.size()),
             fmt::format("one for each of the {} points", mesh.points.rows()));
    if (name.empty() || name.find_first_of(" \t\n") != std::string::npos)
      refuse("scalars", name, "names without blanks");
    list.push_back({name, values});
  }
  io::write_ply(file, mesh, *unit_from(unit), list);
}

void frames(const Path& folder, const RunResult& run, int every, bool strain) {
  if (every < 1) refuse("every", std::to_string(every), "a number from 1");
  run::write_frames(run.performance(), folder, every, strain);
}

}  // namespace

void bind_export(py::module_& m) {
  py::class_<report::GlbReport>(m, "GlbReport", "What write_glb wrote.")
      .def_readonly("keys", &report::GlbReport::keys, "Shape keys.")
      .def_readonly("max_error_m", &report::GlbReport::max_error_m, "Of any vertex in any frame.")
      .def_readonly("bytes", &report::GlbReport::bytes, "Of the file.");
  m.def(
      "write_glb", &glb, "file"_a, "performance"_a, "scan"_a, "tolerance_m"_a = 1e-4,
      "max_mb"_a = 20.0, Unlocked(),
      "The moving skin as binary glTF for Blender and the web, with the scan's colours. That of a "
      "FaceResult has its teeth too.");
  m.def("write_ply", &ply, "file"_a, "mesh"_a, "unit"_a = "mm",
        "scalars"_a = std::map<std::string, Eigen::VectorXf>{}, Unlocked(),
        "A TriMesh in `unit`, and values a vertex: {name: |V| numbers}.");
  m.def("write_frames", &frames, "folder"_a, "performance"_a, "every"_a = 1, "strain"_a = true,
        Unlocked(),
        "frames.pvd and frames/frame_NNNN.vtu for ParaView: the tissue with displacement, strain "
        "and stress; files of these names are replaced.");
}

}  // namespace hyperex::python
