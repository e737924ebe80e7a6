// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/find_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hyperex::ct {
namespace {

constexpr double kStep_m = 5e-4, kFlat_m = 3e-4, kPatch_m = 0.015;
constexpr double kFromEnds_m = 0.01, kMiddleOfFace_m = 0.03, kMidline_m = 2e-3;
constexpr double kNoseToLip_m = 0.03, kRootLow_m = 0.018, kRootHigh_m = 0.075;
constexpr double kChin_m = 0.03, kFrontOfJaw_m = 0.025, kMiddleOfJaw_m = 0.012,
                 kChinOfBone_m = 0.02, kFromEndOfJaw_m = 2e-3;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// How far forward the skin is, seen from the front.
class FrontView {
 public:
  FrontView(const Volume& head, double skin_hu, const TriMesh& skin)
      : head_(head), skin_hu_(skin_hu), front_(skin.points.col(2).maxCoeff() + 2e-3) {}

  /// z of the first skin at (x, y), or NaN within `depth_m`.
  double forward(double x, double y, double depth_m = 0.08) const {
    double before = kNone;
    for (double z = front_; z > front_ - depth_m; z -= kStep_m) {
      const double value = head_.sample({x, y, z});
      if (value >= skin_hu_)
        return std::isnan(before) ? z : z + kStep_m * (value - skin_hu_) / (value - before);
      before = value;
    }
    return kNone;
  }
  /// Mean over the width of the midline.
  double on_midline(double x, double y) const {
    double sum = 0;
    int count = 0;
    for (double dx = -kMidline_m; dx <= kMidline_m + 1e-9; dx += 1e-3)
      if (const double z = forward(x + dx, y); !std::isnan(z)) sum += z, ++count;
    return count == 0 ? kNone : sum / count;
  }

 private:
  const Volume& head_;
  double skin_hu_, front_;
};

/// The middle of the patch around `at` (x, y) that is nearly as far forward as `z`.
Vec3 middle_of_patch(const FrontView& view, const Vec3& at) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (double x = at.x() - kPatch_m; x <= at.x() + kPatch_m; x += kStep_m)
    for (double y = at.y() - kPatch_m; y <= at.y() + kPatch_m; y += kStep_m)
      if (const double z = view.forward(x, y, 0.03); z >= at.z() - kFlat_m)
        sum += Vec3(x, y, z), ++count;
  return count == 0 ? at : Vec3(sum / count);
}

Vec3 pronasale_of(const FrontView& view, const TriMesh& skin, double middle_x) {
  Eigen::Index best = -1;
  for (Eigen::Index v = 0; v < skin.points.rows(); ++v)
    if (std::abs(skin.points(v, 0) - middle_x) <= kMiddleOfFace_m &&
        (best < 0 || skin.points(v, 2) > skin.points(best, 2)))
      best = v;
  if (best < 0) return Vec3::Constant(kNone);
  const Vec3 most = skin.points.row(best).transpose();
  // Where the scan ends there, the face goes on outside it, and its nose may too.
  if (most.y() > skin.points.col(1).maxCoeff() - kFromEnds_m ||
      most.y() < skin.points.col(1).minCoeff() + kFromEnds_m)
    return Vec3::Constant(kNone);
  return middle_of_patch(view, most);
}

/// The heights and forward places of a stretch of the midline.
struct Profile {
  std::vector<double> y, z;
};

Profile profile_of(const FrontView& view, double x, double from_y, double to_y) {
  Profile out;
  for (double y = from_y; y <= to_y; y += kStep_m)
    if (const double z = view.on_midline(x, y); !std::isnan(z))
      out.y.push_back(y), out.z.push_back(z);
  return out;
}

/// The deepest point, unless it is an end.
std::optional<Vec3> deepest_of(const Profile& profile, double x) {
  if (profile.z.size() < 3) return std::nullopt;
  const auto at = std::min_element(profile.z.begin(), profile.z.end()) - profile.z.begin();
  if (at == 0 || at + 1 == std::ptrdiff_t(profile.z.size())) return std::nullopt;
  return Vec3(x, profile.y[std::size_t(at)], profile.z[std::size_t(at)]);
}

/// The first place, upwards, from which the profile does not rise over the next 4 mm, or else where
/// it rises least; then the middle of the stretch that is as far forward.
std::optional<double> height_of_chin(const Profile& profile) {
  const auto ahead = std::size_t(4e-3 / kStep_m);
  if (profile.z.size() < 2 * ahead) return std::nullopt;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + ahead < profile.z.size(); ++i) {
    const double rise = profile.z[i + ahead] - profile.z[i];
    if (rise < least) least = rise, best = i + ahead / 2;
    if (rise <= 0) break;
  }
  std::size_t low = best, high = best;
  while (low > 0 && std::abs(profile.z[low - 1] - profile.z[best]) <= kFlat_m) --low;
  while (high + 1 < profile.z.size() && std::abs(profile.z[high + 1] - profile.z[best]) <= kFlat_m)
    ++high;
  return (profile.y[low] + profile.y[high]) / 2;
}

