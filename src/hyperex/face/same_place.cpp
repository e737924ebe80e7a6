// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/same_place.hpp"

#include <map>

namespace hyperex::face {

std::string other_name(const std::string& name) {
  static const std::map<std::string, std::string> both = [] {
    std::map<std::string, std::string> table;
    for (const auto& [anatomical, ibug] : {std::pair{"exocanthion_R", "ibug68_36"},
                                           {"exocanthion_L", "ibug68_45"},
                                           {"endocanthion_R", "ibug68_39"},
                                           {"endocanthion_L", "ibug68_42"},
                                           {"pronasale", "ibug68_30"},
                                           {"subnasale", "ibug68_33"},
                                           {"cheilion_R", "ibug68_48"},
                                           {"cheilion_L", "ibug68_54"},
                                           {"crista_philtri_inferior_R", "ibug68_50"},
                                           {"crista_philtri_inferior_L", "ibug68_52"},
                                           {"labiale_superius", "ibug68_51"},
                                           {"labiale_inferius", "ibug68_57"}}) {
      table[anatomical] = ibug;
      table[ibug] = anatomical;
    }
    return table;
  }();
  const auto found = both.find(name);
  return found == both.end() ? std::string() : found->second;
}

bool same_place(const std::string& a, const std::string& b) {
  return !b.empty() && other_name(a) == b;
}

}  // namespace hyperex::face
