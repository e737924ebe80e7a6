// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// Which vertices of a file correspond to each vertex of the scan. Programs that export a mesh
/// reorder, split and drop vertices, change its unit and its axes.
class VertexMatch {
 public:
  /// `own`: the file's mesh, in any unit, moved, scaled or with exchanged axes; without triangles
  /// all its vertices count as used. In this order:
  ///   1. same order: as many vertices, and a similarity lays each on the scan's of its number;
  ///   2. by place: one of the 24 turns that exchange axes, with the scale and shift that make the
  ///      bounding boxes agree (of vertices in triangles), leaves a vertex within tolerance() of
  ///      every vertex of the scan that a triangle uses.
  /// Throws InputError where neither holds. It names `file`, the number of unmatched vertices and
  /// the distance of one of them.
  VertexMatch(const std::filesystem::path& file, const TriMesh& own, const TriMesh& scan);

  /// 1e-4 of the diagonal of the scan's bounding box: some 0.03 mm for a face. Coordinates that
  /// were rounded to six digits stay well within.
  static double tolerance(const Points& scan);

  bool same_order() const { return same_order_; }
  /// `of_file`: one value per vertex of the file. Where several of its vertices lie at one place,
  /// their mean (without NaN). Vertices that no triangle uses and no place matches get `otherwise`
  /// (NaN or 0).
  Eigen::VectorXd on_scan(const Eigen::VectorXd& of_file, double otherwise) const;
  /// Scan vertices at which the vertices of the file that lie there disagree.
  Eigen::Index disagreements(const Eigen::VectorXd& of_file) const;

 private:
  bool by_place(const TriMesh& own, const TriMesh& scan);

  bool same_order_ = false;
  std::vector<std::size_t> end_;  // per scan vertex: where its rows end
  std::vector<int> row_;
};

}  // namespace hyperex::tissue
