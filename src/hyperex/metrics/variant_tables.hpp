// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/metrics/variant_comparison.hpp"

namespace hyperex::metrics {

/// CSV, a row a run, base first: variant, the figures of VariantComparison (empty where they are
/// not known), farthest_near, and the pair of points for which lag and hysteresis are reported.
void write_variants_csv(const std::filesystem::path& file, const VariantComparison& base,
                        const std::vector<VariantComparison>& compared, const ResponsePair& pair);

/// The excursions of a variant's run.
struct NamedExcursions {
  std::string name;
  const Excursions& excursions;  ///< of the pairs that base has
};

/// CSV, a row per variant, pair of landmarks and side: how far it travels in base and in the
/// variant, the change with its band and whether it is larger (change_of).
void write_variant_excursions_csv(const std::filesystem::path& file, const Excursions& base,
                                  const std::vector<NamedExcursions>& variants);

/// A row of variants.csv under the same names; null where a figure is not known.
nlohmann::ordered_json json_of(const VariantComparison& comparison);

}  // namespace hyperex::metrics
