// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::io {

/// Named values at points or in cells: 1 column for a scalar, 3 for a vector, 6 for a symmetric
/// tensor in ParaView's order xx, yy, zz, xy, yz, xz (tensor shear strain, half the engineering
/// shear strain).
struct VtuArray {
  std::string name;  ///< with its unit, e.g. "von Mises stress (kPa)"
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  bool flags = false;  ///< the values are whole numbers from 0 to 255, written as UInt8
};

/// Writes an unstructured grid of linear tetrahedra for ParaView: VTK's XML format (version 1.0),
/// little-endian, with appended raw data in blocks compressed by zlib. Points are in metres, as
/// float32. `point_arrays` have one row per point and `cell_arrays` one per tetrahedron
/// (std::invalid_argument otherwise). Throws InputError if the file cannot be written.
void write_vtu(const std::filesystem::path& file, const Points& points,
               const Tetrahedra& tetrahedra, const std::vector<VtuArray>& point_arrays = {},
               const std::vector<VtuArray>& cell_arrays = {});

/// The same for a series of files with one mesh. The mesh is compressed only once.
class VtuMesh {
 public:
  VtuMesh(const Points& points, const Tetrahedra& tetrahedra);
  /// May be called from several threads.
  void write(const std::filesystem::path& file, const std::vector<VtuArray>& point_arrays,
             const std::vector<VtuArray>& cell_arrays) const;

 private:
  Eigen::Index points_, cells_;
  std::string packed_points_, packed_nodes_, packed_ends_, packed_types_;
};

/// Writes a time series for ParaView: the time (s) of each file and its path relative to the folder
/// of `file`, so that the series can be moved (std::invalid_argument for an absolute path). Throws
/// InputError if the file cannot be written.
void write_pvd(const std::filesystem::path& file,
               const std::vector<std::pair<double, std::filesystem::path>>& frames);

}  // namespace hyperex::io
