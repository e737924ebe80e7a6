// SPDX-License-Identifier: GPL-3.0-or-later
// A time step must not allocate memory. Calls are counted in malloc itself, which Eigen, the
// standard library and CHOLMOD all use. Not tested where a sanitizer replaces malloc.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "hyperex/fem/solve/cholesky.hpp"
#include "hyperex/fem/solve/partition.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"
#include "support/sanitizers.hpp"

#if defined(__GLIBC__) && !HYPEREX_SANITIZED
#define HYPEREX_COUNTS_ALLOCATIONS 1

namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : 12;  // ENOMEM
}
}
#endif

namespace hyperex::fem {
namespace {

#ifdef HYPEREX_COUNTS_ALLOCATIONS

long allocated_by(const std::function<void()>& action) {
  // TBB fills the pools of each of its threads at its own time: the best of several.
  long least = -1;
  for (int run = 0; run < 20; ++run) {
    const long before = allocations.load();
    for (int i = 0; i < 10; ++i) action();
    const long made = allocations.load() - before;
    if (least < 0 || made < least) least = made;
  }
  return least;
}

TEST(Allocations, AreCounted) {
  Eigen::VectorXd v;
  int n = 100;
  EXPECT_GE(allocated_by([&] { v = Eigen::VectorXd::Zero(++n); }), 10) << "by Eigen";
  std::vector<int*> kept;
  kept.reserve(1000);
  EXPECT_GE(allocated_by([&] { kept.push_back(new int(3)); }), 10) << "by new";
  for (const int* p : kept) delete p;
}

TEST(Allocations, NoneInAStepOrASolve) {
  const auto box = test::box_mesh({12, 11, 4}, Vec3(0.12, 0.11, 0.04), 0.1);
  const System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4_star);
  const auto held = test::unknowns_where(box.nodes, [](const Vec3& p) { return p.z() < 1e-9; });
  const auto count = static_cast<Eigen::Index>(held.size());
  Newmark newmark(s, held, {2e-3});
  const Eigen::VectorXd given = 1e-3 * test::random_vector(count, 1);
  const Kinematics all{given, given, given};
  const Eigen::VectorXd force = test::random_vector(s.mass.cols(), 2);
  EXPECT_EQ(allocated_by([&] { newmark.step(all); }), 0);
  EXPECT_EQ(allocated_by([&] { newmark.step(all, force); }), 0);
  EXPECT_EQ(allocated_by([&] { newmark.step(given); }), 0);
  EXPECT_EQ(allocated_by([&] { newmark.step(given, force); }), 0);

  const SparseMatrix lower =
      free_lower(s.stiffness, Partition(static_cast<int>(s.mass.cols()), held));
  Cholesky cholesky(lower, "test");
  cholesky.factorize(lower);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(lower.cols());
  EXPECT_EQ(allocated_by([&] { cholesky.solve(x); }), 0);
}

TEST(Allocations, NoneInAStepAtFiniteStrain) {
  const auto box = test::box_mesh({8, 7, 4}, Vec3(0.08, 0.07, 0.04), 0.1);
  const Assembler assembler(box.nodes, box.tets, ElementKind::tet4_star);
  Hyperelastic law;
  law.branches = {{0.5, 0.05}};
  FiniteStrain form(assembler, test::varied_material(box.tets.rows()), law);
  const auto held = test::unknowns_where(box.nodes, [](const Vec3& p) { return p.z() < 1e-9; });
  const auto n = box.nodes.size();
  SparseMatrix springs(n, n);
  springs.insert(n - 1, n - 1) = 3;
  springs.makeCompressed();
  FiniteNewton newton(form, held, {}, springs);
  const Eigen::VectorXd up = 1e-4 * test::random_vector(static_cast<Eigen::Index>(held.size()), 1);
  const Eigen::VectorXd force = 0.01 * test::random_vector(n, 2);
  double sign = 1;
  Eigen::VectorXd to = up;
  newton.step(0.01, to, force);
  EXPECT_EQ(allocated_by([&] {
              sign = -sign;
              to = sign * up;
              newton.step(0.01, to, force);
            }),
            0);
  EXPECT_EQ(allocated_by([&] { newton.equilibrium(to, force); }), 0);
}

#else
TEST(Allocations, AreCounted) {
  GTEST_SKIP() << "malloc is not ours to count here";
}
#endif

}  // namespace
}  // namespace hyperex::fem
