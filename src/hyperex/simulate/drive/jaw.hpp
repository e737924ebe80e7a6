// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::simulate {

/// The axis through both condyles, and rotations about it.
struct JawHinge {
  face::FaceFrame frame;
  Vec3 centre;  ///< between the condyles

  /// Through the condyles of `bones` where they are known (null: no bones). Otherwise the axis is
  /// transverse, and its centre the middle between ibug68_1 and ibug68_15.
  explicit JawHinge(const io::Landmarks& landmarks, const anatomy::Bones* bones);
  /// The rotation by an opening, a turn to the side and a tilt, rad.
  Eigen::Matrix3d turned(double opening, double turn, double tilt = 0) const;
};

/// The derivative of `f` at `at`, one column per entry of `at`.
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

/// The mandible as a rigid body. It turns about the transverse axis through both condyles (opening)
/// and about the vertical (to the side), and its condyles slide. Its pose is found from the skin
/// points over the chin by least squares, in which sliding and turning to the side are penalised
/// and opening is not.
class Jaw {
 public:
  explicit Jaw(const io::Landmarks& landmarks, const anatomy::Bones* bones);

  /// The displacement that carries `rest` (n x 3, m) nearest to `rest + displacement`. The search
  /// starts from the last answer.
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
