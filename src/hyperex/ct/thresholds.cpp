// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/thresholds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/core/error.hpp"

namespace hyperex::ct {
namespace {

constexpr int kLow = -1200, kHigh = 4000, kBin = 5;
constexpr double kLeastShare = 0.01;  // of all values: air, soft tissue
constexpr double kLeastBone_hu = 150, kMostBone_hu = 700, kFirstBone_hu = 300;
constexpr double kQuartilesToSigma = 1.349;

class Histogram {
 public:
  explicit Histogram(const std::vector<float>& values) : count_((kHigh - kLow) / kBin, 0) {
    for (const float v : values)
      if (!std::isnan(v)) {
        ++count_[std::size_t((std::clamp(v, float(kLow), float(kHigh - 1)) - kLow) / kBin)];
        ++all_;
      }
  }
  static double value_of(std::size_t bin) { return kLow + kBin * (double(bin) + 0.5); }
  static std::size_t bin_of(double hu) {
    return std::size_t((std::clamp(hu, double(kLow), double(kHigh - 1)) - kLow) / kBin);
  }
  double share(double low, double high) const {
    return all_ == 0 ? 0 : sum(bin_of(low), bin_of(high)) / double(all_);
  }
  /// The commonest value: the middle of the fullest window of five bins.
  double mode(double low, double high) const {
    std::size_t best = bin_of(low) + 2;
    for (std::size_t b = best; b + 3 < bin_of(high); ++b)
      if (sum(b - 2, b + 3) > sum(best - 2, best + 3)) best = b;
    double weighted = 0;
    for (std::size_t b = best - 2; b < best + 3; ++b) weighted += double(count_[b]) * value_of(b);
    return weighted / std::max(1.0, sum(best - 2, best + 3));
  }
  double mean(double low, double high) const {
    double weighted = 0;
    for (std::size_t b = bin_of(low); b < bin_of(high); ++b)
      weighted += double(count_[b]) * value_of(b);
    return weighted / std::max(1.0, sum(bin_of(low), bin_of(high)));
  }
  double quantile(double low, double high, double share) const {
    const double wanted = share * sum(bin_of(low), bin_of(high));
    double so_far = 0;
    for (std::size_t b = bin_of(low); b < bin_of(high); ++b)
      if ((so_far += double(count_[b])) >= wanted) return value_of(b);
    return high;
  }

 private:
  double sum(std::size_t from, std::size_t to) const {
    double out = 0;
    for (std::size_t b = from; b < to; ++b) out += double(count_[b]);
    return out;
  }
  std::vector<std::size_t> count_;
  std::size_t all_ = 0;
};

double half_way(const Histogram& histogram, double skin_hu) {
  double at = kFirstBone_hu;
  for (int k = 0; k < 100; ++k) {
    const double next = (histogram.mean(skin_hu, at) + histogram.mean(at, kHigh)) / 2;
    if (std::abs(next - at) < 0.1) break;
    at = next;
  }
  return std::round(std::clamp(at, kLeastBone_hu, kMostBone_hu));
}

double middle_of(std::vector<float> values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Values in units of their own: air is what lies below the skin's, soft tissue what lies between.
Thresholds of_given_values(const Volume& volume, double skin_hu, double bone_hu,
                           const std::string& source) {
  std::vector<float> air, soft;
  for (const float v : volume.hu) {
    if (v < skin_hu) air.push_back(v);
    if (v >= skin_hu && v < bone_hu) soft.push_back(v);
  }
  if (air.empty() || soft.empty())
    throw InputError(
        fmt::format("{}: --skin-hu = {:g}, --bone-hu = {:g}: expected values of the "
                    "volume below the first and between the two",
                    source, skin_hu, bone_hu));
  Thresholds out;
  out.is_hu = false;
  out.skin_given = true;
  out.skin_hu = skin_hu;
  out.air_hu = middle_of(air, 0.5);
  out.soft_hu = middle_of(soft, 0.5);
  out.noise_hu = (middle_of(soft, 0.75) - middle_of(soft, 0.25)) / kQuartilesToSigma;
  return out;
}

void check_range(const char* option, std::optional<double> hu, const Bounds& bounds) {
  if (hu && !bounds.holds(*hu))
    throw InputError(
        fmt::format("{} = {:g}: expected {} where the values are Hounsfield "
                    "units",
                    option, *hu, bounds.text()));
}

}  // namespace

Thresholds find_skin_threshold(const Volume& volume, const std::string& source,
                               std::optional<double> skin_hu, std::optional<double> bone_hu) {
  const Histogram histogram(volume.hu);
  const bool is_hu =
      histogram.share(-1100, -850) >= kLeastShare && histogram.share(-150, 200) >= kLeastShare;
  if (!is_hu && skin_hu && bone_hu && *skin_hu < *bone_hu)
    return of_given_values(volume, *skin_hu, *bone_hu, source);
  if (!is_hu)
    throw InputError(fmt::format(
        "{}: its values are no Hounsfield units (air about -1000, soft tissue about 40); expected "
        "a CT, as an MRI or another picture shows no bone to measure, or --skin-hu and a greater "
        "--bone-hu for a cone-beam CT in other units",
        source));
  check_range("--skin-hu", skin_hu, skin_hu_in);
  check_range("--bone-hu", bone_hu, bone_hu_in);
  Thresholds out;
  out.air_hu = histogram.mode(-1100, -850);
  out.soft_hu = histogram.mode(-150, 200);
  out.noise_hu = (histogram.quantile(-150, 200, 0.75) - histogram.quantile(-150, 200, 0.25)) /
                 kQuartilesToSigma;
  out.skin_given = skin_hu.has_value();
  out.skin_hu = skin_hu.value_or(std::round((out.air_hu + out.soft_hu) / 2));
  return out;
}

void find_bone_threshold(const Volume& body, Thresholds& thresholds,
                         std::optional<double> bone_hu) {
  thresholds.bone_given = bone_hu.has_value();
  thresholds.bone_hu = bone_hu ? *bone_hu : half_way(Histogram(body.hu), thresholds.skin_hu);
  if (thresholds.bone_hu <= thresholds.skin_hu)
    throw InputError(
        fmt::format("--bone-hu = {:g}: expected more than the value of the skin, {:g} HU",
                    thresholds.bone_hu, thresholds.skin_hu));
}

}  // namespace hyperex::ct
