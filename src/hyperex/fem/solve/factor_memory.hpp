// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::fem {

/// What a Cholesky factor will take, by the analysis of its pattern.
struct FactorForecast {
  double entries = 0;  ///< of L, without the zeros that supernodes add
  double flops = 0;
  double matrix_entries = 0;  ///< of the lower triangle
};

/// CHOLMOD counts a factor's entries in 32 bits.
inline constexpr double kMostFactorEntries = 2147483647.0;
/// Stored over needed entries of a supernodal factor of soft tissue: 1.21 to 1.15 measured from
/// 5,000 to 250,000 nodes.
inline constexpr double kStoredShare = 1.2;
/// Stack of the multifrontal method over the factor: 0.70, 0.53 and 0.39 of it measured at 6,000,
/// 24,000 and 100,000 nodes.
inline constexpr double kStackShare = 0.5;
/// Bytes for an entry of the matrix: where it goes in the factor.
inline constexpr double kWorkspaceBytes = 8;
/// Share of the available memory that the factor and its workspace may take.
inline constexpr double kFactorShare = 0.95;

/// Memory for the factor and for computing it.
double factor_bytes(const FactorForecast& forecast);

/// Throws NumericalError, in one sentence with the figures, where the factor would have more than
/// kMostFactorEntries entries or would take more than kFactorShare of `available_bytes`. `purpose`
/// begins the sentence: "static solution: ...".
void check_factor_fits(const FactorForecast& forecast, double available_bytes,
                       const std::string& purpose);

/// MemAvailable of /proc/meminfo, or less where a control group or a limit on the address space
/// grants less; 4 GiB where none of them is known.
double available_memory_bytes();

}  // namespace hyperex::fem
