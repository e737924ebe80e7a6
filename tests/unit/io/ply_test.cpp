// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <limits>

#include "hyperex/core/files.hpp"
#include "hyperex/io/scan.hpp"
#include "support/refusal.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using testing::sheet;
using Ply = testing::FileTest;

std::string ascii_triangle(const std::string& vertices, const std::string& faces,
                           int vertex_count = 3, int face_count = 1) {
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n{}{}",
      vertex_count, face_count, vertices, faces);
}
const std::string three = "0 0 0\n150 0 0\n0 150 30\n";

template <class T>
void append(std::string& bytes, T value, bool big_endian) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

TEST_F(Ply, RoundTripKeepsVerticesOrderAndScalars) {
  const TriMesh mesh = sheet(7);
  VertexScalar scalar{"displacement_mm", Eigen::VectorXf::LinSpaced(mesh.points.rows(), 0, 26)};
  VertexColours colours = VertexColours::Random(mesh.points.rows(), 4);
  for (const LengthUnit unit :
       {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre}) {
    write_ply(path("a.ply"), mesh, unit, {scalar}, colours);
    const Scan scan = read_scan(path("a.ply"));
    EXPECT_EQ(scan.unit, unit);
    EXPECT_TRUE(scan.unit_guessed);
    EXPECT_EQ(scan.mesh.triangles, mesh.triangles);
    EXPECT_LT((scan.mesh.points - mesh.points).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(scan.vertex_colour, colours);
    EXPECT_EQ(scan.corner_uv.rows(), 0);
    // Written again, the same bytes: nothing drifts.
    write_ply(path("b.ply"), scan.mesh, unit, {scalar}, scan.vertex_colour);
    EXPECT_EQ(read_file(path("a.ply")), read_file(path("b.ply")));
  }
}

TEST_F(Ply, BinaryOfBothEndiansWithAnyOrderAndForeignElements) {
  for (const bool big : {false, true}) {
    std::string bytes = fmt::format(
        "ply\r\nformat {} 1.0\ncomment made by hand\nobj_info nothing\n"
        "element camera 2\nproperty double focus\nproperty list ushort short ticks\n"
        "element vertex 4\nproperty uchar quality\nproperty double z\nproperty short y\n"
        "property list uint double weights\nproperty float x\nproperty float red\n"
        "property float green\nproperty float blue\n"
        "element face 1\nproperty int flags\nproperty list int ushort vertex_index\n"
        "element edge 1\nproperty int a\nend_header\n",
        big ? "binary_big_endian" : "binary_little_endian");
    for (int camera = 0; camera < 2; ++camera) {
      append(bytes, 50.0, big);
      append(bytes, std::uint16_t(camera + 1), big);
      for (int k = 0; k <= camera; ++k) append(bytes, std::int16_t(-5), big);
    }
    const int corner[4][2] = {{0, 0}, {150, 0}, {150, 200}, {0, 200}};
    for (int i = 0; i < 4; ++i) {
      append(bytes, std::uint8_t(9), big);
      append(bytes, 10.5 * i, big);
      append(bytes, std::int16_t(corner[i][1]), big);
      append(bytes, std::uint32_t(1), big);
      append(bytes, 0.25, big);
      append(bytes, float(corner[i][0]), big);
      for (const float channel : {1.0f, 0.5f, 0.0f}) append(bytes, channel, big);
    }
    append(bytes, std::int32_t(-1), big);
    append(bytes, std::int32_t(4), big);
    for (const std::uint16_t i : {0, 1, 2, 3}) append(bytes, i, big);
    append(bytes, std::int32_t(7), big);
    const Scan scan = read_scan(write("m.ply", bytes));
    EXPECT_EQ(scan.unit, LengthUnit::millimetre);
    ASSERT_EQ(scan.mesh.points.rows(), 4);
    EXPECT_NEAR(scan.mesh.points(2, 0), 0.150, 1e-12);
    EXPECT_NEAR(scan.mesh.points(2, 1), 0.200, 1e-12);
    EXPECT_NEAR(scan.mesh.points(2, 2), 0.021, 1e-12);
    EXPECT_EQ(scan.mesh.triangles.rows(), 2);
    ASSERT_EQ(scan.vertex_colour.rows(), 4);
    EXPECT_EQ(scan.vertex_colour(0, 0), 255);
    EXPECT_EQ(scan.vertex_colour(0, 1), 128);
    EXPECT_EQ(scan.vertex_colour(0, 3), 255);
  }
}

TEST_F(Ply, QuadrangleIsCutAlongItsShorterDiagonal) {
  const auto file =
      write("q.ply", ascii_triangle("0 0 0\n100 0 0\n300 200 0\n0 100 0\n", "4 0 1 2 3\n", 4));
  const Scan scan = read_scan(file, LengthUnit::millimetre);
  Triangles expected(2, 3);
  expected << 0, 1, 3, 1, 2, 3;
  EXPECT_EQ(scan.mesh.triangles, expected);
}

TEST_F(Ply, TextureByFaceWithItsFile) {
  write("skin colour.png", testing::png_bytes());
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile skin colour.png\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n" +
      three;
  const Scan scan = read_scan(write("t.ply", text + "3 0 1 2 6 0 0.25 1 0.25 0.5 1\n"));
  ASSERT_EQ(scan.corner_uv.rows(), 3);
  EXPECT_FLOAT_EQ(scan.corner_uv(1, 0), 1.f);
  EXPECT_FLOAT_EQ(scan.corner_uv(1, 1), 0.75f);  // v counts from the picture's top
  EXPECT_FLOAT_EQ(scan.corner_uv(2, 1), 0.f);
  ASSERT_TRUE(scan.texture);
  EXPECT_EQ(scan.texture->mime_type, "image/png");
  EXPECT_EQ(scan.texture->bytes.size(), testing::png_bytes().size());

  const auto bad = write("u.ply", text + "3 0 1 2 5 0 0.25 1 0.25 0.5\n");
  expect_refused(bad, "face 0 (counted from 0) has 3 corners but 5 texture coordinates",
                 [&] { read_scan(bad); });
}

TEST_F(Ply, TextureByVertexAndMissingPictureIsOnlyAWarning) {
  const Scan scan = read_scan(write(
      "t.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile gone.jpg\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 0.1 0.2\n150 0 0 0.3 0.4\n0 150 30 0.5 0.6\n3 2 0 1\n"));
  ASSERT_EQ(scan.corner_uv.rows(), 3);
  EXPECT_FLOAT_EQ(scan.corner_uv(0, 0), 0.5f);
  EXPECT_FLOAT_EQ(scan.corner_uv(0, 1), 0.4f);
  EXPECT_FALSE(scan.texture);
}

TEST_F(Ply, RefusesEachFaultWithOneLine) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "property list uchar int vertex_indices\n";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is empty"},
      {"solid x\n", "is no PLY file"},
      {head + "element vertex 3\n", "without \"end_header\""},
      {"ply\nelement vertex 3\nend_header\n", "a line \"format ...\""},
      {"ply\nformat utf8 1.0\nend_header\n", "binary_big_endian"},
      {head + "element vertex -3\n" + xyz + "end_header\n", "COUNT a whole number, 0 or more"},
      {head + "element vertex 3.5\n" + xyz + "end_header\n", "COUNT a whole number, 0 or more"},
      {head + "element vertex 3\nproperty half x\nend_header\n", "instead of \"half\""},
      {head + "element vertex 3\nproperty list float int x\nend_header\n", "for a length"},
      {head + "property float x\nend_header\n", "an element before its properties"},
      {head + "elephant vertex 3\n", "format, comment"},
      {head + "element vertex 1000000000000\n" + xyz + "end_header\n0 0 0\n", "is torn"},
      {head + "element " + std::string(300, 'x') + " 9000\n" + xyz + "end_header\n",
       "rows of \"" + std::string(40, 'x') + "...\""},
      {head + "element vertex 9223372036854775807\n" + xyz + "end_header\n0 0 0\n", "is torn"},
      {head + "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
       "no x, y and z"},
      {ascii_triangle("0 0 0\n150 0 0\n0 nan 3\n", "3 0 1 2\n"), "vertex 2 (counted from 0)"},
      {ascii_triangle("0 0 0\n150 inf 0\n0 0 3\n", "3 0 1 2\n"), "vertex 1 (counted from 0)"},
      {ascii_triangle("0 0 0\n150 x1 0\n0 0 3\n", "3 0 1 2\n"), ":11: \"vertex\" 1 = x1"},
      {ascii_triangle(three, "3 0 1 3\n"),
       "face 0 (counted from 0) names vertex 3; expected 0 to 2"},
      {ascii_triangle(three, "3 0 -1 2\n"), "names vertex -1"},
      {ascii_triangle(three, "3 0 1.5 2\n"), "names vertex 1.5"},
      {ascii_triangle(three, "2 0 1\n"), "has 2 corners; expected at least 3"},
      {ascii_triangle(three, "-3 0 1 2\n"), "says -3 values"},
      {ascii_triangle(three, "3 0 1\n"), "it ends within \"face\" 0 of 1"},
      {ascii_triangle(three, "", 3, 0), "no faces (a point cloud?)"},
      {ascii_triangle("", "", 0, 0), "has no vertices"},
      {ascii_triangle(three, "3 0 1 2\n", 3, 400), "is torn"},
      {head + "element vertex 3\n" + xyz + "element face 1\nproperty int a\nend_header\n" + three +
           "1\n",
       "no list \"vertex_indices\""},
  };
  for (const auto& [text, part] : faults) {
    const auto file = write("bad.ply", text);
    expect_refused(file, part, [&] { read_scan(file, LengthUnit::millimetre); });
  }
}

