// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "support/muscle_twin.hpp"

namespace hyperex::bench {

/// How the true face differs from the face that the program assumes.
struct World {
  std::string name;
  double young_factor = 1;
  double lines_off_mm = 0;
};

/// Results for one world and one set of points, over several draws of noise, lines and expressions.
struct TwinRow {
  World world;
  std::size_t points = 0;
  std::vector<test::TwinAnswer> smiles, other_smiles, drawn;
};

struct Twins {
  std::vector<std::string> changes;
  int nodes = 0;
  std::vector<TwinRow> rows;
};

/// Runs all of them on the embedded face, with progress on standard error.
Twins run_twins(int draws);

/// docs/twins.md: every figure and every verdict comes from `twins`.
std::string twins_page(const Twins& twins, const std::string& commit, const std::string& machine);

}  // namespace hyperex::bench
