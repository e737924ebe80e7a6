// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/condensed_inverse.hpp"

#include <algorithm>

#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {
namespace {
constexpr Eigen::Index kColumnsTogether = 96;  // columns solved at a time

void check_nodes(const std::vector<int>& nodes, int unknowns) {
  for (const int node : nodes)
    require(node >= 0 && node < unknowns / 3, "node {}: expected 0 to {}", node, unknowns / 3 - 1);
}
}  // namespace

Eigen::MatrixXd condensed_inverse(PartitionedFactor& factor, const std::vector<int>& nodes) {
  check_nodes(nodes, factor.partition().unknowns());
  const std::vector<int>& free = factor.free();
  std::vector<Eigen::Index> row, place;  // positions among the free unknowns; in the result
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const int unknown = 3 * nodes[i] + axis;
      const auto at = std::lower_bound(free.begin(), free.end(), unknown);
      if (at == free.end() || *at != unknown) continue;
      row.push_back(at - free.begin());
      place.push_back(3 * Eigen::Index(i) + axis);
    }
  const auto count = Eigen::Index(row.size());
  const auto all = 3 * Eigen::Index(nodes.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(all, all);
  std::vector<int> last(row.begin(), row.end());
  std::sort(last.begin(), last.end());
  if (const Eigen::MatrixXd inverse = factor.cholesky().inverse_of_last(last);
      inverse.rows() == count) {
    std::vector<Eigen::Index> among;  // for each entry of `row`, its position in `last`
    for (const Eigen::Index r : row)
      among.push_back(std::lower_bound(last.begin(), last.end(), r) - last.begin());
    for (Eigen::Index c = 0; c < count; ++c)
      for (Eigen::Index r = 0; r < count; ++r)
        out(place[std::size_t(r)], place[std::size_t(c)]) =
            inverse(among[std::size_t(r)], among[std::size_t(c)]);
    return out;
  }
  Eigen::MatrixXd columns;
  for (Eigen::Index from = 0; from < count; from += kColumnsTogether) {
    const Eigen::Index width = std::min(kColumnsTogether, count - from);
    columns.setZero(Eigen::Index(free.size()), width);
    for (Eigen::Index c = 0; c < width; ++c) columns(row[std::size_t(from + c)], c) = 1;
    factor.solve(columns);
    for (Eigen::Index c = 0; c < width; ++c)
      for (Eigen::Index r = 0; r < count; ++r)
        out(place[std::size_t(r)], place[std::size_t(from + c)]) = columns(row[std::size_t(r)], c);
  }
  return 0.5 * (out + out.transpose());
}

NodeOrder order_with_last(const NodeOrder& known, const std::vector<int>& known_prescribed,
                          const std::vector<int>& prescribed, int unknowns,
                          const std::vector<int>& nodes) {
  const Partition before(unknowns, known_prescribed), now(unknowns, prescribed);
  require(known.unknowns.size() == before.free.size(),
          "the order of elimination has {} unknowns: expected the {} free ones",
          known.unknowns.size(), before.free.size());
  check_nodes(nodes, unknowns);
  enum : char { in_place, late, last };
  std::vector<char> when(std::size_t(unknowns), in_place);
  for (const int unknown : before.prescribed) when[std::size_t(unknown)] = late;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) when[std::size_t(3 * node + axis)] = last;
  NodeOrder out{{}, known.entries, known.flops};
  out.unknowns.reserve(now.free.size());
  const auto add = [&](int unknown, char wanted) {
    if (when[std::size_t(unknown)] == wanted && now.free_index[std::size_t(unknown)] >= 0)
      out.unknowns.push_back(now.free_index[std::size_t(unknown)]);
  };
  for (const int k : known.unknowns) add(before.free[std::size_t(k)], in_place);
  for (const char wanted : {late, last})
    for (const int unknown : now.free) add(unknown, wanted);
  return out;
}

}  // namespace hyperex::fem