TEST_F(Ply, NaNInABinaryFileNamesTheVertex) {
  TriMesh mesh = sheet(5);
  mesh.points(17, 1) = std::numeric_limits<double>::quiet_NaN();
  write_ply(path("n.ply"), mesh, LengthUnit::millimetre);
  expect_refused(path("n.ply"), "vertex 17", [&] { read_scan(path("n.ply")); });
}

TEST_F(Ply, TornAnywhereIsRefused) {
  write_ply(path("whole.ply"), sheet(4), LengthUnit::millimetre);
  const std::string bytes = read_file(path("whole.ply"));
  ASSERT_NO_THROW(read_scan(path("whole.ply")));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto file = write("torn.ply", bytes.substr(0, length));
    EXPECT_THROW(read_scan(file), InputError) << length << " of " << bytes.size();
  }
}

TEST_F(Ply, FlippedBytesNeverCrash) {
  write_ply(path("whole.ply"), sheet(2), LengthUnit::millimetre);
  const std::string bytes = read_file(path("whole.ply"));
  testing::read_flipped(bytes, {0xff, 0x80, 0x01, 0x30}, [&](const std::string& changed) {
    read_scan(write("flipped.ply", changed));
  });
}

TEST_F(Ply, AFullDiskLeavesNothing) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tiny{2000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tiny), 0);
  const std::string what = hyperex::test::refusal(
      [&] { write_ply(path("full.ply"), sheet(40), LengthUnit::millimetre); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(what, ::testing::HasSubstr("cannot be written"));
  EXPECT_TRUE(std::filesystem::is_empty(path("").parent_path()));
}

TEST_F(Ply, WriterRefusesOurOwnMistakes) {
  const TriMesh mesh = sheet(2);
  const auto write_with = [&](const VertexScalar& scalar) {
    write_ply(path("x.ply"), mesh, LengthUnit::metre, {scalar});
  };
  EXPECT_THROW(write_with({"two words", Eigen::VectorXf::Zero(9)}), std::invalid_argument);
  EXPECT_THROW(write_with({"short", Eigen::VectorXf::Zero(8)}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::io
