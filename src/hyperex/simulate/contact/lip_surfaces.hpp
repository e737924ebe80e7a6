// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// A vertex of the lower lip and the nearest place of the upper lip.
struct LipPair {
  int point = -1;           ///< index into LipSurfaces::lower()
  std::array<int, 3> on{};  ///< indices into LipSurfaces::upper()
  Vec3 weight;              ///< of these three; sum 1
  Vec3 normal;              ///< unit length, away from the upper lip
  /// Distance (m) beyond the allowed one: below 0 the lips pass through each other deeper than at
  /// rest. To first order it changes by normal . (motion of the point - motion of the place).
  double gap_m = 0;
};

/// The skin of both lips about the mouth, and where the lips meet.
///
/// The upper lip is a surface, the lower lip a set of vertices. The lip of a scan ends at its rim.
/// A vertex that is nearest to the rim would be inside as well as outside. So the upper lip's
/// surface is extended from its rim straight back into the mouth, by `kInward_m`, and the extension
/// moves with the rim. Distances are to the nearest point. The surface's normal there gives the
/// sign. Deeper than 0.02 mm a ray forward must also leave the upper lip more often than it enters
/// it, since at the corners of the mouth the skin is folded and its normals contradict. Lips
/// that overlap at rest, because of noise or pressure, may overlap as deep as then, each vertex by
/// itself.
class LipSurfaces {
 public:
  static constexpr double kReach_m = 0.010;    ///< of a lip's skin about ibug68_61 to 67 (but 64)
  static constexpr double kDeepest_m = 0.012;  ///< what lies deeper is another part of the face
  static constexpr double kInward_m = 0.008;

  LipSurfaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

  bool empty() const { return lower_.empty() || upper_.empty(); }
  /// Vertices of the skin.
  const std::vector<int>& lower() const { return lower_; }
  const std::vector<int>& upper() const { return upper_; }
  const Points& lower_rest() const { return lower_rest_; }
  const Points& upper_rest() const { return upper_rest_; }

  /// Pairs whose gap is less than `within_m`, for displacements of the vertices (one row per vertex
  /// of lower() and upper(), m). May be called from several threads.
  std::vector<LipPair> pairs(const Points& lower_displacement, const Points& upper_displacement,
                             double within_m) const;
  /// The greatest depth (m) of the lips in each other beyond the allowed one.
  double depth(const PointsF& skin_displacement) const;

 private:
  using Faces = std::vector<std::array<int, 3>>;
  /// Fills upper_, and returns the triangles of the skin that it has.
  Faces upper_faces(const tissue::TissueMesh& mesh, const std::vector<char>& near);
  void extend_inwards(const tissue::TissueMesh& mesh, const std::vector<char>& near, Faces& faces);
  void find_neighbours(const Faces& faces);
  std::vector<LipPair> raw_pairs(const Points& lower, const Points& upper, double within_m) const;
  std::optional<Vec3> outward_at(const Points& points, std::size_t triangle,
                                 const Vec3& weights) const;

  std::vector<int> lower_, upper_;  // of the skin
  Points lower_rest_, upper_rest_;
  // The upper lip's surface: its vertices, then those of the part that goes inwards.
  Triangles triangles_;
  Eigen::Index own_triangles_ = 0;  // the first so many are the skin's
  Vec3 forward_ = Vec3::UnitZ();
  std::vector<int> follows_;                // of each vertex of the surface, of upper_
  Points offset_;                           // from that one, at rest
  std::vector<std::vector<int>> around_;    // of each vertex, the triangles
  std::vector<char> end_;                   // per vertex: where the surface ends
  std::vector<std::array<int, 3>> across_;  // of each triangle, opposite each corner; -1: its end
  std::vector<double> allowed_m_;  // per vertex of lower_: the gap that it may have, at most 0
};

}  // namespace hyperex::simulate
