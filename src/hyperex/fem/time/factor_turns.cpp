// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/factor_turns.hpp"

#include <tbb/parallel_for.h>

#include "hyperex/fem/form/node_rotation.hpp"

namespace hyperex::fem {

FactorTurns::FactorTurns(const Assembler& assembler)
    : assembler_(assembler),
      at_factor_(std::size_t(assembler.node_count()), Eigen::Matrix3d::Identity()),
      since_(at_factor_) {}

void FactorTurns::factored_at(const Eigen::VectorXd& d) {
  tbb::parallel_for(std::size_t(0), at_factor_.size(), [&](std::size_t n) {
    at_factor_[n] = node_rotation(assembler_, d, int(n), at_factor_[n]);
  });
  turned_ = false;
}

void FactorTurns::update(const Eigen::VectorXd& d) {
  tbb::parallel_for(std::size_t(0), since_.size(), [&](std::size_t n) {
    since_[n] = node_rotation(assembler_, d, int(n), at_factor_[n]) * at_factor_[n].transpose();
  });
  turned_ = true;
}

template <typename Turn>
void FactorTurns::for_nodes(const std::vector<int>& unknowns, const Turn& turn) const {
  if (!turned_) return;
  for (std::size_t i = 0; i + 2 < unknowns.size();) {
    if (unknowns[i] % 3 != 0 || unknowns[i + 2] != unknowns[i] + 2) {
      ++i;
      continue;
    }
    turn(since_[std::size_t(unknowns[i] / 3)], Eigen::Index(i));
    i += 3;
  }
}

void FactorTurns::turn(const std::vector<int>& unknowns, Eigen::VectorXd& v) const {
  for_nodes(unknowns, [&](const Eigen::Matrix3d& r, Eigen::Index row) {
    v.segment<3>(row) = (r * v.segment<3>(row)).eval();
  });
}

void FactorTurns::turn_back(const std::vector<int>& unknowns, Eigen::VectorXd& v) const {
  for_nodes(unknowns, [&](const Eigen::Matrix3d& r, Eigen::Index row) {
    v.segment<3>(row) = (r.transpose() * v.segment<3>(row)).eval();
  });
}

}  // namespace hyperex::fem
