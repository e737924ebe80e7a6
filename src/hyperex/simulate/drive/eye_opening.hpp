// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::simulate {

/// The iBUG points of an eye. A pair is one of the upper lid and that below it; first the pair
/// beside the inner corner.
struct EyePoints {
  int inner, outer;
  std::array<std::pair<int, int>, 2> pairs;
};
/// The right and the left eye.
inline constexpr std::array<EyePoints, 2> kEyes = {
    {{39, 36, {{{38, 40}, {37, 41}}}}, {42, 45, {{{43, 47}, {44, 46}}}}}};

/// Distance of neighbouring columns.
inline constexpr double kLidColumn_m = 5e-4;

/// A place along an eye at which both lids are seen from the front: their edges there.
struct LidColumn {
  double along_m;
  render::Picked upper, lower;
};

/// The opening between the lids of an eye, as seen from the front.
class EyeOpening {
 public:
  /// `landmarks`: the 68 iBUG points.
  EyeOpening(const io::Landmarks& landmarks, const EyePoints& points);

  /// The columns from the inner to the outer corner, kLidColumn_m apart. None where the eye is
  /// closed or its ball was scanned, or where no edge follows within 12 mm. Edges are right to 0.1
  /// mm.
  std::vector<LidColumn> columns(const TriMesh& skin) const;

  /// The way along the eye, towards its outer corner, from the middle of its four points.
  double along_m(const Vec3& point) const { return (point - middle_).dot(along_); }
  double along_of_pair_m(std::size_t pair) const { return line_[pair + 1].first; }
  /// How far apart the points of a pair, and the edges in a column, are.
  double aperture_m(std::size_t pair) const {
    return (pairs_[pair].first - pairs_[pair].second).dot(up_);
  }
  double aperture_m(const LidColumn& column) const {
    return (column.upper.point - column.lower.point).dot(up_);
  }

 private:
  using Picks = std::vector<std::optional<render::Picked>>;
  /// The first and the last row between the lids.
  struct Run {
    int first, last;
  };
  Vec3 between(std::size_t pair) const { return (pairs_[pair].first + pairs_[pair].second) / 2; }
  Picks look(const TriMesh& skin) const;
  double forward_m(double along_m) const;
  bool is_open(const Picks& seen, int column, int row) const;
  std::optional<Run> run_in(const Picks& seen, int column, const Run& beside) const;

  std::array<std::pair<Vec3, Vec3>, 2> pairs_;
  Vec3 middle_, along_, up_, forward_;
  std::vector<std::pair<double, Vec3>> line_;  // corners and middles of pairs, by their way along
};

}  // namespace hyperex::simulate
