// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Random numbers that depend on their seed alone. The C++ standard specifies the generator's bits
// but not those of its distributions, so that these are written here.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace hyperex::sample {

class Noise {
 public:
  explicit Noise(std::uint32_t seed) : bits_(seed) {}

  /// Uniform in (0, 1).
  double uniform() { return (double(bits_()) + 0.5) / 4294967296.0; }
  /// Normal, mean 0 and standard deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937 bits_;
};

}  // namespace hyperex::sample
