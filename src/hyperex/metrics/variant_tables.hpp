// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/metrics/variant_comparison.hpp"

namespace hyperex::metrics {

/// Writes a CSV with one row per run, base first: variant, the figures of VariantComparison (empty
/// if unknown), farthest_near, the pair of points for which lag and hysteresis are given, and
/// jitter_known (1 or 0). 0 is why a band of a corner is empty although the mesh's part is known.
void write_variants_csv(const std::filesystem::path& file, const VariantComparison& base,
                        const std::vector<VariantComparison>& compared, const ResponsePair& pair);

/// The excursions of a variant's run.
struct NamedExcursions {
  std::string name;
  const Excursions& excursions;  ///< of the same pairs as in base
};

/// Writes a CSV with one row per variant, pair of landmarks and side: the excursion in base and in
/// the variant, the change, its band, whether the change is larger than the band (change_of), and
/// whether the jitter is known (1 or 0). The band is empty where the jitter is not known.
void write_variant_excursions_csv(const std::filesystem::path& file, const Excursions& base,
                                  const std::vector<NamedExcursions>& variants);

/// A row of variants.csv with the same names; null if a figure is unknown.
nlohmann::ordered_json json_of(const VariantComparison& comparison);

}  // namespace hyperex::metrics