/// The most forward place at one height, in the middle of those nearly as far forward.
Vec3 most_forward_at(const FrontView& view, double middle_x, double y) {
  double highest = -std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> row;
  for (double x = middle_x - kMiddleOfJaw_m; x <= middle_x + kMiddleOfJaw_m; x += kStep_m)
    if (const double z = view.forward(x, y); !std::isnan(z))
      row.emplace_back(x, z), highest = std::max(highest, z);
  double sum_x = 0, sum_z = 0, count = 0;
  for (const auto& [x, z] : row)
    if (z >= highest - kFlat_m) sum_x += x, sum_z += z, ++count;
  return count > 0 ? Vec3(sum_x / count, y, sum_z / count) : Vec3::Constant(kNone);
}

double front_of_jaw_m(const TriMesh& mandible) {
  return mandible.points.col(2).maxCoeff() - kFrontOfJaw_m;
}

/// The lowest vertex of the front of the jaw, at most `half_m` beside the middle.
std::optional<Vec3> lowest_in_front(const TriMesh& mandible, double middle_x, double half_m) {
  const double front = front_of_jaw_m(mandible);
  Eigen::Index best = -1;
  for (Eigen::Index v = 0; v < mandible.points.rows(); ++v)
    if (mandible.points(v, 2) >= front && std::abs(mandible.points(v, 0) - middle_x) <= half_m &&
        (best < 0 || mandible.points(v, 1) < mandible.points(best, 1)))
      best = v;
  if (best < 0) return std::nullopt;
  return Vec3(mandible.points.row(best).transpose());
}

/// Menton and pogonion of the midline: beside it the jaw's lower edge may hang lower.
void take_points_of_bone(FoundPoints& out, const TriMesh& mandible, double middle_x) {
  const auto menton = lowest_in_front(mandible, middle_x, kMidline_m);
  if (!menton) return;
  // At the end of the range the bone goes on downwards behind it.
  if (menton->z() > front_of_jaw_m(mandible) + kFromEndOfJaw_m) out.bone_menton_m = menton;
  Eigen::Index best = -1;
  for (Eigen::Index v = 0; v < mandible.points.rows(); ++v)
    if (std::abs(mandible.points(v, 0) - middle_x) <= kMidline_m &&
        mandible.points(v, 1) <= menton->y() + kChinOfBone_m &&
        (best < 0 || mandible.points(v, 2) > mandible.points(best, 2)))
      best = v;
  out.bone_pogonion_m = mandible.points.row(best).transpose();
}

}  // namespace

FoundPoints find_points(const Volume& head, double skin_hu, const TriMesh& skin,
                        const TriMesh& mandible) {
  FoundPoints out;
  if (skin.points.rows() == 0) return out;
  const bool jaw = mandible.points.rows() > 0;
  const auto middle = [](const TriMesh& mesh) {
    return (mesh.points.col(0).minCoeff() + mesh.points.col(0).maxCoeff()) / 2;
  };
  const FrontView view(head, skin_hu, skin);
  const Vec3 nose = pronasale_of(view, skin, middle(jaw ? mandible : skin));
  if (!nose.allFinite()) return out;
  out.skin["pronasale"] = nose;
  if (const auto at =
          deepest_of(profile_of(view, nose.x(), nose.y() - kNoseToLip_m, nose.y()), nose.x()))
    out.skin["subnasale"] = *at;
  if (const auto at = deepest_of(
          profile_of(view, nose.x(), nose.y() + kRootLow_m, nose.y() + kRootHigh_m), nose.x()))
    out.skin["nasion"] = *at;
  if (!jaw) return out;
  const double middle_x = middle(mandible);
  const auto lowest = lowest_in_front(mandible, middle_x, kMiddleOfJaw_m);
  if (!lowest) return out;
  const double low_y = lowest->y();
  take_points_of_bone(out, mandible, middle_x);
  const Profile chin = profile_of(view, middle_x, low_y, low_y + kChin_m);
  if (const auto y = height_of_chin(chin)) {
    const Vec3 at = most_forward_at(view, middle_x, *y);
    if (at.allFinite()) out.skin["pogonion"] = at;
  }
  return out;
}

}  // namespace hyperex::ct
