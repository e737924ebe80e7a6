// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/vtu.hpp"

#include "hyperex/core/files.hpp"
#include "support/vtu_reader.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using test::unpacked;
using Vtu = testing::FileTest;

TEST_F(Vtu, ArraysComeBackFromTheFile) {
  const int n = 50000;  // more than one block of points
  const Points points = Points::Random(n, 3);
  Tetrahedra tets(n - 3, 4);
  for (int t = 0; t < n - 3; ++t) tets.row(t) << t, t + 1, t + 2, t + 3;
  VtuArray displacement{"displacement (mm)", Eigen::MatrixXf::Random(n, 3)};
  VtuArray strain{"strain & <more>", Eigen::MatrixXf::Random(n - 3, 6)};
  write_vtu(path("a.vtu"), points, tets, {displacement}, {strain});
  const std::string file = read_file(path("a.vtu"));
  EXPECT_THAT(file, ::testing::HasSubstr("NumberOfPoints=\"50000\" NumberOfCells=\"49997\""));
  EXPECT_THAT(file, ::testing::HasSubstr(
                        "ComponentName0=\"XX\" ComponentName1=\"YY\" ComponentName2=\"ZZ\" "
                        "ComponentName3=\"XY\" ComponentName4=\"YZ\" ComponentName5=\"XZ\""));

  const auto read_points = unpacked<float>(file, "Points");
  ASSERT_EQ(read_points.size(), 3u * n);
  for (int i = 0; i < 3 * n; ++i) ASSERT_EQ(read_points[i], float(points.data()[i]));
  const auto read_displacement = unpacked<float>(file, "displacement \\(mm\\)");
  ASSERT_EQ(read_displacement.size(), 3u * n);
  EXPECT_EQ(read_displacement[3 * 777 + 2], displacement.values(777, 2));
  const auto read_strain = unpacked<float>(file, "strain &amp; &lt;more&gt;");
  ASSERT_EQ(read_strain.size(), 6u * (n - 3));
  EXPECT_EQ(read_strain[6 * 4321 + 5], strain.values(4321, 5));
  const auto nodes = unpacked<std::int32_t>(file, "connectivity");
  ASSERT_EQ(nodes.size(), 4u * (n - 3));
  EXPECT_EQ(nodes[4 * 40000 + 3], 40003);
  EXPECT_EQ(unpacked<std::int32_t>(file, "offsets").back(), 4 * (n - 3));
  const auto types = unpacked<std::uint8_t>(file, "types");
  ASSERT_EQ(types.size(), std::size_t(n - 3));
  EXPECT_EQ(types[5], 10);
}

TEST_F(Vtu, RowsMustFit) {
  Points points = Points::Random(4, 3);
  Tetrahedra tets(1, 4);
  tets << 0, 1, 2, 3;
  EXPECT_THROW(write_vtu(path("a.vtu"), points, tets, {{"short", Eigen::MatrixXf::Zero(3, 1)}}),
               std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path("a.vtu")));
}

TEST_F(Vtu, SeriesNamesItsFilesWithTimes) {
  write_pvd(path("frames.pvd"), {{0, "frames/0000.vtu"}, {0.5, "frames/a&b.vtu"}});
  const std::string file = read_file(path("frames.pvd"));
  EXPECT_THAT(file, ::testing::HasSubstr("timestep=\"0.5\" group=\"\" part=\"0\" "
                                         "file=\"frames/a&amp;b.vtu\""));
}

TEST_F(Vtu, SeriesIsNotBoundToAPlace) {
  EXPECT_THROW(write_pvd(path("frames.pvd"), {{0, path("frames/0000.vtu")}}),
               std::invalid_argument);
}

TEST_F(Vtu, FlagsAreBytes) {
  Tetrahedra tets(3, 4);
  tets << 0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5;
  write_vtu(path("a.vtu"), Points::Random(6, 3), tets, {},
            {{"inverted", Eigen::Vector3f(0, 1, 0), true}});
  const std::string file = read_file(path("a.vtu"));
  EXPECT_THAT(file, ::testing::HasSubstr("type=\"UInt8\" Name=\"inverted\""));
  EXPECT_THAT(unpacked<std::uint8_t>(file, "inverted"), ::testing::ElementsAre(0, 1, 0));
}

}  // namespace
}  // namespace hyperex::io
