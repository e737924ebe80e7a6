// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/symmetric_modes.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/rbf.hpp"

namespace hyperex::simulate {
namespace {

/// Skin this far above the brows does not move with them (ICT-FaceKit: 0.3 of 9 mm at 30 mm).
constexpr double forehead_m = 0.030;
constexpr double greatest_shift_m = 0.010;
/// How far the correction of a patch reaches from its point: farther gives smoother skin, but the
/// points of both lips' ends then work against each other.
constexpr double correction_reach_m = 0.016;
/// Points closer together than this are met in the mean alone: to meet each would fold the skin
/// between them, which has no nodes there.
constexpr double one_place_m = 0.001;
/// Over the kernel's value at 0: rounding, not a wish for smoothness.
constexpr double correction_ridge = 1e-4;
/// Difference of the walks to both lips at which a place counts as wholly above or below the mouth.
constexpr double full_margin_m = 0.010;
/// How far beyond a patch its hold falls from 1 to 0, where it fades. A patch that ends at once
/// leaves a step at its edge, which the skin of the chin shows (docs/muscles.md).
constexpr double fading_m = 0.020;

std::vector<int> patch_nodes(const std::vector<DrivenPoint>& points, std::size_t i,
                             const tissue::TissueMesh& mesh, double radius) {
  const int lip = anatomy::lip_of(points[i].name);
  const Points& skin = mesh.volume.outer.points;
  std::vector<int> hit;
  int nearest = -1;
  double least = 1;
  for (int v = 0; v < skin.rows(); ++v) {
    if (lip != 0 && (mesh.upper_margin[v] > 0) != (lip > 0)) continue;
    const double d = (skin.row(v).transpose() - points[i].rest).norm();
    if (d < least) {
      least = d;
      nearest = v;
    }
    if (d < radius) hit.push_back(v);
  }
  if (hit.empty() && nearest >= 0) hit.push_back(nearest);
  return hit;
}

/// Raises the holds (by node) over the patch of point i to those of this point. What a fading
/// patch has beyond `radius` lies on the lower face alone, without the border, which may be held.
/// The hold is C2 there.
void add_patch(const std::vector<DrivenPoint>& points, std::size_t i,
               const tissue::TissueMesh& mesh, double radius, bool fades,
               const CarrierMatrix& carriers, std::map<int, double>& holds) {
  const Points& skin = mesh.volume.outer.points;
  const auto add = [&](int v, double hold) {
    double& has = holds.emplace(v, 0).first->second;
    has = std::max(has, hold);
  };
  for (const int v : patch_nodes(points, i, mesh, fades ? radius + fading_m : radius)) {
    const double d = (skin.row(v).transpose() - points[i].rest).norm();
    const double t = std::clamp((d - radius) / fading_m, 0.0, 1.0);
    if (!fades || t == 0)
      add(v, 1);
    else if (t < 1 && mesh.upper_margin[std::size_t(v)] <= 0 && !mesh.on_border[std::size_t(v)])
      add(v, 1 - t * t * t * (10 - 15 * t + 6 * t * t));
  }
  for (CarrierMatrix::InnerIterator it(carriers, Eigen::Index(i)); it; ++it)
    add(static_cast<int>(it.col()), 1);
}

/// Wendland's C2 function of compact support, positive definite in three dimensions.
double wendland(double distance_m) {
  const double r = distance_m / correction_reach_m;
  return r < 1 ? std::pow(1 - r, 4) * (4 * r + 1) : 0;
}

/// The mean of each group of points within one_place_m of its first: |groups| x |points|.
Eigen::MatrixXd one_place_means(const Points& points) {
  std::vector<std::vector<Eigen::Index>> groups;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& some) {
      return (points.row(some.front()) - points.row(i)).norm() < one_place_m;
    });
    if (group == groups.end())
      groups.push_back({i});
    else
      group->push_back(i);
  }
  Eigen::MatrixXd mean =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(groups.size()), points.rows());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Eigen::Index i : groups[g])
      mean(static_cast<Eigen::Index>(g), i) = 1.0 / static_cast<double>(groups[g].size());
  return mean;
}

