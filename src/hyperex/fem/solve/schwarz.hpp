// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>

#include "hyperex/fem/solve/cholesky.hpp"
#include "hyperex/fem/solve/subdomains.hpp"

namespace hyperex::fem {

/// Two levels for conjugate gradients on A: overlapping subdomains, each solved by its own Cholesky
/// factor, and the rigid motions of the subdomains, faded out by their weights, solved together.
///   M^-1 r = S r + F A_0^-1 (F^T r - (A F)^T S r),  S = sum_i R_i^T A_i^-1 R_i,  A_0 = F^T A F
/// Sources: additive Schwarz with a partition of unity (Toselli and Widlund, Domain Decomposition
/// Methods, 2005); the second level applied as "A-DEF2" (Tang, Nabben, Vuik, Erlangga, J. Sci.
/// Comput. 39, 2009), which wants a start that leaves F^T r = 0: `start`.
class Schwarz {
 public:
  /// Finds the subdomains and the order of elimination of each; `points`: one row a node of `a`.
  Schwarz(const NodeBlocks& a, const Points& points, int subdomain_nodes,
          const std::string& purpose);

  /// Factors the values of `a`. Returns -1, or the row of `a` near which the matrix is not positive
  /// definite to rounding.
  int factorize(const NodeBlocks& a);

  /// z := M^-1 r
  void apply(const Columns& r, Columns& z);
  /// z := F A_0^-1 F^T r
  void start(const Columns& r, Columns& z);

  int subdomain_count() const { return subdomains_.nodes.size(); }
  int coarse_size() const { return static_cast<int>(coarse_.rows()); }
  double factor_entries() const;

 private:
  struct Local {
    Cholesky cholesky;
    Eigen::MatrixXd rigid;    // F_i, on its own nodes
    std::vector<int> around;  // nodes where A F_i is not zero
    Eigen::MatrixXd pulled;   // A F_i there
    Eigen::MatrixXd x;        // its share of a vector
    int first = 0;            // of its columns in A_0
  };
  SparseMatrix lower_of(const NodeBlocks& a, int s, std::vector<int>& place) const;
  Eigen::MatrixXd rigid_motions(const NodeBlocks& a, const Points& points, int s) const;
  void pull(const NodeBlocks& a, int s, std::vector<int>& place);
  int factorize_coarse(const NodeBlocks& a);
  Eigen::MatrixXd coarse_solve(Eigen::MatrixXd c) const;
  void add_coarse(const Eigen::MatrixXd& c, Columns& z);
  void gather(Columns& z, bool add) const;

  Subdomains subdomains_;
  Lists homes_;                    // node -> entries of subdomains_.nodes.item
  std::vector<int> subdomain_of_;  // per entry of subdomains_.nodes.item
  std::vector<Local> local_;
  Eigen::MatrixXd coarse_;  // lower Cholesky factor of A_0
};

}  // namespace hyperex::fem
