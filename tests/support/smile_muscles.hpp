// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "hyperex/io/csv.hpp"

namespace hyperex::test {

/// The activations by name ("zyg_major_L") that a run wrote into its activations.csv, at the sample
/// in which all muscles together act most.
inline std::map<std::string, double> activations_at_most(const std::filesystem::path& csv) {
  const io::CsvTable table = io::read_csv(csv);
  std::map<std::string, int> muscles;
  for (std::size_t c = 0; c < table.names.size(); ++c)
    if (const std::string& name = table.names[c]; name.ends_with("_L") || name.ends_with("_R"))
      muscles[name] = int(c);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.values.rows());
  for (const auto& [name, column] : muscles) sum += table.values.col(column).cwiseAbs();
  Eigen::Index at = 0;
  sum.maxCoeff(&at);
  std::map<std::string, double> out;
  for (const auto& [name, column] : muscles) out[name] = table.values(at, column);
  return out;
}

/// A smile is made by the smile's muscle, on both sides, and not by the part of orbicularis oculi
/// that lies over the cheekbone.
inline void expect_zygomaticus_smiles(const std::filesystem::path& csv) {
  const auto activation = activations_at_most(csv);
  for (const std::string side : {"_L", "_R"}) {
    const double zygomaticus = activation.at("zyg_major" + side);
    EXPECT_GE(zygomaticus, 0.35) << side;
    EXPECT_GT(zygomaticus, activation.at("malaris" + side)) << side;
  }
}

}  // namespace hyperex::test
