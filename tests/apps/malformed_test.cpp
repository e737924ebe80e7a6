// SPDX-License-Identifier: GPL-3.0-or-later
// Faulty scans, landmarks and recordings of many kinds.
#include "apps/malformed.hpp"

#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;

class MalformedFile : public Malformed {};
TEST_P(MalformedFile, IsRefusedInOneLine) {
  expect_refused(GetParam());
}

const char* const kMarks = "face_landmarks.json";

// ---- scans ------------------------------------------------------------------------------------

void write_face(const In& in, const std::function<void(TriMesh&)>& change) {
  TriMesh mesh = good_face();
  change(mesh);
  write_mm(in("face.ply"), mesh);
}

/// Two faces side by side, as where two people were scanned at once.
void write_two_faces(const In& in) {
  write_face(in, [](TriMesh& mesh) {
    const Eigen::Index n = mesh.points.rows(), m = mesh.triangles.rows();
    Points points(2 * n, 3);
    points << mesh.points, mesh.points;
    points.bottomRows(n).col(0).array() += 0.17;
    Triangles triangles(2 * m, 3);
    triangles << mesh.triangles, mesh.triangles.array() + int(n);
    mesh = {points, triangles};
  });
}

/// The lips are joined, and the scan has a slit from nose to chin, which a lip cut cannot cross.
void write_split_closed_mouth(const In& in) {
  const TriMesh& closed = anatomy::canonical_face().mesh;
  TriMesh mesh{closed.points, Triangles(closed.triangles.rows(), 3)};
  Eigen::Index kept = 0;
  const double nose = good_landmarks().at("ibug68_33")[1];
  for (Eigen::Index f = 0; f < closed.triangles.rows(); ++f) {
    const Vec3 middle =
        (closed.points.row(closed.triangles(f, 0)) + closed.points.row(closed.triangles(f, 1)) +
         closed.points.row(closed.triangles(f, 2))) /
        3;
    if (std::abs(middle[0]) > 0.006 || middle[1] > nose)
      mesh.triangles.row(kept++) = closed.triangles.row(f);
  }
  mesh.triangles.conservativeResize(kept, 3);
  write_mm(in("face.ply"), mesh);
}

void use_glb(const In& in, double share) {
  // A glTF binary of one triangle: a header, JSON, and 48 bytes of numbers.
  std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto number = [](std::uint32_t n) {
    return std::string(reinterpret_cast<const char*>(&n), 4);
  };
  const float corner[9] = {0, 0, 0, 0.2F, 0, 0, 0, 0.2F, 0};
  std::string bytes = "glTF" + number(2) + number(std::uint32_t(12 + 8 + json.size() + 8 + 36)) +
                      number(std::uint32_t(json.size())) + "JSON" + json + number(36) + "BIN" +
                      std::string(1, '\0') +
                      std::string(reinterpret_cast<const char*>(corner), sizeof corner);
  put(in("face.glb"), bytes);
  tear(in("face.glb"), share);
  replace_in(in("scene.toml"), "face.ply\"\nunit = \"mm\"", "face.glb\"");
}

void use_ascii(const In& in) {
  write_ascii_ply_mm(in("face.ply"), good_face());
}

