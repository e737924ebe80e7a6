// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::anatomy {
namespace {

using Matrix = Eigen::MatrixXd;

// How faces differ from the canonical one, m (metres of the canonical face): alike on both sides,
// and one side from the other. The same of landmarks that a person and the program have set.
constexpr double kAlike_m = 5e-3, kUnlike_m = 2e-3, kSetAlike_m = 4e-3, kSetUnlike_m = 1e-3;
constexpr double kReach_m = 0.035;  // over which distance that changes
// How well the place that a name means is known: the point of the chin (where it is most prominent,
// or its lower end: 15 mm apart on a real face), outline of the jaw, brows and cheeks, all else.
constexpr double kChin_m = 8e-3, kJaw_m = 3e-3, kBrow_m = 2e-3, kPlace_m = 1.5e-3;
// The similarity's parameters are free: a prior so wide that it says nothing.
constexpr double kFree = 1.0;
constexpr std::size_t kFewest = 5;
constexpr double kLeastSpreadOfGiven = 0.04;

double place_m(const std::string& name) {
  if (name == "pogonion") return kChin_m;
  if (name == "glabella" || name.starts_with("cheek_")) return kBrow_m;
  const int k = face::ibug_number(name).value_or(67);
  return k <= 16 ? kJaw_m : k <= 26 ? kBrow_m : kPlace_m;
}

/// 3 x 3 block of the smooth field's covariance between two places of the canonical face.
Eigen::Matrix3d covariance(const Vec3& a, const Vec3& b, double alike_m, double unlike_m) {
  const auto near = [](const Vec3& d) {
    return std::exp(-d.squaredNorm() / (2 * kReach_m * kReach_m));
  };
  const double alike = alike_m * alike_m / 2, unlike = unlike_m * unlike_m / 2;
  const Vec3 mirror(-1, 1, 1);
  const double here = near(a - b), there = near(a - b.cwiseProduct(mirror));
  Eigen::Matrix3d block = (alike + unlike) * here * Eigen::Matrix3d::Identity();
  block += (alike - unlike) * there * Eigen::Matrix3d(mirror.asDiagonal());
  return block;
}

/// 3n x 3n: the field, the unknown similarity, and how well each place is known.
Matrix covariances(const KnownLandmarks& known, double alike_m, double unlike_m) {
  const Eigen::Index n = known.canonical.rows();
  const Vec3 middle = known.canonical.colwise().mean();
  Matrix k(3 * n, 3 * n), trend = Matrix::Zero(3 * n, 7);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 x = known.canonical.row(i).transpose();
    const Vec3 arm = (x - middle) / 0.1;
    for (Eigen::Index j = 0; j < n; ++j)
      k.block<3, 3>(3 * i, 3 * j) =
          covariance(x, known.canonical.row(j).transpose(), alike_m, unlike_m);
    const double noise = place_m(known.names[std::size_t(i)]);
    k.diagonal().segment<3>(3 * i).array() += noise * noise;
    trend.block<3, 3>(3 * i, 0).setIdentity();
    trend.block<3, 1>(3 * i, 3) = Vec3::UnitX().cross(arm);
    trend.block<3, 1>(3 * i, 4) = Vec3::UnitY().cross(arm);
    trend.block<3, 1>(3 * i, 5) = Vec3::UnitZ().cross(arm);
    trend.block<3, 1>(3 * i, 6) = arm;
  }
  return k + kFree * trend * trend.transpose();
}

/// Each landmark's offset as the others predict it. `expected`: without any offset, scan frame.
std::vector<LandmarkSurprise> surprises_of(const KnownLandmarks& known, const Matrix& precision,
                                           const Points& expected,
                                           const Similarity& scan_from_canonical) {
  const Similarity canonical_from_scan = scan_from_canonical.inverse();
  const Points offset =
      canonical_from_scan.apply(known.given) - canonical_from_scan.apply(expected);
  const Eigen::VectorXd pull =
      precision * Eigen::Map<const Eigen::VectorXd>(offset.data(), offset.size());
  const std::size_t n = known.names.size();
  std::vector<LandmarkSurprise> surprises;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Eigen::Index> rows;  // of the landmark, first, and of its other names
    for (std::size_t pass = 0; pass < 2; ++pass)
      for (std::size_t j = 0; j < n; ++j)
        if (pass == 0 ? j == i : j != i && face::same_place(known.names[i], known.names[j]))
          for (int c = 0; c < 3; ++c) rows.push_back(3 * Eigen::Index(j) + c);
    const Matrix left_out = Matrix(precision(rows, rows)).inverse();  // covariance of the error
    const Vec3 error = (left_out * pull(rows)).head<3>();
    const Eigen::Matrix3d spread = left_out.topLeftCorner<3, 3>();
    const Vec3 given = known.given.row(Eigen::Index(i)).transpose();
    LandmarkSurprise surprise;
    surprise.name = known.names[i];
    surprise.expected = scan_from_canonical * Vec3(canonical_from_scan * given - error);
    surprise.distance_m = (given - surprise.expected).norm();
    surprise.deviations = std::sqrt(error.dot(spread.llt().solve(error)));
    surprises.push_back(surprise);
  }
  return surprises;
}

bool too_few(const KnownLandmarks& known) {
  return known.names.size() < kFewest || spread_off_line(known.given) < kLeastSpreadOfGiven;
}

Matrix inverse(const Matrix& positive) {
  return positive.llt().solve(Matrix::Identity(positive.rows(), positive.cols()));
}

}  // namespace

std::vector<LandmarkSurprise> landmark_surprises(const io::Landmarks& given) {
  const KnownLandmarks known = known_landmarks(given);
  if (too_few(known)) return {};
  const Similarity scan_from_canonical = fit_similarity(known.canonical, known.given);
  return surprises_of(known, inverse(covariances(known, kAlike_m, kUnlike_m)),
                      scan_from_canonical.apply(known.canonical), scan_from_canonical);
}

std::vector<LandmarkSurprise> landmark_surprises(const io::Landmarks& given,
                                                 const io::Landmarks& found) {
  io::Landmarks both;
  for (const auto& [name, position] : given)
    if (found.contains(name)) both[name] = position;
  const KnownLandmarks known = known_landmarks(both);
  if (too_few(known)) return {};
  Points there = known.given;
  for (Eigen::Index i = 0; i < there.rows(); ++i)
    there.row(i) = found.at(known.names[std::size_t(i)]);
  return surprises_of(known, inverse(covariances(known, kSetAlike_m, kSetUnlike_m)), there,
                      fit_similarity(known.canonical, there));
}

}  // namespace hyperex::anatomy
