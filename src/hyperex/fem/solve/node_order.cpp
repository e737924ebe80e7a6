// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/node_order.hpp"

#include <cholmod.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/solve/cholmod_view.hpp"
#include "hyperex/fem/solve/metis_turn.hpp"
#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {
namespace {

struct Common : cholmod_common {
  Common() {
    cholmod_start(this);
    print = 0;
    supernodal = CHOLMOD_SIMPLICIAL;  // the counts suffice
    nmethods = 1;
    method[0].ordering = CHOLMOD_METIS;
    postorder = 1;
  }
  ~Common() { cholmod_finish(this); }
  Common(const Common&) = delete;
};

}  // namespace

NodeOrder order_by_nodes(const SparseMatrix& lower, const std::vector<int>& node_of) {
  require(static_cast<Eigen::Index>(node_of.size()) == lower.cols(),
          "order of elimination: {} nodes of columns for {} columns", node_of.size(), lower.cols());
  NodeOrder out;
  if (node_of.empty()) return out;
  std::vector<int> first, group(node_of.size());  // nodes numbered without gaps
  for (std::size_t c = 0; c < node_of.size(); ++c) {
    if (c == 0 || node_of[c] != node_of[c - 1]) first.push_back(static_cast<int>(c));
    group[c] = static_cast<int>(first.size()) - 1;
  }
  const int nodes = static_cast<int>(first.size());
  first.push_back(static_cast<int>(node_of.size()));
  std::vector<int> start{0}, item;
  for (int n = 0; n < nodes; ++n) {
    const int before = static_cast<int>(item.size());
    for (SparseMatrix::InnerIterator it(lower, first[n]); it; ++it) {
      const int other = group[it.row()];
      if (static_cast<int>(item.size()) == before || item.back() != other) item.push_back(other);
    }
    start.push_back(static_cast<int>(item.size()));
  }
  cholmod_sparse graph = cholmod_view(nodes, start.data(), item.data(), nullptr);
  Common common;
  cholmod_factor* factor = nullptr;
  {
    const auto turn = metis_turn();
    factor = cholmod_analyze(&graph, &common);
  }
  if (!factor || common.status < CHOLMOD_OK) {
    cholmod_free_factor(&factor, &common);
    throw NumericalError("the order of elimination could not be found (out of memory)");
  }
  const auto* order = static_cast<const int*>(factor->Perm);
  out.unknowns.reserve(node_of.size());
  for (int k = 0; k < nodes; ++k)
    for (int c = first[order[k]]; c < first[order[k] + 1]; ++c) out.unknowns.push_back(c);
  const double size = static_cast<double>(node_of.size()) / nodes;
  out.entries = size * size * common.lnz;
  out.flops = size * size * size * common.fl;
  cholmod_free_factor(&factor, &common);
  return out;
}

NodeOrder restricted(const NodeOrder& order, int unknowns, const std::vector<int>& prescribed,
                     const std::vector<int>& more) {
  const Partition whole(unknowns, prescribed), part(unknowns, more);
  require(order.unknowns.size() == whole.free.size(),
          "the order of elimination has {} unknowns: expected the {} free ones",
          order.unknowns.size(), whole.free.size());
  NodeOrder out;
  out.entries = order.entries;
  out.flops = order.flops;
  out.unknowns.reserve(part.free.size());
  for (const int k : order.unknowns)
    if (const int at = part.free_index[whole.free[k]]; at >= 0) out.unknowns.push_back(at);
  require(
      out.unknowns.size() == part.free.size(),
      "restricted(): an unknown that was prescribed is free now: expected more of them prescribed");
  return out;
}

}  // namespace hyperex::fem
