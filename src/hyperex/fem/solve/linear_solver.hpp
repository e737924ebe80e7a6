// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::fem {

/// How A x = b is solved.
enum class LinearSolver {
  automatic,  ///< the first where its factor is small enough, else the second
  cholesky,   ///< supernodal factor of the whole matrix
  iterative   ///< conjugate gradients on overlapping subdomains
};

/// As in scene files.
constexpr std::string_view to_string(LinearSolver solver) {
  return solver == LinearSolver::automatic  ? "auto"
         : solver == LinearSolver::cholesky ? "cholesky"
                                            : "iterative";
}

/// What a Cholesky factor would take, by the analysis of its pattern.
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
/// Share of the memory available that factor and workspace may take. Where they fit, Cholesky is
/// the quicker (at 100,000 nodes 16 right-hand sides alone took the other one several times as long
/// as factorising), and so memory alone decides.
inline constexpr double kFactorShare = 0.95;

/// Never `automatic`: what `wanted` comes to for a factor as forecast, `available_bytes` of memory
/// being free. An explicit wish is granted, a factor beyond kMostFactorEntries excepted.
LinearSolver pick_linear_solver(LinearSolver wanted, const FactorForecast& forecast,
                                double available_bytes);

/// MemAvailable of /proc/meminfo, less where a control group or a limit on the address space grants
/// less; without any: 4 GiB.
double available_memory_bytes();

}  // namespace hyperex::fem
