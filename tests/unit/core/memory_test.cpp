// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/memory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "support/resident_memory.hpp"

namespace hyperex {
namespace {

TEST(FreedMemory, IsGivenBackToTheSystem) {
  if (!test::keep_freed_memory()) GTEST_SKIP() << "another allocator";
  const double before = test::resident_mib();
  std::vector<std::unique_ptr<std::vector<char> > > held;
  for (int i = 0; i < 2000; ++i) held.push_back(std::make_unique<std::vector<char> >(100000, 'x'));
  const auto last = std::make_unique<std::vector<char> >(100000, 'x');  // the heap cannot shrink
  held.clear();
  EXPECT_GT(test::resident_mib(), before + 150);
  give_back_freed_memory();
  EXPECT_LT(test::resident_mib(), before + 20);
}

}  // namespace
}  // namespace hyperex
