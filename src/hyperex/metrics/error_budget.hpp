// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <limits>
#include <string>

namespace hyperex::metrics {

/// What the error of a printed figure comes from.
enum class ErrorPart {
  jitter,      ///< noise of the recorded points
  head_pose,   ///< of the pose that was taken out
  axes,        ///< directions of one recording against those of another
  landmarks,   ///< on the scan
  mesh,        ///< of the tissue
  muscles,     ///< where they lie, and how the work is shared among them
  inversion,   ///< forces that are found from points alone
  stiffness,   ///< of the tissue, relative to its support
  law,         ///< small or finite strain
  repetition,  ///< a person's own variation
};
inline constexpr std::array kErrorParts = {
    ErrorPart::jitter, ErrorPart::head_pose, ErrorPart::axes,      ErrorPart::landmarks,
    ErrorPart::mesh,   ErrorPart::muscles,   ErrorPart::inversion, ErrorPart::stiffness,
    ErrorPart::law,    ErrorPart::repetition};
/// "jitter", "head pose", ...
std::string name_of(ErrorPart part);

/// The error of one figure as a sum of independent parts. A variance that is estimated from n
/// samples has n degrees of freedom; one that is stated has infinitely many.
class ErrorBudget {
 public:
  /// `variance`: in the square of the figure's unit, 0 or more. A part that is added again has the
  /// sum of the variances and the lower of the degrees of freedom.
  void add(ErrorPart part, double variance,
           double freedom = std::numeric_limits<double>::infinity());
  /// Adds the errors of another figure, independent of this one's.
  ErrorBudget& operator+=(const ErrorBudget& other);
  /// The error of the figure times the root of `factor`.
  ErrorBudget& operator*=(double factor);
  ErrorBudget without(ErrorPart part) const;

  double variance() const;
  double variance(ErrorPart part) const { return parts_[std::size_t(part)].variance; }
  /// Half the width of the 95 % interval: Student's t for the degrees of freedom
  /// (sum v)^2 / sum (v^2 / n) of the parts' variances v (Welch 1947, Satterthwaite 1946).
  double half_width_95() const;
  /// A part of it: the squares of all parts sum to the square of the whole.
  double half_width_95(ErrorPart part) const;
  /// That with the greatest variance. Parts that are equal: the later in kErrorParts.
  ErrorPart largest() const;

 private:
  struct Part {
    double variance = 0, freedom = std::numeric_limits<double>::infinity();
  };
  double quantile() const;
  std::array<Part, kErrorParts.size()> parts_;
};

}  // namespace hyperex::metrics
