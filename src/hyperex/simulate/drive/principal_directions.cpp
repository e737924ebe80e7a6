// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/principal_directions.hpp"

#include <Eigen/QR>

#include "hyperex/core/symmetric_modes.hpp"

namespace hyperex::simulate {

PrincipalDirections principal_directions(const Eigen::MatrixXd& a) {
  if (a.size() == 0) return {Eigen::MatrixXd(a.rows(), 0), Eigen::VectorXd()};
  const bool wide = a.rows() <= a.cols();
  const SymmetricModes modes = symmetric_modes(wide ? Eigen::MatrixXd(a * a.transpose())
                                                    : Eigen::MatrixXd(a.transpose() * a));
  PrincipalDirections out;
  out.sizes = modes.values.reverse().cwiseMax(0).cwiseSqrt();
  out.directions = modes.vectors.rowwise().reverse();
  if (!wide) {
    const Eigen::MatrixXd tall = a * out.directions;
    out.directions =
        tall.householderQr().householderQ() * Eigen::MatrixXd::Identity(tall.rows(), tall.cols());
  }
  return out;
}

}  // namespace hyperex::simulate
