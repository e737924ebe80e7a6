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
    teeth,  ///< the inner surface about the mouth and the rim of the lips may touch them
    eye     ///< the lids may touch it about their rims
  } kind = Kind::teeth;
  std::shared_ptr<const SignedDistance> shape;  ///< at rest: scan frame, m
  bool with_jaw = false;                        ///< it moves with the mandible
  /// The pose of the obstacle, of those of the lower and the upper teeth. Eyes rest.
  Eigen::Isometry3d now_from_rest(const Eigen::Isometry3d& lower,
                                  const Eigen::Isometry3d& upper) const {
    if (kind == Kind::eye) return Eigen::Isometry3d::Identity();
    return with_jaw ? lower : upper;
  }
};

/// The teeth of both jaws, as far as they are given.
std::vector<Obstacle> teeth_obstacles(const anatomy::Teeth& teeth);
/// Both eyeballs, fitted behind the skin (anatomy/eyeballs.hpp). None where the landmarks do not
/// suffice.
std::vector<Obstacle> eye_obstacles(const Points& skin, const io::Landmarks& landmarks);

/// The places of a face that may touch an obstacle: vertices of the skin, then nodes of the inner
/// surface. Each may lie as deep in it as at rest. So nothing jumps where a scan, a thickness or a
/// fit is not exact.
class ObstaclePlaces {
 public:
  static constexpr double kMouth_m = 0.020;  ///< distance of inner nodes to the lips' points
  static constexpr double kLid_m = 0.004;    ///< distance of skin to the border of an eye

  ObstaclePlaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, Obstacle obstacle);

  const Obstacle& obstacle() const { return obstacle_; }
  const std::vector<int>& skin() const { return skin_; }    ///< vertices of the skin, rising
  const std::vector<int>& nodes() const { return nodes_; }  ///< of the volume, rising
  const Points& rest() const { return rest_; }
  Eigen::Index count() const { return rest_.rows(); }

  /// Displacements of the places (m), from those of the whole skin and of all nodes.
  Points moved(const PointsF& skin, const Eigen::Ref<const Points>& nodes) const;
  /// Distance (m) of place `i` from the obstacle beyond the allowed one, for a displacement of the
  /// place and a pose of the obstacle. To first order it grows by outward . displacement.
  double gap_m(Eigen::Index i, const Vec3& displacement, const Eigen::Isometry3d& now_from_rest,
               Vec3& outward) const;
  /// The greatest depth (m) beyond the allowed one.
  double depth(const Points& displacement, const Eigen::Isometry3d& now_from_rest) const;

 private:
  Obstacle obstacle_;
  std::vector<int> skin_, nodes_;
  Points rest_;
  std::vector<double> allowed_m_;  // the gap that each may have, at most 0
};

}  // namespace hyperex::simulate
