// SPDX-License-Identifier: GPL-3.0-or-later
// Mutated inputs of every format, handed to the readers in this process: taken, or refused with a
// sound message, within time and memory. HYPEREX_MUTATIONS sets how many a format.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "fuzz/mutate.hpp"
#include "fuzz/readers.hpp"
#include "support/test_file.hpp"

namespace hyperex::fuzz {
namespace {
namespace fs = std::filesystem;

constexpr double kLongest_s = 30;
constexpr long kMostMemory_kB = 2L << 20;

std::uint64_t mutations() {
  const char* text = std::getenv("HYPEREX_MUTATIONS");
  return text == nullptr ? 150 : std::strtoull(text, nullptr, 10);
}

class Mutated : public testing::TestWithParam<Reader> {
 protected:
  const TestFolder folder_;
};

TEST_P(Mutated, InputsAreTakenOrRefusedInOneClearLine) {
  const Reader& reader = GetParam();
  std::uint64_t taken = 0;
  double longest_s = 0;
  for (std::uint64_t number = 0; number < mutations(); ++number) {
    const auto start = std::chrono::steady_clock::now();
    try {
      taken += try_input(reader, folder_, mutated(reader.seeds, number));
    } catch (const std::exception& error) {
      ADD_FAILURE() << reader.name << ", input " << number << ": " << error.what();
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    longest_s = std::max(longest_s, seconds.count());
    ASSERT_LT(seconds.count(), kLongest_s) << reader.name << ", input " << number;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, kMostMemory_kB);
  std::printf("%s: %llu inputs, %llu taken, the slowest %.2f s, %ld MiB\n", reader.name.c_str(),
              static_cast<unsigned long long>(mutations()), static_cast<unsigned long long>(taken),
              longest_s, usage.ru_maxrss / 1024);
}

TEST_P(Mutated, StartFromInputsThatAreSound) {
  const Reader& reader = GetParam();
  // A picture is read as colour and as depth, which no picture is both.
  const bool can_be_taken = reader.name != "picture";
  int taken = 0;
  for (const std::string& seed : reader.seeds) taken += try_input(reader, folder_, seed);
  if (can_be_taken) {
    EXPECT_GE(taken, 1) << reader.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Reader, Mutated, testing::ValuesIn(readers()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hyperex::fuzz
