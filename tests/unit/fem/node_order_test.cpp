// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/node_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

struct Box {
  test::BoxMesh box;
  System system;
  std::vector<int> held;

  explicit Box(int cells, double poisson = 0.495)
      : box(test::box_mesh({2 * cells, 2 * cells, cells}, Vec3(0.08, 0.08, 0.04), 0.1)),
        system(assemble(box.nodes, box.tets,
                        test::uniform_material(box.tets.rows(), 192.4e3, poisson, 476.8, 1100),
                        ElementKind::tet4_star)),
        held(test::unknowns_where(box.nodes, [](const Vec3& p) { return p.z() < 1e-9; })) {
    // One axis of some node alone too.
    held.push_back(static_cast<int>(system.stiffness.cols()) - 2);
  }
  Partition partition() const { return {static_cast<int>(system.stiffness.cols()), held}; }
};

TEST(NodeOrder, IsAnOrderAndForecastsTheFactor) {
  const Box b(8);
  const Partition partition = b.partition();
  const SparseMatrix lower = free_lower(b.system.stiffness, partition);
  std::vector<int> node_of;
  for (const int f : partition.free) node_of.push_back(f / 3);
  const NodeOrder order = order_by_nodes(lower, node_of);
  std::vector<int> sorted = order.unknowns;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < static_cast<int>(sorted.size()); ++k) ASSERT_EQ(sorted[k], k);
  ASSERT_EQ(static_cast<Eigen::Index>(sorted.size()), lower.cols());
  const Cholesky cholesky(lower, "test", order.unknowns);
  EXPECT_NEAR(order.entries / cholesky.entries_needed(), 1, 0.05);
  EXPECT_NEAR(order.flops / cholesky.flops(), 1, 0.05);
  // Small meshes store more zeros than the share for large ones says.
  EXPECT_LT(cholesky.entries(), 1.1 * kStoredShare * order.entries);
  EXPECT_TRUE(order_by_nodes(SparseMatrix(0, 0), {}).unknowns.empty());
}

TEST(NodeOrder, OfFewerUnknownsKeepsTheOrderAndTakesNoLargerFactor) {
  const Box b(8);
  const Partition whole = b.partition();
  std::vector<int> more = whole.prescribed;
  for (int k = 0; k < int(whole.free.size()); k += 5) more.push_back(whole.free[k]);
  std::sort(more.begin(), more.end());
  const Partition part(whole.unknowns(), more);
  std::vector<int> node_of;
  for (const int f : whole.free) node_of.push_back(f / 3);
  const NodeOrder order = order_by_nodes(free_lower(b.system.stiffness, whole), node_of);
  const NodeOrder fewer = restricted(order, whole.unknowns(), whole.prescribed, more);
  ASSERT_EQ(fewer.unknowns.size(), part.free.size());
  std::vector<int> from_whole, from_part;
  for (const int k : order.unknowns)
    if (part.free_index[whole.free[k]] >= 0) from_whole.push_back(whole.free[k]);
  for (const int k : fewer.unknowns) from_part.push_back(part.free[k]);
  EXPECT_EQ(from_whole, from_part);
  const SparseMatrix lower = free_lower(b.system.stiffness, part);
  EXPECT_LE(
      Cholesky(lower, "test", fewer.unknowns).entries_needed(),
      Cholesky(free_lower(b.system.stiffness, whole), "test", order.unknowns).entries_needed());
}

}  // namespace
}  // namespace hyperex::fem
