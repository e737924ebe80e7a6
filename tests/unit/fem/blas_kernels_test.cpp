// SPDX-License-Identifier: GPL-3.0-or-later
// A processor newer than OpenBLAS gets kernels for its vector instructions.
#include "hyperex/core/blas_kernels.hpp"

#include <cblas.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

extern "C" char* openblas_get_corename(void);

namespace hyperex {
namespace {

class BlasKernels : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* chosen = std::getenv("OPENBLAS_CORETYPE")) chosen_before_ = chosen;
    ::unsetenv("OPENBLAS_CORETYPE");
    // The kernels that OpenBLAS chooses for a processor that it does not know.
    if (!take_blas_kernels("Prescott") || std::string(openblas_get_corename()) != "Prescott")
      GTEST_SKIP() << "this OpenBLAS has no other kernels";
  }
  void TearDown() override {
    ::unsetenv("OPENBLAS_CORETYPE");
    if (!chosen_before_) {
      choose_blas_kernels();
      return;
    }
    take_blas_kernels(*chosen_before_);
    ::setenv("OPENBLAS_CORETYPE", chosen_before_->c_str(), 1);
  }

 private:
  std::optional<std::string> chosen_before_;  ///< Where whoever runs the tests has chosen.
};

TEST_F(BlasKernels, OfAnUnknownProcessorAreThoseThatItCanRun) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "the fallback is all that it can run";
  const std::string expected = __builtin_cpu_supports("avx512dq") ? "SkylakeX" : "Haswell";
  EXPECT_EQ(choose_blas_kernels(), expected);
  EXPECT_FALSE(std::getenv("OPENBLAS_CORETYPE")) << "programs started from here choose themselves";
#endif
  constexpr int n = 60;
  const std::vector<double> a(n * n, 1.5), b(n * n, 2);
  std::vector<double> product(n * n);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1, a.data(), n, b.data(), n, 0,
              product.data(), n);
  for (const double value : product) ASSERT_EQ(value, 3 * n);
}

TEST_F(BlasKernels, ThatTheUserHasChosenStay) {
  ::setenv("OPENBLAS_CORETYPE", "Prescott", 1);
  EXPECT_EQ(choose_blas_kernels(), "Prescott");
  EXPECT_STREQ(openblas_get_corename(), "Prescott");
}

}  // namespace
}  // namespace hyperex