/// A regularised inverse of a Gram matrix. An eigenvalue is inverted as it is where it exceeds that
/// of two points one_place_m apart. The inverse of a smaller one falls to 0 with it. Around holes
/// the simulated surface ends before the skin does, so that points well apart may be carried by the
/// same nodes. Meeting each of them exactly would tear the skin around them.
Eigen::MatrixXd bounded_inverse(const Eigen::MatrixXd& gram) {
  const double least = 1 - wendland(one_place_m);
  const SymmetricModes modes = symmetric_modes(gram);
  const Eigen::VectorXd inverse = modes.values.unaryExpr([&](double value) {
    return value > least ? 1 / (value + correction_ridge)
                         : std::max(value, 0.0) / least / (least + correction_ridge);
  });
  return modes.vectors * inverse.asDiagonal() * modes.vectors.transpose();
}

/// Adds to the weights W what makes the driven places A W = 1, smoothly: with S the kernel between
/// nodes and G the means of one_place_means(), of the opened points,
///   W + S (G A)' (G A S (G A)')^-1 G (1 - A W), with bounded_inverse().
void meet_points(const Points& opened_points, const Points& opened, DrivenPatches& patches) {
  const auto count = static_cast<Eigen::Index>(patches.nodes.size());
  const Eigen::MatrixXd mean = one_place_means(opened_points);
  const Eigen::MatrixXd a = mean * Eigen::MatrixXd(patches.carriers)(Eigen::all, patches.nodes);
  Eigen::MatrixXd kernel(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index k = 0; k <= j; ++k)
      kernel(j, k) = kernel(k, j) = wendland((opened.row(j) - opened.row(k)).norm());
  const Eigen::MatrixXd reach = kernel * a.transpose();
  const Eigen::MatrixXd missing = mean - a * patches.weights;
  patches.weights += reach * (bounded_inverse(a * reach) * missing);
}

}  // namespace

DriveField::DriveField(std::vector<DrivenPoint> points, const std::vector<Vec3>& still,
                       const tissue::TissueMesh& mesh, const Vec3& up, double mouth_shift_m)
    : points_(std::move(points)), shift_(mouth_shift_m * up) {
  const Points& skin = mesh.volume.outer.points;
  // The margin of the nearest node, of a lip's point on that lip.
  const auto margin_at = [&](const Vec3& p, int lip) {
    double least = 1, margin = 0;
    for (int v = 0; v < skin.rows(); ++v) {
      if (lip != 0 && (mesh.upper_margin[v] > 0) != (lip > 0)) continue;
      if (const double d = (skin.row(v).transpose() - p).norm(); d < least) {
        least = d;
        margin = mesh.upper_margin[v];
      }
    }
    return margin;
  };
  const auto row_of = [&](int k) {
    const auto at = std::find_if(points_.begin(), points_.end(),
                                 [&](const DrivenPoint& p) { return p.name == face::ibug(k); });
    return at == points_.end() ? -1 : int(at - points_.begin());
  };
  std::vector<Vec3> forehead;
  for (const int k : {17, 19, 21, 22, 24, 26})
    if (const int brow = row_of(k); brow >= 0)
      forehead.push_back(points_[std::size_t(brow)].rest + forehead_m * up);
  for (const int k : {0, 16, 27})
    if (const int row = row_of(k); row >= 0) forehead_follows_.push_back(row);
  forehead_ = Eigen::Index(forehead.size());
  centres_.resize(Eigen::Index(points_.size() + forehead.size() + still.size()), 3);
  Eigen::Index row = 0;
  for (const DrivenPoint& p : points_)
    centres_.row(row++) = opened(p.rest, margin_at(p.rest, anatomy::lip_of(p.name))).transpose();
  for (const Vec3& p : forehead) centres_.row(row++) = opened(p, full_margin_m).transpose();
  for (const Vec3& p : still) centres_.row(row++) = opened(p, margin_at(p, 0)).transpose();
}

Vec3 DriveField::opened(const Vec3& p, double margin) const {
  return p + std::clamp(margin / full_margin_m, -1.0, 1.0) * shift_;
}

double DriveField::openness() const {
  return std::min(1.0, shift_.norm() / greatest_shift_m);
}

Eigen::MatrixXd DriveField::weights(const Points& places, const std::vector<double>& margin) const {
  Points at(places.rows(), 3);
  for (Eigen::Index j = 0; j < at.rows(); ++j)
    at.row(j) = opened(places.row(j), margin[j]).transpose();
  const auto count = static_cast<Eigen::Index>(points_.size());
  const Eigen::MatrixXd all = rbf_weights(centres_, count + forehead_, at);
  Eigen::MatrixXd out = all.leftCols(count);
  const Eigen::VectorXd of_forehead = all.rightCols(forehead_).rowwise().sum();
  for (const int row : forehead_follows_)
    out.col(row) += of_forehead / double(forehead_follows_.size());
  return out;
}

