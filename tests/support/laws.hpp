// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The hyperelastic laws that the tests use, with coefficients that make every term non-zero.
#include <string>
#include <vector>

#include "hyperex/fem/material/hyperelastic.hpp"

namespace hyperex::test {

inline fem::Hyperelastic law_of(fem::HyperelasticLaw law) {
  fem::Hyperelastic h;
  h.law = law;
  h.c30 = 0.1;
  h.c01 = 0.3;
  return h;
}

inline std::vector<fem::Hyperelastic> all_laws() {
  std::vector<fem::Hyperelastic> laws;
  for (const fem::HyperelasticLaw law : fem::kHyperelasticLaws) laws.push_back(law_of(law));
  return laws;
}

/// All but `linear`.
inline std::vector<fem::Hyperelastic> finite_laws() {
  auto laws = all_laws();
  std::erase_if(laws, [](const auto& h) { return h.law == fem::HyperelasticLaw::linear; });
  return laws;
}

}  // namespace hyperex::test
