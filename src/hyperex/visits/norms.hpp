// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/visits/expression_peak.hpp"

namespace hyperex::visits {

/// How far healthy adults move a part of the face as strongly as they can.
struct Norm {
  Expression::Movement movement = Expression::Movement::corners;
  const char* part;         ///< "corner of the mouth"
  double mean_mm = 0;       ///< from rest
  double deviation_mm = 0;  ///< standard deviation between people
  int people = 0;
  const char* source;
};

/// Published, by markers on the skin.
const std::vector<Norm>& norms();

/// Nothing where no norm is known.
const Norm* norm_of(const Expression& expression);

}  // namespace hyperex::visits
