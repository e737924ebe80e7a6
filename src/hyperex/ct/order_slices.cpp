// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/order_slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"

namespace hyperex::ct {
namespace {

constexpr double kSameStep_mm = 0.01, kSameDirection = 1e-3, kUneven = 0.1;
constexpr double kSamePlace = 0.1;  // of the step between slices
constexpr double kOffLine_mm = 0.3;

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
  throw InputError(source + ": " + why);
}

void check_alike(const std::vector<SlicePlace>& slices, const std::string& source) {
  if (int(slices.size()) < kLeastSlices)
    refuse(source, fmt::format("{} slice{} of a CT; expected at least {}, as a head has dozens",
                               slices.size(), slices.size() == 1 ? "" : "s", kLeastSlices));
  const SlicePlace& first = slices.front();
  for (const SlicePlace& s : slices) {
    if (s.rows != first.rows || s.columns != first.columns ||
        std::abs(s.row_step_mm - first.row_step_mm) > kSameStep_mm ||
        std::abs(s.column_step_mm - first.column_step_mm) > kSameStep_mm)
      refuse(source, fmt::format("slices of {} x {} and of {} x {} pixels, or of different pixel "
                                 "sizes, in one series; expected slices of one size",
                                 first.rows, first.columns, s.rows, s.columns));
    if ((s.along_row - first.along_row).norm() > kSameDirection ||
        (s.along_column - first.along_column).norm() > kSameDirection)
      refuse(source, "its slices are turned against each other; expected parallel slices");
  }
}

/// "z = 361.5": along the axis of the patient that the normal is nearest to.
class Named {
 public:
  explicit Named(const Vec3& normal) { normal.cwiseAbs().maxCoeff(&axis_); }
  std::string operator()(const Vec3& place_mm) const {
    return fmt::format("{} = {:.1f}", "xyz"[axis_], place_mm[axis_]);
  }

 private:
  int axis_ = 2;
};

void check_steps(const std::vector<SlicePlace>& slices, const std::vector<std::size_t>& order,
                 const std::vector<double>& along_mm, const Vec3& normal,
                 const std::string& source) {
  std::vector<double> steps(order.size() - 1);
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    steps[i] = along_mm[order[i + 1]] - along_mm[order[i]];
  const double usual = median(steps);
  const Named named(normal);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string from = named(slices[order[i]].first_mm),
                      to = named(slices[order[i + 1]].first_mm);
    if (steps[i] <= kSamePlace * usual || usual <= 0)
      refuse(source, fmt::format("two slices at one place ({} mm); expected one series of slices, "
                                 "each at its own place",
                                 from));
    const double missing = std::round(steps[i] / usual) - 1;
    if (missing >= 1 && std::abs(steps[i] / usual - missing - 1) < kUneven * (missing + 1))
      refuse(source,
             fmt::format("{:g} slice{} missing between {} and {} mm (a step of {:.2f} mm); "
                         "expected a slice every {:.2f} mm",
                         missing, missing == 1 ? " is" : "s are", from, to, steps[i], usual));
    if (std::abs(steps[i] - usual) > kUneven * usual)
      refuse(source,
             fmt::format("unevenly spaced: {:.2f} mm from {} to {} mm, elsewhere {:.2f} mm; "
                         "expected even steps",
                         steps[i], from, to, usual));
  }
}

/// The mean way from slice to slice; the slices must lie in one line.
Vec3 step_between(const std::vector<SlicePlace>& slices, const std::vector<std::size_t>& order,
                  const std::string& source) {
  const Vec3 first = slices[order.front()].first_mm;
  const Vec3 step = (slices[order.back()].first_mm - first) / double(order.size() - 1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double off = (slices[order[i]].first_mm - first - double(i) * step).norm();
    if (off > kOffLine_mm + kUneven * step.norm())
      refuse(source, fmt::format("a slice stands {:.1f} mm beside the line of the others; expected "
                                 "a stack along one line",
                                 off));
  }
  return step;
}

}  // namespace

SliceStack order_slices(const std::vector<SlicePlace>& slices, const std::string& source) {
  check_alike(slices, source);
  const SlicePlace& any = slices.front();
  const Vec3 normal = any.along_row.cross(any.along_column).normalized();
  std::vector<double> along_mm(slices.size());
  for (std::size_t i = 0; i < slices.size(); ++i) along_mm[i] = normal.dot(slices[i].first_mm);
  SliceStack out;
  out.order.resize(slices.size());
  std::iota(out.order.begin(), out.order.end(), std::size_t(0));
  std::stable_sort(out.order.begin(), out.order.end(),
                   [&](std::size_t a, std::size_t b) { return along_mm[a] < along_mm[b]; });
  check_steps(slices, out.order, along_mm, normal, source);
  const Vec3 step = step_between(slices, out.order, source);
  const double cosine = std::clamp(normal.dot(step.normalized()), -1.0, 1.0);
  out.tilt_deg = std::acos(cosine) * 180 / std::numbers::pi;
  out.grid.size = {any.columns, any.rows, int(slices.size())};
  out.grid.origin_m = face_from_patient() * slices[out.order.front()].first_mm * 1e-3;
  out.grid.step_m.col(0) = face_from_patient() * any.along_row * any.row_step_mm * 1e-3;
  out.grid.step_m.col(1) = face_from_patient() * any.along_column * any.column_step_mm * 1e-3;
  out.grid.step_m.col(2) = face_from_patient() * step * 1e-3;
  return out;
}

}  // namespace hyperex::ct