const std::vector<Fault> kScans{
    {"TornBinaryPly", [](const In& in) { tear(in("face.ply"), 0.5); }, {"face.ply", "torn"}},
    {"TornAsciiPly",
     [](const In& in) {
       use_ascii(in);
       tear(in("face.ply"), 0.9);
     },
     {"face.ply", "torn", "face"}},
    {"TornPlyHeader",
     [](const In& in) { put(in("face.ply"), "ply\nformat ascii 1.0\nelem"); },
     {"face.ply"}},
    {"TornGlb", [](const In& in) { use_glb(in, 0.8); }, {"face.glb", "torn", "bytes"}},
    {"GlbOfOneTriangle", [](const In& in) { use_glb(in, 1); }, {kMarks, "of 92", "expected"}},
    {"EmptyFile", [](const In& in) { put(in("face.ply"), ""); }, {"face.ply", "empty"}},
    {"NotAPly", [](const In& in) { put(in("face.ply"), "dear reader\n"); }, {"face.ply", "ply"}},
    {"UnknownFormat",
     [](const In& in) {
       fs::rename(in("face.ply"), in("face.fbx"));
       replace_in(in("scene.toml"), "face.ply", "face.fbx");
     },
     {"face.fbx", ".fbx", "expected", ".ply"}},
    {"NanVertex",
     [](const In& in) { write_face(in, [](TriMesh& m) { m.points(17, 1) = std::nan(""); }); },
     {"face.ply", "vertex 17", "nan", "finite"}},
    {"IndexOutOfRange",
     [](const In& in) {
       use_ascii(in);
       replace_in(in("face.ply"), "\n3 ", "\n3 70000 1 2\n3 ");
     },
     {"face.ply", "face 0", "70000", "expected 0 to"}},
    {"PointCloud",
     [](const In& in) { write_face(in, [](TriMesh& m) { m.triangles.resize(0, 3); }); },
     {"face.ply", "no faces", "point cloud"}},
    {"InsideOut",
     [](const In& in) {
       write_face(in, [](TriMesh& m) { m.triangles.col(0).swap(m.triangles.col(1)); });
     },
     {kMarks, "inside out"}},
    {"MetresSaidToBeMillimetres",
     [](const In& in) { io::write_ply(in("face.ply"), good_face(), io::LengthUnit::metre); },
     {"face.ply", "mm", "expected"}},
    {"NoUnitFits",
     [](const In& in) {
       write_face(in, [](TriMesh& m) { m.points *= 200; });
       replace_in(in("scene.toml"), "unit = \"mm\"\n", "");
     },
     {"face.ply", "unit"}},
    {"TwoFaces", write_two_faces, {"face.ply"}},
    {"ClosedMouthThatCannotBeCut", write_split_closed_mouth, {"face.ply", "lips"}},
    {"MeshOfATornScan",
     [](const In& in) { tear(in("face.ply"), 0.3); },
     {"face.ply", "torn"},
     "mesh face.ply --out out.vtu"},
    {"MeshWithoutLandmarksOrAFace",
     [](const In& in) {
       fs::remove(in("face_landmarks.json"));
       write_face(in, [](TriMesh& m) { m.points.col(2) *= 0.02; });
     },
     {"face.ply", "no face was found"},
     "mesh face.ply --unit mm --out out.vtu"},
    {"MeshIntoNoFolder",
     [](const In&) {},
     {"none/out.vtu", "cannot be written"},
     "mesh face.ply --unit mm --out none/out.vtu --element-size-mm 12 --layers 1"},
    {"CompareByIndexWithAnStl",
     [](const In& in) {
       put(in("b.stl"),
           "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 200 0 0\n"
           "vertex 0 200 0\nendloop\nendfacet\nendsolid s\n");
     },
     {"b.stl", "STL", "number", "--corresponding"},
     "compare face.ply b.stl --corresponding"},
    {"CompareInUnitsMixedUp",
     [](const In& in) { io::write_ply(in("b.ply"), good_face(), io::LengthUnit::metre); },
     {"b.ply", "across", "same unit"},
     "compare face.ply b.ply --unit mm"},
    {"CompareWithATornScan",
     [](const In& in) {
       write_mm(in("b.ply"), good_face());
       tear(in("b.ply"), 0.7);
     },
     {"b.ply", "torn"},
     "compare face.ply b.ply --unit mm"},
};

// ---- landmarks ---------------------------------------------------------------------------------

void write_marks(const In& in, const std::function<void(io::Landmarks&)>& change) {
  io::Landmarks marks = good_landmarks();
  change(marks);
  io::write_landmarks(in("face_landmarks.json"), marks, io::LengthUnit::millimetre);
}

