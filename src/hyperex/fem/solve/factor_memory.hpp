// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::fem {

/// The predicted size of a Cholesky factor, from the analysis of its pattern.
struct FactorForecast {
  double entries = 0;  ///< of L, without the zeros that supernodes add
  double flops = 0;
  double matrix_entries = 0;  ///< in the lower triangle
};

/// CHOLMOD counts the entries of a factor with 32-bit integers.
inline constexpr double kMostFactorEntries = 2147483647.0;
/// Stored divided by needed entries of a supernodal factor of soft tissue. Measured: 1.21 to 1.15,
/// from 5,000 to 250,000 nodes.
inline constexpr double kStoredShare = 1.2;
/// Size of the multifrontal stack divided by that of the factor. Measured: 0.70, 0.53 and 0.39 at
/// 6,000, 24,000 and 100,000 nodes.
inline constexpr double kStackShare = 0.5;
/// Bytes per entry of the matrix, for its position in the factor.
inline constexpr double kWorkspaceBytes = 8;
/// Share of the available memory that the factor and its workspace may take.
inline constexpr double kFactorShare = 0.95;

/// Memory (bytes) for the factor and its computation.
double factor_bytes(const FactorForecast& forecast);

/// Throws NumericalError, in one sentence with the figures, if the factor would have more than
/// kMostFactorEntries entries or would take more than kFactorShare of `available_bytes`. The
/// sentence begins with `purpose`: "static solution: ...".
void check_factor_fits(const FactorForecast& forecast, double available_bytes,
                       const std::string& purpose);

/// MemAvailable of /proc/meminfo, or less if a control group or an address-space limit allows less.
/// 4 GiB if none of these is known.
double available_memory_bytes();

}  // namespace hyperex::fem
