// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "hyperex/core/files.hpp"

namespace hyperex::io {
namespace {
static_assert(std::endian::native == std::endian::little);

constexpr std::size_t block_bytes = 1 << 18;
constexpr int vtk_tetra = 10;

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

/// Level and strategy of zlib.
struct Packing {
  int level, strategy;
};
constexpr Packing of_numbers{1, Z_RLE}, of_indices{1, Z_DEFAULT_STRATEGY}, as_it_is{0, Z_RLE};

/// One zlib stream per block, all copied from one initial state: creating a state takes as long as
/// compressing a small block.
class Deflater {
 public:
  explicit Deflater(Packing packing) : room_(compressBound(block_bytes)) {
    if (deflateInit2(&stream_, packing.level, Z_DEFLATED, MAX_WBITS, 8, packing.strategy) != Z_OK)
      throw std::runtime_error("zlib does not start");
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void append(const Bytef* data, std::size_t size, std::string& packed) {
    deflateReset(&stream_);
    stream_.next_in = const_cast<Bytef*>(data);
    stream_.avail_in = static_cast<uInt>(size);
    stream_.next_out = room_.data();
    stream_.avail_out = static_cast<uInt>(room_.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
      throw std::runtime_error("zlib could not compress a block");
    packed.append(reinterpret_cast<const char*>(room_.data()), room_.size() - stream_.avail_out);
  }

 private:
  z_stream stream_{};
  std::vector<Bytef> room_;
};

/// Collects the DataArray lines of the XML and the bytes that follow the XML.
class AppendedData {
 public:
  /// Appends the bytes of an array. Returns the line that declares it at the current offset.
  std::string add(const std::string& type, const std::string& name, Eigen::Index components,
                  const void* bytes, std::size_t size) {
    std::string names;
    if (components == 6) {
      constexpr const char* tensor[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
      for (int k = 0; k < 6; ++k) names += fmt::format(" ComponentName{}=\"{}\"", k, tensor[k]);
    }
    const auto* data = static_cast<const Bytef*>(bytes);
    return add(type, name, components, names,
               compressed(data, size, worth_packing(data, size) ? of_numbers : as_it_is));
  }
  /// The same for bytes that are already compressed.
  std::string add_compressed(const std::string& type, const std::string& name,
                             Eigen::Index components, const std::string& packed) {
    return add(type, name, components, "", packed);
  }
  const std::string& bytes() const { return bytes_; }

  /// VTK's layout: the number of blocks, the size of a block, the size of a shorter last one (or
  /// 0), the compressed size of each block, then the blocks. The bits of real numbers contain no
  /// repetitions except runs of equal bytes. Z_RLE looks only for these, which takes a third of the
  /// time and gives the same size (measured on frames of subject A).
  static std::string compressed(const Bytef* data, std::size_t size, Packing packing) {
    const std::size_t full = size / block_bytes, rest = size % block_bytes;
    std::vector<std::uint64_t> head{full + (rest > 0), block_bytes, rest};
    std::string packed;
    Deflater deflater(packing);
    for (std::size_t at = 0; at < size; at += block_bytes) {
      const std::size_t before = packed.size();
      deflater.append(data + at, std::min(block_bytes, size - at), packed);
      head.push_back(packed.size() - before);
    }
    return std::string(reinterpret_cast<const char*>(head.data()), 8 * head.size()) + packed;
  }

 private:
  /// Compresses a sample from the middle to decide whether compression pays. Displacements and
  /// strains of a moving face shrink by only 6 %, which takes ten times as long as writing them.
  static bool worth_packing(const Bytef* data, std::size_t size) {
    constexpr std::size_t tried_bytes = 1 << 13;
    if (size < 8 * tried_bytes) return true;
    std::string packed;
    Deflater(of_numbers).append(data + size / 2, tried_bytes, packed);
    return packed.size() < 3 * tried_bytes / 4;
  }

  std::string add(const std::string& type, const std::string& name, Eigen::Index components,
                  const std::string& names, const std::string& packed) {
    std::string line = fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} "
        "format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, escaped(name), components, names, bytes_.size());
    bytes_ += packed;
    return line;
  }

  std::string bytes_;
};

std::string section(const char* name, const std::vector<VtuArray>& arrays, Eigen::Index rows,
                    AppendedData& data) {
  std::string xml = fmt::format("      <{}>\n", name);
  for (const auto& array : arrays) {
    if (array.values.rows() != rows || array.values.cols() == 0)
      throw std::invalid_argument(fmt::format("write_vtu: \"{}\" needs {} rows", array.name, rows));
    if (array.flags) {
      const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> bytes =
          array.values.cast<std::uint8_t>();
      xml += data.add("UInt8", array.name, bytes.cols(), bytes.data(),
                      static_cast<std::size_t>(bytes.size()));
      continue;
    }
    xml += data.add("Float32", array.name, array.values.cols(), array.values.data(),
                    sizeof(float) * static_cast<std::size_t>(array.values.size()));
  }
  return xml + fmt::format("      </{}>\n", name);
}

template <class T>
std::string compressed(const T* values, std::size_t count) {
  return AppendedData::compressed(reinterpret_cast<const Bytef*>(values), sizeof(T) * count,
                                  std::is_floating_point_v<T> ? of_numbers : of_indices);
}

}  // namespace

VtuMesh::VtuMesh(const Points& points, const Tetrahedra& tetrahedra)
    : points_(points.rows()), cells_(tetrahedra.rows()) {
  const PointsF single = points.cast<float>();
  packed_points_ = compressed(single.data(), static_cast<std::size_t>(single.size()));
  const std::vector<std::int32_t> nodes(tetrahedra.data(), tetrahedra.data() + tetrahedra.size());
  std::vector<std::int32_t> ends(static_cast<std::size_t>(cells_));
  for (std::size_t t = 0; t < ends.size(); ++t) ends[t] = static_cast<std::int32_t>(4 * (t + 1));
  const std::vector<std::uint8_t> types(ends.size(), vtk_tetra);
  packed_nodes_ = compressed(nodes.data(), nodes.size());
  packed_ends_ = compressed(ends.data(), ends.size());
  packed_types_ = compressed(types.data(), types.size());
}

void VtuMesh::write(const std::filesystem::path& file, const std::vector<VtuArray>& point_arrays,
                    const std::vector<VtuArray>& cell_arrays) const {
  AppendedData data;
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      points_, cells_);
  xml += section("PointData", point_arrays, points_, data);
  xml += section("CellData", cell_arrays, cells_, data);
  xml += "      <Points>\n" + data.add_compressed("Float32", "Points", 3, packed_points_) +
         "      </Points>\n";
  xml +=
      "      <Cells>\n" + data.add_compressed("Int32", "connectivity", 1, packed_nodes_) +
      data.add_compressed("Int32", "offsets", 1, packed_ends_) +
      data.add_compressed("UInt8", "types", 1, packed_types_) +
      "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";

  write_file_atomically(file, [&](std::ostream& stream) {
    stream << xml << data.bytes() << "\n  </AppendedData>\n</VTKFile>\n";
  });
}

void write_vtu(const std::filesystem::path& file, const Points& points,
               const Tetrahedra& tetrahedra, const std::vector<VtuArray>& point_arrays,
               const std::vector<VtuArray>& cell_arrays) {
  VtuMesh(points, tetrahedra).write(file, point_arrays, cell_arrays);
}

void write_pvd(const std::filesystem::path& file,
               const std::vector<std::pair<double, std::filesystem::path>>& frames) {
  for (const auto& frame : frames)
    if (frame.second.is_absolute())
      throw std::invalid_argument("write_pvd: an absolute path: " + frame.second.string());
  write_file_atomically(file, [&](std::ostream& stream) {
    stream << "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
              "  <Collection>\n";
    for (const auto& [time_s, frame] : frames)
      stream << fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                            time_s, escaped(frame.generic_string()));
    stream << "  </Collection>\n</VTKFile>\n";
  });
}

}  // namespace hyperex::io