double lip_parting(const AlignedMotion& motion, const std::vector<int>& driven_rows,
                   const Vec3& up) {
  double most = 0;
  for (const Points& at : motion.motion.positions) {
    double height[2] = {0, 0};  // lower, upper
    int count[2] = {0, 0};
    for (int row : driven_rows)
      if (const int lip = anatomy::lip_of(motion.motion.names[row]); lip != 0) {
        height[lip > 0] += up.dot(at.row(row) - motion.rest.row(row));
        ++count[lip > 0];
      }
    if (count[0] == 0 || count[1] == 0) return 0;
    most = std::max(most, height[1] / count[1] - height[0] / count[0]);
  }
  return std::min(greatest_shift_m, most / 2);
}

std::vector<Vec3> still_places(const std::vector<DrivenPoint>& points,
                               const io::Landmarks& landmarks) {
  const auto drives = [&](const std::string& name) {
    return std::any_of(points.begin(), points.end(),
                       [&](const DrivenPoint& p) { return p.name == name; });
  };
  std::vector<Vec3> still;
  for (int k = 0; k < 48; ++k) {
    if (k > 3 && k < 13) continue;
    const std::string name = face::ibug(k);
    if (!drives(name) && landmarks.count(name)) still.push_back(landmarks.at(name));
  }
  return still;
}

void check_on_skin(const std::vector<DrivenPoint>& points, const TriMesh& skin,
                   const std::string& source) {
  constexpr double off_skin_m = 0.025;
  const SurfaceTree tree(skin);
  for (const DrivenPoint& p : points)
    if (const double d = std::sqrt(tree.query(p.rest).squared_distance); d > off_skin_m)
      throw InputError(source,
                       fmt::format("driven point {} lies {:.0f} mm off the skin after alignment; "
                                   "expected at most {:.0f} mm",
                                   p.name, d * 1e3, off_skin_m * 1e3));
}

DrivenPatches driven_patches(const DriveField& field, const tissue::TissueMesh& mesh,
                             double patch_radius_m, const std::string& source,
                             const std::vector<char>& fading) {
  const std::vector<DrivenPoint>& points = field.points();
  check_on_skin(points, mesh.skin, source);
  DrivenPatches patches;
  std::vector<std::string> names;
  Points rest(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    names.push_back(points[i].name);
    rest.row(static_cast<Eigen::Index>(i)) = points[i].rest.transpose();
  }
  patches.carriers = carriers(mesh, skin_places(mesh, names, rest));
  std::map<int, double> holds;  // by node
  const double radius = patch_radius_m * (1.5 - 0.5 * field.openness());
  for (std::size_t i = 0; i < points.size(); ++i)
    add_patch(points, i, mesh, radius, !fading.empty() && fading[i] && radius > 0, patches.carriers,
              holds);
  patches.hold.resize(static_cast<Eigen::Index>(holds.size()));
  Points places(holds.size(), 3);
  std::vector<double> margin;
  for (const auto& [v, hold] : holds) {
    const auto j = static_cast<Eigen::Index>(patches.nodes.size());
    patches.hold[j] = hold;
    places.row(j) = mesh.volume.outer.points.row(v);
    margin.push_back(mesh.upper_margin[std::size_t(v)]);
    patches.nodes.push_back(v);
  }
  patches.weights = field.weights(places, margin);
  for (Eigen::Index j = 0; j < places.rows(); ++j)
    places.row(j) = field.opened(places.row(j), margin[std::size_t(j)]).transpose();
  meet_points(field.opened_points(), places, patches);
  return patches;
}

std::vector<char> on_chin(const std::vector<DrivenPoint>& points, const io::Landmarks& landmarks) {
  constexpr double near_m = 0.012;
  std::vector<char> out(points.size(), 0);
  for (int k = 6; k <= 10; ++k)
    if (const auto at = landmarks.find(face::ibug(k)); at != landmarks.end())
      for (std::size_t i = 0; i < points.size(); ++i)
        if ((points[i].rest - at->second).norm() < near_m) out[i] = 1;
  return out;
}

}  // namespace hyperex::simulate
