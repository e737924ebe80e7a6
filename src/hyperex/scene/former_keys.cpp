// SPDX-License-Identifier: GPL-3.0-or-later
// Names that are no longer keys or never were, and what to use instead.
#include <map>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
namespace {
/// Keys of earlier scene files, and their present names.
const std::map<std::string, std::string> renamed_keys = {
    {"output.contact_times_s", "output.picture_times_s"},
    {"support.muscle_kpa_per_mm", "support.field_kpa_per_mm"}};
/// Keys of earlier scene files that have no successor, and why.
const std::map<std::string, std::string> removed_keys = {
    {"solver.linear",
     "no such key: it was removed, as Cholesky factorisation is the only way left"}};
/// Constants of a law in kPa that follow from existing keys, and which keys to use instead.
const std::map<std::string, std::string> derived_keys = {
    {"yeoh_c10", "tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"yeoh_c20", "tissue.yeoh_c20 = C20 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"yeoh_c30", "tissue.yeoh_c30 = C30 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"mooney_c10", "tissue.young_kpa = 4 (1 + tissue.poisson) (C10 + C01)"},
    {"mooney_c01",
     "tissue.mooney_c01 = C01 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) "
     "(C10 + C01)"},
    {"shear", "tissue.young_kpa = 2 (1 + tissue.poisson) mu"},
    {"mu", "tissue.young_kpa = 2 (1 + tissue.poisson) mu"},
    {"bulk", "tissue.poisson = (3 K - E) / (6 K), with E the tissue.young_kpa"}};

/// Finds "yeoh_c10" for "tissue.yeoh_c10_kpa" and for "tissue.c10".
std::string derived_key(const std::string& name) {
  if (section_of(name) != "tissue") return {};
  std::string stem = name.substr(7);
  for (const char* ending : {"_modulus", "_kpa", "_pa", "_modulus"})
    if (stem.ends_with(ending)) stem.erase(stem.size() - std::string(ending).size());
  if (stem == "c10" || stem == "c20" || stem == "c30") stem = "yeoh_" + stem;
  if (stem == "c01") stem = "mooney_c01";
  const auto derived = derived_keys.find(stem);
  return derived == derived_keys.end() ? std::string() : derived->second;
}
}  // namespace

std::string in_place_of(const std::string& name) {
  if (const auto renamed = renamed_keys.find(name); renamed != renamed_keys.end())
    return "its new name: " + name + " is now " + renamed->second;
  if (const auto removed = removed_keys.find(name); removed != removed_keys.end())
    return removed->second;
  if (const std::string derived = derived_key(name); !derived.empty())
    return "what it follows from: " + derived;
  return {};
}

}  // namespace hyperex::scene
