// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/error_budget.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "hyperex/core/within_95.hpp"

namespace hyperex::metrics {

std::string name_of(ErrorPart part) {
  static const std::array<const char*, kErrorParts.size()> names = {
      "jitter",  "head pose", "axes",      "landmarks", "mesh",
      "muscles", "inversion", "stiffness", "law",       "repetition"};
  return names[std::size_t(part)];
}

void ErrorBudget::add(ErrorPart part, double variance, double freedom) {
  Part& own = parts_[std::size_t(part)];
  own.variance += variance;
  own.freedom = std::min(own.freedom, freedom);
}

ErrorBudget& ErrorBudget::operator+=(const ErrorBudget& other) {
  for (const ErrorPart part : kErrorParts) {
    const Part& its = other.parts_[std::size_t(part)];
    add(part, its.variance, its.freedom);
  }
  return *this;
}

ErrorBudget& ErrorBudget::operator*=(double factor) {
  for (Part& part : parts_) part.variance *= factor;
  return *this;
}

ErrorBudget ErrorBudget::without(ErrorPart part) const {
  ErrorBudget out = *this;
  out.parts_[std::size_t(part)] = {};
  return out;
}

double ErrorBudget::variance() const {
  double sum = 0;
  for (const Part& part : parts_) sum += part.variance;
  return sum;
}

double ErrorBudget::quantile() const {
  double of_freedom = 0;
  for (const Part& part : parts_) of_freedom += part.variance * part.variance / part.freedom;
  if (!(of_freedom > 0)) return kWithin95;
  const double freedom = variance() * variance() / of_freedom;
  return boost::math::quantile(boost::math::students_t(freedom), 0.975);
}

double ErrorBudget::half_width_95() const {
  return quantile() * std::sqrt(variance());
}

double ErrorBudget::half_width_95(ErrorPart part) const {
  return quantile() * std::sqrt(variance(part));
}

ErrorPart ErrorBudget::largest() const {
  const auto most =
      std::max_element(kErrorParts.rbegin(), kErrorParts.rend(),
                       [&](ErrorPart a, ErrorPart b) { return variance(a) < variance(b); });
  return *most;
}

}  // namespace hyperex::metrics