const std::vector<Fault> kLandmarks{
    {"MetresSaidToBeMillimetres",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) {
         for (auto& [name, p] : l) p *= 1e-3;
       });
     },
     {kMarks, "92 of 92", "span 0.2", "unit"}},
    {"OneTenCentimetresOff",
     [](const In& in) { write_marks(in, [](io::Landmarks& l) { l["cheilion_L"][0] += 0.1; }); },
     {kMarks, "cheilion_L", "mm"}},
    {"LeftAndRightExchanged",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) {
         const io::Landmarks old = l;
         for (auto& [name, p] : l) p = old.at(anatomy::mirrored_landmark(name));
       });
     },
     {kMarks, "left", "right"}},
    {"OnePairExchanged",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) { std::swap(l["alare_L"], l["alare_R"]); });
     },
     {kMarks, "alare"}},
    {"UpsideDownNearTheSkin",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) {
         for (auto& [name, p] : l) p.head<2>() *= -1;
       });
     },
     {kMarks, "x and y negated", "RAS", "LPS"}},
    {"AllNamesMisspelt",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) {
         l = {{"mouth", l["stomion"]}, {"nose", l["pronasale"]}, {"eye", l["exocanthion_L"]}};
       });
     },
     {kMarks, "three", "not known: eye, mouth, nose"}},
    {"TooFew",
     [](const In& in) {
       write_marks(in, [](io::Landmarks& l) {
         l = {{"pronasale", l["pronasale"]}, {"cheilion_L", l["cheilion_L"]}};
       });
     },
     {kMarks, "three"}},
    {"TornJson", [](const In& in) { tear(in(kMarks), 0.6); }, {kMarks}},
    {"WithoutUnits",
     [](const In& in) { replace_in(in(kMarks), "\"units\"", "\"unity\""); },
     {kMarks, "units", "expected"}},
    {"UnknownUnits",
     [](const In& in) { replace_in(in(kMarks), "\"mm\"", "\"inch\""); },
     {kMarks, "units", "inch", "expected"}},
    {"OneTwice",
     [](const In& in) { replace_in(in(kMarks), "\"alare_R\"", "\"alare_L\""); },
     {kMarks, "alare_L", "twice"}},
    {"TwoNumbersOnly",
     [](const In& in) { put(in(kMarks), R"({"units": "mm", "points": {"pronasale": [1, 2]}})"); },
     {kMarks, "pronasale", "three"}},
    {"NoPoints",
     [](const In& in) { put(in(kMarks), R"({"units": "mm", "points": {}})"); },
     {kMarks, "point"}},
    {"CsvInTheirPlace",
     [](const In& in) {
       fs::copy_file(in("motion.csv"), in(kMarks), fs::copy_options::overwrite_existing);
     },
     {kMarks, "JSON"}},
};

// ---- motion ------------------------------------------------------------------------------------

/// Writes the recording with its rows, one per line, changed.
void write_rows(const In& in, const std::function<void(std::vector<std::string>&)>& change) {
  std::istringstream lines(read_file(in("motion.csv")));
  std::vector<std::string> rows;
  for (std::string row; std::getline(lines, row);) rows.push_back(row);
  change(rows);
  std::string text;
  for (const auto& row : rows) text += row + '\n';
  put(in("motion.csv"), text);
}

/// Applies `change(line, column name, cell)` to every cell.
void write_cells(const In& in,
                 const std::function<void(std::size_t, const std::string&, std::string&)>& change) {
  write_rows(in, [&](std::vector<std::string>& rows) {
    std::vector<std::string> names;
    std::istringstream header(rows[0]);
    for (std::string name; std::getline(header, name, ',');) names.push_back(name);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::istringstream cells(rows[r]);
      std::string row, cell;
      for (std::size_t c = 0; std::getline(cells, cell, ','); ++c) {
        change(r, names[c], cell);
        row += (c ? "," : "") + cell;
      }
      rows[r] = row;
    }
  });
}

void rename_columns(const In& in, const std::string& from, const std::string& to) {
  write_cells(in, [&](std::size_t row, const std::string&, std::string& cell) {
    if (row == 0 && cell.rfind(from, 0) == 0) cell.replace(0, from.size(), to);
  });
}

