// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <limits>

#include "hyperex/io/scan.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using testing::sheet;
using Stl = testing::FileTest;

std::string binary_stl(const TriMesh& mesh, const std::string& title = "made for a test") {
  std::string bytes = title + std::string(80 - title.size(), '\0');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.rows()));
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) put(0.f);
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c)
        put(static_cast<float>(1e3 * mesh.points(mesh.triangles(t, k), c)));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const TriMesh& mesh) {
  std::string text = "solid sheet of a test\n";
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    text += " facet normal 0 0 1\n  outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const auto p = mesh.points.row(mesh.triangles(t, k));
      text += fmt::format("   vertex {} {} {}\n", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid sheet\n";
}

void expect_same_surface(const TriMesh& read, const TriMesh& mesh) {
  EXPECT_EQ(read.points.rows(), mesh.points.rows());  // corners are joined again
  ASSERT_EQ(read.triangles.rows(), mesh.triangles.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(
          (read.points.row(read.triangles(t, k)) - mesh.points.row(mesh.triangles(t, k))).norm(),
          1e-7);
}

TEST_F(Stl, BinaryAndAsciiGiveTheSurfaceBack) {
  const TriMesh mesh = sheet(6);
  expect_same_surface(read_scan(write("b.stl", binary_stl(mesh))).mesh, mesh);
  expect_same_surface(read_scan(write("s.STL", binary_stl(mesh, "solid but binary"))).mesh, mesh);
  const Scan ascii = read_scan(write("a.stl", ascii_stl(mesh)));
  expect_same_surface(ascii.mesh, mesh);
  EXPECT_EQ(ascii.unit, LengthUnit::millimetre);
}

TEST_F(Stl, MinusZeroIsZero) {
  TriMesh mesh;
  mesh.points.resize(6, 3);
  mesh.points << 0., 0, 0, .15, 0, 0, 0, .15, .03, -0., 0, 0, 0, .15, .03, -.15, -0., 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  EXPECT_EQ(read_scan(write("z.stl", binary_stl(mesh))).mesh.points.rows(), 4);
}

TEST_F(Stl, TornAnywhereIsRefused) {
  const TriMesh mesh = sheet(3);
  // The line's end behind "endsolid" and the name there may be missing.
  const std::string ascii = ascii_stl(mesh), binary = binary_stl(mesh);
  for (const auto& [bytes, end] :
       {std::pair{ascii, ascii.rfind("endsolid") + 8}, std::pair{binary, binary.size()}})
    for (std::size_t length = 0; length < end; ++length) {
      const auto file = write("torn.stl", bytes.substr(0, length));
      EXPECT_THROW(read_scan(file), InputError) << length << " of " << bytes.size();
    }
}

TEST_F(Stl, RefusesEachFaultWithOneLine) {
  TriMesh mesh = sheet(2);
  std::string huge = binary_stl(mesh);
  huge.replace(80, 4, "\xff\xff\xff\xff");
  TriMesh gap = mesh;
  gap.points(mesh.triangles(3, 1), 0) = std::numeric_limits<double>::quiet_NaN();
  TriMesh none = mesh;
  none.triangles.resize(0, 3);
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is empty"},
      {"hello", "is no STL file"},
      {huge, "its header says 4294967295 facets"},
      {binary_stl(gap), "(counted from 0) has a corner (nan"},
      {binary_stl(none), "has no vertices"},
      {"solid x\nendsolid x\n", "has no vertices"},
      {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n", ":5: vertex 1 0"},
      {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", ":4: zero: expected a number"},
      {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n",
       "three vertices in a facet"},
      {"solid x\nvertex 0 0 0\n", "a vertex inside a facet only"},
      {"solid x\nfacet normal 0 0 1\nfacet normal 0 0 1\n", "the end of the facet before"},
      {"solid x\nnonsense\n", "a line of an STL file"},
  };
  for (const auto& [bytes, part] : faults) {
    const auto file = write("bad.stl", bytes);
    expect_refused(file, part, [&] { read_scan(file); });
  }
}

}  // namespace
}  // namespace hyperex::io
