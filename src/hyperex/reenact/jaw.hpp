// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/face_frame.hpp"

namespace hyperex::reenact {

/// The mandible as a rigid body: it turns about the transverse axis through both condyles
/// (opening), about the vertical (to the side), and its condyles slide. Found from the skin points
/// over the chin by regularised least squares: sliding and turning to the side cost, opening does
/// not.
class Jaw {
 public:
  /// The condyles are taken 15 % inwards of the ibug68_1 and ibug68_15 points, at their height and
  /// `condyle_forward_m` in front of them.
  explicit Jaw(const io::Landmarks& landmarks, double condyle_forward_m = 0);

  /// Displacement that carries `rest` (n x 3) nearest to `rest + displacement`; starts from the
  /// last answer, so that it follows a motion quickly.
  Eigen::Isometry3d follow(const Points& rest, const Points& displacement);

  /// The angle of opening of the last answer, degrees.
  double opening_deg() const;

 private:
  using Parameters = Eigen::Matrix<double, 5, 1>;  // opening, turn (rad), slide x y z (m)
  Eigen::Isometry3d transform(const Parameters& p) const;

  tissue::FaceFrame frame_;
  Vec3 centre_;
  Parameters last_ = Parameters::Zero();
};

}  // namespace hyperex::reenact
