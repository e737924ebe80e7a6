// SPDX-License-Identifier: GPL-3.0-or-later
// Scans, landmarks and faces.
#include "meshes.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/session/embedded_scan.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::python {

std::optional<io::LengthUnit> unit_from(const std::optional<std::string>& word) {
  if (!word) return std::nullopt;
  const auto unit = io::length_unit(*word);
  if (!unit) throw InputError(InputProblem{{}, 0, "unit", *word, "mm, cm or m"});
  return unit;
}

namespace {

using Path = std::filesystem::path;

TriMesh make_mesh(Points points, Triangles triangles) {
  if (!points.allFinite())
    throw InputError(InputProblem{{}, 0, "points_m", "NaN or infinity", "finite numbers (m)"});
  if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= points.rows()))
    throw InputError(InputProblem{
        {},
        0,
        "triangles",
        std::to_string(triangles.minCoeff()) + " to " + std::to_string(triangles.maxCoeff()),
        "rows of points_m, counted from 0"});
  return {std::move(points), std::move(triangles)};
}

io::Landmarks found_on(const io::Scan& scan) {
  return tracking::find_scan_landmarks(scan.mesh, tracking::picture_colours(scan),
                                       scan.file.string())
      .landmarks;
}

Face embedded_face() {
  Face face;
  face.scan = session::embedded_scan();
  face.landmarks = anatomy::embedded_face().landmarks;
  return face;
}

Face completed_face(io::Scan scan, const io::Landmarks& given, const std::string& source) {
  auto completed = anatomy::complete_landmarks(given, scan.mesh, source);
  return {std::move(scan), std::move(completed.landmarks), std::move(completed.placed)};
}

Face read_face(const Path& file, const std::optional<Path>& landmarks,
               const std::optional<std::string>& unit) {
  io::Scan scan = io::read_scan(file, unit_from(unit));
  const io::Landmarks given = landmarks ? io::read_landmarks(*landmarks) : found_on(scan);
  return completed_face(std::move(scan), given, (landmarks ? *landmarks : file).string());
}

void bind_scan(py::module_& m) {
  py::class_<TriMesh>(m, "TriMesh", "A triangle mesh.")
      .def(py::init(&make_mesh), "points_m"_a, "triangles"_a,
           "From |V| x 3 positions in metres and |F| x 3 rows of them, counter-clockwise seen from "
           "outside.")
      .def_property_readonly(
          "points_m",
          [](const py::object& self) { return view(self.cast<TriMesh&>().points, self); },
          "|V| x 3, metres, read-only.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) { return view(self.cast<TriMesh&>().triangles, self); },
          "|F| x 3 rows of points_m, counter-clockwise seen from outside; read-only.")
      .def("__repr__", [](const TriMesh& mesh) {
        return "<hyperex.TriMesh of " + std::to_string(mesh.points.rows()) + " points and " +
               std::to_string(mesh.triangles.rows()) + " triangles>";
      });
  py::class_<io::Scan>(m, "Scan", "A face scan as read: the file's own vertices in their order.")
      .def_readonly("file", &io::Scan::file, "What to name in messages.")
      .def_readonly("mesh", &io::Scan::mesh, "Metres.")
      .def_property_readonly(
          "unit", [](const io::Scan& scan) { return io::name_of(scan.unit); },
          "Length unit of the file: mm, cm or m.")
      .def_readonly("unit_guessed", &io::Scan::unit_guessed, "By the size of the face.")
      .def_property_readonly(
          "vertex_colours",
          [](const py::object& self) { return view(self.cast<io::Scan&>().vertex_colour, self); },
          "|V| x 4 RGBA, uint8; no rows where the scan has none.")
      .def("__repr__", [](const io::Scan& scan) {
        return "<hyperex.Scan " + scan.file.string() + ", " +
               std::to_string(scan.mesh.points.rows()) + " points>";
      });
  m.def(
      "read_scan",
      [](const Path& file, const std::optional<std::string>& unit) {
        return io::read_scan(file, unit_from(unit));
      },
      "file"_a, "unit"_a = py::none(), Unlocked(),
      "Reads PLY, OBJ, STL or glTF. The unit (mm, cm or m) is guessed from the size where it is "
      "not given.");
}

void bind_landmarks(py::module_& m) {
  m.def(
      "read_landmarks",
      [](const Path& file, const std::optional<std::string>& unit) {
        return io::read_landmarks(file, unit_from(unit));
      },
      "file"_a, "unit"_a = py::none(), Unlocked(),
      "Name -> position (3, metres) from a JSON file of Hyperex or 3D Slicer.");
  m.def(
      "write_landmarks",
      [](const Path& file, const io::Landmarks& landmarks, const std::string& unit) {
        io::write_landmarks(file, landmarks, *unit_from(unit));
      },
      "file"_a, "landmarks"_a, "unit"_a = "mm", Unlocked(),
      "Writes landmarks (metres) as JSON in `unit`; NAME.mrk.json for 3D Slicer.");
  m.def("find_landmarks", &found_on, "scan"_a, Unlocked(),
        "Finds the landmarks of a scan that may be turned in any way; takes seconds. Name -> "
        "position (3, metres).");
  m.def(
      "complete_landmarks",
      [](const io::Landmarks& given, const TriMesh& mesh, const std::string& source) {
        return anatomy::complete_landmarks(given, mesh, source).landmarks;
      },
      "landmarks"_a, "mesh"_a, "source"_a = "landmarks", Unlocked(),
      "The given landmarks, and all others that a simulation needs, placed by fitting a face to "
      "them and the scan.");
  m.def(
      "landmark_doubts",
      [](const io::Landmarks& given, const TriMesh& mesh) {
        return texts_of(anatomy::landmark_doubts(given, mesh));
      },
      "landmarks"_a, "mesh"_a, Unlocked(),
      "Landmarks that are probably not where their names say: a sentence each.");
}

}  // namespace

void bind_meshes(py::module_& m) {
  bind_scan(m);
  bind_landmarks(m);
  py::class_<Face>(m, "Face", "A scan and all landmarks of it.")
      .def(py::init([](const io::Scan& scan, const io::Landmarks& landmarks) {
             return completed_face(scan, landmarks, scan.file.string());
           }),
           "scan"_a, "landmarks"_a, Unlocked(),
           "Landmarks (name -> position in metres) that are missing are placed.")
      .def_readonly("scan", &Face::scan)
      .def_property_readonly(
          "mesh", [](const Face& face) -> const TriMesh& { return face.scan.mesh; },
          "The scan's surface, metres.")
      .def_readonly("landmarks", &Face::landmarks, "A dict: name -> position (3, metres).")
      .def_readonly("placed", &Face::placed, "Names of landmarks that were not given.")
      .def("__repr__", [](const Face& face) {
        return "<hyperex.Face " + face.scan.file.string() + ", " +
               std::to_string(face.scan.mesh.points.rows()) + " points, " +
               std::to_string(face.landmarks.size()) + " landmarks>";
      });
  m.def("embedded_face", &embedded_face, Unlocked(), "The face that comes with Hyperex.");
  m.def("read_face", &read_face, "file"_a, "landmarks"_a = py::none(), "unit"_a = py::none(),
        Unlocked(),
        "Reads a scan and a file of its landmarks. Without a file they are found on the scan, "
        "which takes seconds; those missing in it are placed.");
}

}  // namespace hyperex::python
