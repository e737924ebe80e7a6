// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// A vertex of the lower lip and the place of the upper one that is nearest to it.
struct LipPair {
  int point = -1;           ///< of LipSurfaces::lower()
  std::array<int, 3> on{};  ///< of LipSurfaces::upper()
  Vec3 weight;              ///< of them; sum 1
  Vec3 normal;              ///< unit length, away from the upper lip
  /// How far apart (m), over what is allowed: below 0 they pass through each other deeper than at
  /// rest. To first order it changes by normal . (what the point moves - what the place moves).
  double gap_m = 0;
};

/// Both lips' skin about the mouth, and where they meet.
///
/// The upper lip is a surface, the lower one its vertices. A scan's lip ends at the rim, and a
/// vertex of the other lip that is nearest to the rim would be inside as well as outside. So the
/// upper lip's surface goes on from its rim into the mouth by `kInward_m`, straight back, and moves
/// with the rim. Distances are to the nearest point; its side is told by the surface's normal
/// there and, deeper than a millimetre, by whether it lies behind the upper lip's skin. Lips that
/// overlap at rest, by the scan's noise or since they are pressed together, may do so as deep as
/// they did, each vertex by itself.
class LipSurfaces {
 public:
  static constexpr double kReach_m = 0.010;  ///< skin as near to ibug68_61 to 67 (but 64) is a lip
  static constexpr double kDeepest_m = 0.012;  ///< farther behind is another part of the face
  static constexpr double kInward_m = 0.008;

  LipSurfaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

  bool empty() const { return lower_.empty() || upper_.empty(); }
  /// Vertices of the skin.
  const std::vector<int>& lower() const { return lower_; }
  const std::vector<int>& upper() const { return upper_; }
  const Points& lower_rest() const { return lower_rest_; }
  const Points& upper_rest() const { return upper_rest_; }

  /// Pairs nearer than `within_m` over what is allowed, where vertices are displaced (one row each
  /// of lower() and upper(), m). May be called from several threads.
  std::vector<LipPair> pairs(const Points& lower_displacement, const Points& upper_displacement,
                             double within_m) const;
  /// Greatest depth (m) by which the lips pass through each other beyond what is allowed.
  double depth(const PointsF& skin_displacement) const;

 private:
  std::vector<LipPair> raw_pairs(const Points& lower, const Points& upper, double within_m) const;
  std::optional<Vec3> outward_at(const Points& points, std::size_t triangle,
                                 const Vec3& weights) const;
  bool is_behind(const Points& points, const Vec3& p) const;

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
