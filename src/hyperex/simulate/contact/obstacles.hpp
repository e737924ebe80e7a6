// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/geometry/signed_distance.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// A rigid body that tissue may touch and not enter.
struct Obstacle {
  enum class Kind {
    teeth,  ///< touched by the mouth's side of the tissue and by the rim of the lips
    eye     ///< touched by the lids about their rims
  } kind = Kind::teeth;
  std::shared_ptr<const SignedDistance> shape;  ///< as it stands at rest: scan frame, m
  bool with_jaw = false;                        ///< goes along with the mandible; else it stays
};

/// The teeth of both jaws, those that there are.
std::vector<Obstacle> teeth_to_touch(const anatomy::Teeth& teeth);
/// Both eyeballs as they are fitted behind the skin (anatomy/eyeballs.hpp); none where the
/// landmarks do not tell them.
std::vector<Obstacle> eyes_to_touch(const Points& skin, const io::Landmarks& landmarks);

/// The places of a face that may touch an obstacle: vertices of the skin, then nodes of the inner
/// surface. Each may lie as deep in it as it does at rest and no deeper, so that nothing jumps
/// where a scan, a thickness or a fit is not exact.
class ObstaclePlaces {
 public:
  static constexpr double kMouth_m = 0.020;  ///< inner nodes as near to the lips' points
  static constexpr double kLid_m = 0.004;    ///< skin as near to the border of an eye

  ObstaclePlaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, Obstacle obstacle);

  const Obstacle& obstacle() const { return obstacle_; }
  const std::vector<int>& skin() const { return skin_; }    ///< vertices of the skin, rising
  const std::vector<int>& nodes() const { return nodes_; }  ///< of the volume, rising
  const Points& rest() const { return rest_; }
  Eigen::Index count() const { return rest_.rows(); }

  /// Displacements of the places (m), of those of the whole skin and of all nodes.
  Points moved(const PointsF& skin, const Eigen::Ref<const Points>& nodes) const;
  /// How far place `i` is outside of the obstacle over what is allowed (m), where it is displaced
  /// so and the obstacle's body stands at `now_from_rest`. To first order that grows by
  /// outward . displacement.
  double gap_m(Eigen::Index i, const Vec3& displacement, const Eigen::Isometry3d& now_from_rest,
               Vec3& outward) const;
  /// Greatest depth (m) beyond what is allowed.
  double depth(const Points& displacement, const Eigen::Isometry3d& now_from_rest) const;

 private:
  Obstacle obstacle_;
  std::vector<int> skin_, nodes_;
  Points rest_;
  std::vector<double> allowed_m_;  // the gap that each may have, at most 0
};

}  // namespace hyperex::simulate
