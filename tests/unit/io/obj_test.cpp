// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/remarks.hpp"
#include "hyperex/io/scan.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using Obj = testing::FileTest;

const std::string square =
    "# a scan\nmtllib skin.mtl\nv 0 0 0\nv 150 0 0\nv 150 200 20\nv 0 200 10\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.75\nusemtl skin\n";

TEST_F(Obj, PolygonsTextureAndMaterial) {
  write("skin.mtl", "newmtl skin\nmap_Kd textures/skin.png\n");
  std::filesystem::create_directories(path("textures"));
  write("textures/skin.png", testing::png_bytes());
  const Scan scan = read_scan(write("a.obj", square + "f 1/1 2/2 3/3 4/4\n"));
  EXPECT_EQ(scan.unit, LengthUnit::millimetre);
  ASSERT_EQ(scan.mesh.points.rows(), 4);
  EXPECT_NEAR(scan.mesh.points(2, 1), 0.2, 1e-12);
  ASSERT_EQ(scan.mesh.triangles.rows(), 2);
  ASSERT_EQ(scan.corner_uv.rows(), 6);
  for (int c = 0; c < 6; ++c) {  // v counts from the picture's top
    const int vertex = scan.mesh.triangles(c / 3, c % 3);
    const float v[] = {1, 1, 0, 0.25};
    EXPECT_FLOAT_EQ(scan.corner_uv(c, 1), v[vertex]);
  }
  ASSERT_TRUE(scan.texture);
  EXPECT_EQ(scan.texture->bytes.size(), testing::png_bytes().size());
}

TEST_F(Obj, WithoutItsTextureAScanIsStillRead) {
  EXPECT_FALSE(read_scan(write("a.obj", square + "f 1/1 2/2 3/3\n")).texture);  // no .mtl
  write("skin.mtl", "newmtl skin\nmap_Kd gone.png\n");
  std::string heard;
  listen_to_remarks([&](Remark, const std::string& sentence) { heard += sentence; });
  const Scan scan = read_scan(write("b.obj", square + "f 1/1 2/2 3/3\n"));
  listen_to_remarks({});
  EXPECT_NE(heard.find("b.obj: going on without its texture"), std::string::npos) << heard;
  EXPECT_FALSE(scan.texture);
  EXPECT_EQ(scan.corner_uv.rows(), 3);
}

TEST_F(Obj, RelativeIndicesColoursGroupsAndLineEnds) {
  const Scan scan =
      read_scan(write("c.obj",
                      "v 0 0 0 1 0 0 # first\r\nv 15 0 0 0 1 0\r\nv 0 20 3 0 0 0.5\r\ng one\r\n"
                      "f -3 -2 -1\r\ng two\r\nf 1//1 3//1 2//1 # back\r\nvn 0 0 1\r\n"));
  EXPECT_EQ(scan.unit, LengthUnit::centimetre);
  Triangles expected(2, 3);
  expected << 0, 1, 2, 0, 2, 1;
  EXPECT_EQ(scan.mesh.triangles, expected);
  ASSERT_EQ(scan.vertex_colour.rows(), 3);
  EXPECT_EQ(scan.vertex_colour(1, 1), 255);
  EXPECT_EQ(scan.vertex_colour(2, 2), 128);
  EXPECT_EQ(scan.corner_uv.rows(), 0);
}

TEST_F(Obj, RefusesEachFaultWithOneLine) {
  const std::string v = "v 0 0 0\nv 150 0 0\nv 150 200 20\n";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is empty"},
      {v, "no faces (a point cloud?)"},
      {v + "v 1 nan 2\nf 1 2 3\n", ":4: nan: expected a finite number"},
      {v + "v 1 inf 2\nf 1 2 3\n", ":4: inf"},
      {v + "v 1 2\nf 1 2 3\n", "3 numbers behind it, not 2"},
      {v + "v 1 2 three\n", ":4: three"},
      {v + "f 1 2 4\n", ":4: 4: expected the index of a vertex from 1 to 3"},
      {v + "f 1 2 0\n", ":4: 0"},
      {v + "f 1 2 -4\n", ":4: -4"},
      {v + "f 1 2\n", "a face of 3 to 255 corners"},
      {v + "f 1 2 a\n", ":4: a"},
      {v + "f 1/1 2/1 3/1\n", "texture coordinate from 1 to 0"},
      {v + "f 1/1/1/1 2 3\n", "vertex/texture"},
      {v + "f 99999999999999999999 2 3\n", ":4: 99999999999999999999"},
  };
  for (const auto& [text, part] : faults) {
    const auto file = write("bad.obj", text);
    expect_refused(file, part, [&] { read_scan(file); });
  }
}

TEST_F(Obj, FlippedBytesNeverCrash) {
  const std::string text = square + "f 1/1 2/2 3/3 4/4\nf -4 -3 -2\n";
  testing::read_flipped(text, {0xff, 0x80, 0x01, 0x10}, [&](const std::string& changed) {
    read_scan(write("flipped.obj", changed));
  });
}

}  // namespace
}  // namespace hyperex::io
