// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::simulate {

/// The axis through both condyles, and turns about it.
struct JawHinge {
  face::FaceFrame frame;
  Vec3 centre;  ///< between the condyles

  /// Between ibug68_1 and ibug68_15, `forward_m` in front of them.
  explicit JawHinge(const io::Landmarks& landmarks, double forward_m = 0);
  /// Opening, turning to the side, tilting: rad.
  Eigen::Matrix3d turned(double opening, double turn, double tilt = 0) const;
};

/// The derivative of `f` at `at`, a column each of its entries.
template <class Function, class Vector>
Eigen::MatrixXd central_differences(const Function& f, const Vector& at) {
  constexpr double h = 1e-6;
  Eigen::MatrixXd out;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Vector plus = at, minus = at;
    plus[k] += h;
    minus[k] -= h;
    const Eigen::VectorXd column = (f(plus) - f(minus)) / (2 * h);
    if (k == 0) out.resize(column.size(), at.size());
    out.col(k) = column;
  }
  return out;
}

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

  JawHinge hinge_;
  Parameters last_ = Parameters::Zero();
};

}  // namespace hyperex::simulate
