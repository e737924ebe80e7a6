// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sight.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

/// Two sheets of 20 mm that face upwards; the second is 5 mm above the first and half as wide.
TEST(BlockedShares, CountTheDirectionsInWhichSomethingStandsInTheWay) {
  const test::Sheet low = test::sheet_mesh({8, 8}, {0.02, 0.02}),
                    high = test::sheet_mesh({4, 8}, {0.01, 0.02},
                                            [](double, double) { return 0.005; });
  TriMesh both = low.mesh;
  const Eigen::Index points = both.points.rows(), triangles = both.triangles.rows();
  both.points.conservativeResize(points + high.mesh.points.rows(), 3);
  both.points.bottomRows(high.mesh.points.rows()) = high.mesh.points;
  both.triangles.conservativeResize(triangles + high.mesh.triangles.rows(), 3);
  both.triangles.bottomRows(high.mesh.triangles.rows()) = high.mesh.triangles.array() + int(points);
  Points up_and_aside(2, 3);
  up_and_aside << 0, 0, 1, Vec3(1, 0, 0.2).normalized().transpose();
  const std::vector<int> vertices{low.vertex(2, 4), low.vertex(6, 4), int(points)};
  EXPECT_EQ(blocked_shares(both, vertices, up_and_aside, 0.03), (std::vector<double>{0.5, 0, 0}))
      << "under the upper sheet; beside it; on it";
  EXPECT_EQ(blocked_shares(both, vertices, up_and_aside.topRows(1), 0.004),
            (std::vector<double>{0, 0, 0}))
      << "5 mm are out of reach";
}

/// Limits this process to `more` bytes of address space beyond what it has.
void allow_no_more_than(std::size_t more) {
  std::size_t pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  const rlim_t most = pages * std::size_t(sysconf(_SC_PAGESIZE)) + more;
  const struct rlimit limit { most, most };
  if (pages == 0 || ::setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(9);
}

// Embree continues when it runs out of memory, with a mesh without buffers or without a tree.
TEST(BlockedSharesDeathTest, SayThatMemoryHasRunOut) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto blocked_within = [](std::size_t more) {
    const test::Sheet sheet = test::sheet_mesh({900, 900}, {0.2, 0.2});
    const Points up = Points::Constant(1, 3, 1);
    blocked_shares(test::sheet_mesh({8, 8}, {0.2, 0.2}).mesh, {0}, up, 0.1);  // Embree is there
    allow_no_more_than(more);
    try {
      blocked_shares(sheet.mesh, {0}, up, 0.1);
    } catch (const std::bad_alloc&) {
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  for (const std::size_t more : {4u << 20, 16u << 20, 32u << 20})
    EXPECT_EXIT(blocked_within(more), testing::ExitedWithCode(3), "") << more;
}

}  // namespace
}  // namespace hyperex
