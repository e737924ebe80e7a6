// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Products of tall dense matrices by BLAS. The work is divided among the threads in a fixed number
/// of parts, so that the results do not depend on the number of threads.

/// A^T B.
Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b);
/// out += factor A B.
void add_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::MatrixXd& b,
                 double factor, Eigen::Ref<Eigen::MatrixXd> out);
/// S B for a symmetric sparse S with both triangles stored.
Eigen::MatrixXd symmetric_product(const SparseMatrix& s,
                                  const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace hyperex::fem