const std::vector<Fault> kMotions{
    {"Empty", [](const In& in) { put(in("motion.csv"), ""); }, {"motion.csv", "empty"}},
    {"OfOpenFace",
     [](const In& in) { put(in("motion.csv"), "frame,timestamp,AU12_r,AU26_r\n1,0,0,0\n"); },
     {"motion.csv", "OpenFace", "motion.openface"}},
    {"OfArKit",
     [](const In& in) { put(in("motion.csv"), "time_s,jawOpen,mouthSmileLeft\n0,0,0\n"); },
     {"motion.csv", "ARKit", "motion.arkit"}},
    {"HeaderAlone",
     [](const In& in) { write_rows(in, [](auto& rows) { rows.resize(1); }); },
     {"motion.csv", "sample"}},
    {"TimeGoesBack",
     [](const In& in) { write_rows(in, [](auto& rows) { std::swap(rows[4], rows[5]); }); },
     {"motion.csv:6", "time_s", "0.1"}},
    {"LongGap",
     [](const In& in) {
       write_cells(in, [](std::size_t row, const std::string& column, std::string& cell) {
         if (row >= 3 && row <= 12 && column.rfind("ibug68_8_", 0) == 0) cell = "nan";
       });
     },
     {"motion.csv", "ibug68_8", "max_gap_s"}},
    {"WithoutDrivenPoints",
     [](const In& in) { rename_columns(in, "ibug68_48_", "mole_"); },
     {"motion.csv", "drive.points", "ibug68_48"}},
    {"WithoutNamesInCommon",
     [](const In& in) {
       write_cells(in, [](std::size_t row, const std::string& column, std::string& cell) {
         if (row == 0 && column != "time_s") cell = "a_" + cell;
       });
     },
     {"motion.csv"}},
    {"TwoCoordinatesOfAPoint",
     [](const In& in) { rename_columns(in, "cheek_L_z", "cheek_L_y"); },
     {"motion.csv", "cheek_L"}},
    {"ThirdCoordinateMissing",
     [](const In& in) { rename_columns(in, "cheek_L_z", "cheek_Q_z"); },
     {"motion.csv", "cheek_"}},
    {"WordInACell",
     [](const In& in) {
       write_cells(in, [](std::size_t row, const std::string& column, std::string& cell) {
         if (row == 2 && column == "cheek_L_y_mm") cell = "lost";
       });
     },
     {"motion.csv:3", "cheek_L_y_mm", "lost", "number"}},
    {"RowTooShort",
     [](const In& in) { write_rows(in, [](auto& rows) { rows[3] = "0.0667,1,2"; }); },
     {"motion.csv:4", "3 cells", "expected"}},
    {"MetresSaidToBeMillimetres",
     [](const In& in) {
       write_cells(in, [](std::size_t row, const std::string& column, std::string& cell) {
         if (row > 0 && column != "time_s") cell = std::to_string(1e-3 * std::stod(cell));
       });
     },
     {"motion.csv", "mm"}},
    {"UnitOtherThanItsColumns",
     [](const In& in) {
       replace_in(in("scene.toml"), "motion.csv\"", "motion.csv\"\nunit = \"m\"");
     },
     {"motion.csv", "mm", "m"}},
    {"TornTrc",
     [](const In& in) {
       put(in("motion.trc"), "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\n30\t30\n");
       replace_in(in("scene.toml"), "motion.csv", "motion.trc");
     },
     {"motion.trc", "expected"}},
    {"RigidPointThatIsNotThere",
     [](const In& in) {
       replace_in(in("scene.toml"), "motion.csv\"",
                  "motion.csv\"\nrigid_points = [\"ibug68_27\", \"ibug68_36\", \"crown\"]");
     },
     {"scene.toml:", "motion.rigid_points", "motion.csv", "crown"}},
    {"SymmetryOfAnEmptyMotion",
     [](const In& in) { put(in("motion.csv"), "\n"); },
     {"motion.csv"},
     "symmetry motion.csv --out out.csv"},
    {"SymmetryWithoutItsPoints",
     [](const In& in) {
       put(in("motion.csv"),
           "time_s,a_x_mm,a_y_mm,a_z_mm,b_x_mm,b_y_mm,b_z_mm\n"
           "0,0,0,0,90,90,90\n1,0,0,0,90,90,90\n");
     },
     {"symmetry needs points"},
     "symmetry motion.csv --out out.csv"},
};

INSTANTIATE_TEST_SUITE_P(Scan, MalformedFile, testing::ValuesIn(kScans), name_of_fault);
INSTANTIATE_TEST_SUITE_P(Landmarks, MalformedFile, testing::ValuesIn(kLandmarks), name_of_fault);
INSTANTIATE_TEST_SUITE_P(Motion, MalformedFile, testing::ValuesIn(kMotions), name_of_fault);

}  // namespace
}  // namespace hyperex
