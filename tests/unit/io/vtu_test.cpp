// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/vtu.hpp"

#include <zlib.h>

#include <cstring>
#include <regex>

#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using Vtu = testing::FileTest;

/// The bytes of the array named so, unpacked as VTK does: by its declared offset and block table.
template <class T>
std::vector<T> unpacked(const std::string& file, const std::string& name) {
  std::smatch match;
  const std::regex line("Name=\"" + name + "\"[^>]*offset=\"([0-9]+)\"");
  if (!std::regex_search(file, match, line)) return {};
  const std::string marker = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t at = file.find(marker) + marker.size() + std::stoul(match[1]);
  const auto word = [&](std::size_t k) {
    std::uint64_t value;
    std::memcpy(&value, file.data() + at + 8 * k, 8);
    return value;
  };
  const std::uint64_t blocks = word(0);
  std::size_t from = at + 8 * (3 + blocks);
  std::string bytes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    uLongf length = b + 1 == blocks && word(2) ? word(2) : word(1);
    std::string block(length, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &length,
                         reinterpret_cast<const Bytef*>(file.data()) + from, word(3 + b)),
              Z_OK);
    EXPECT_EQ(length, block.size());
    bytes += block;
    from += word(3 + b);
  }
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

TEST_F(Vtu, ArraysComeBackFromTheFile) {
  const int n = 50000;  // more than one block of points
  const Points points = Points::Random(n, 3);
  Tetrahedra tets(n - 3, 4);
  for (int t = 0; t < n - 3; ++t) tets.row(t) << t, t + 1, t + 2, t + 3;
  VtuArray displacement{"displacement (mm)", Eigen::MatrixXf::Random(n, 3)};
  VtuArray strain{"strain & <more>", Eigen::MatrixXf::Random(n - 3, 6)};
  write_vtu(path("a.vtu"), points, tets, {displacement}, {strain});
  const std::string file = testing::file_bytes(path("a.vtu"));
  EXPECT_THAT(file, ::testing::HasSubstr("NumberOfPoints=\"50000\" NumberOfCells=\"49997\""));
  EXPECT_THAT(file, ::testing::HasSubstr("ComponentName4=\"YZ\""));

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
  const std::string file = testing::file_bytes(path("frames.pvd"));
  EXPECT_THAT(file, ::testing::HasSubstr("timestep=\"0.5\" group=\"\" part=\"0\" "
                                         "file=\"frames/a&amp;b.vtu\""));
}

}  // namespace
}  // namespace hyperex::io
