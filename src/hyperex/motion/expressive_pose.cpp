// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/expressive_pose.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>

#include "hyperex/core/progress.hpp"
#include "hyperex/geometry/cross_matrix.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/landmark_motion.hpp"

namespace hyperex::motion {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kLeastJitter_m = 1e-7;
constexpr double kSmoothing_s = 0.1;
// The amplitudes of expression that are tried: 0.0001, 0.0002, ... 6.6 standard deviations. With
// the smallest amplitude, points that do not move at all determine the pose alone.
constexpr double kLeastAmplitude = 1e-4;
constexpr int kAmplitudes = 17, kUsualIndex = 12;
// A weak prior against very large amplitudes, which a face with few points may suggest.
constexpr double kUsualAmplitude = 0.5, kPriorWeight = 0.5;
// A motion of the brows that was taken for a motion of the head leaves no trace in the lower face,
// and the reverse. For the covariance the lower face moves at least as much as the upper one, and
// the upper at least half as much as the lower.
constexpr double kUpperWithLower = 0.5;

using Amplitudes = std::array<double, 2>;  // of upper and lower face

/// Generalised least squares of the pose.
struct Estimator {
  Eigen::MatrixXd gain;  ///< K = (J' S^-1 J)^-1 J' S^-1: residuals to a step of the pose
  Matrix6 covariance = Matrix6::Zero();
  Matrix6 of_jitter = Matrix6::Zero();  ///< the part that jitter makes: K (2 s^2 I) K'
};

/// The landmarks measured in a sample, with all quantities that depend only on which landmarks
/// these are.
class Witnesses {
 public:
  Witnesses(const Points& reference, const std::vector<int>& table_rows, double jitter_m)
      : reference_(reference), variance_(2 * jitter_m * jitter_m) {
    Points table(reference.rows(), 3);
    for (std::size_t i = 0; i < table_rows.size(); ++i)
      table.row(Eigen::Index(i)) = landmark_motion().rest_m.row(table_rows[i]);
    const Similarity face = fit_similarity(table, reference);
    prior_ = expression_prior(table_rows, face.rotation, face.scale);
    centre_ = reference.colwise().mean().transpose();
    jacobian_.resize(3 * reference.rows(), 6);
    for (Eigen::Index i = 0; i < reference.rows(); ++i) {
      jacobian_.block<3, 3>(3 * i, 0) = -cross_matrix(reference.row(i).transpose() - centre_);
      jacobian_.block<3, 3>(3 * i, 3).setIdentity();
    }
    trust_ = (prior_.upper + prior_.lower).diagonal().reshaped(3, reference.rows()).colwise().sum();
    trust_ = trust_.cwiseInverse().eval();
  }

  /// The information of the landmarks about the pose, for given amplitudes of the expressions.
  struct Weighing {
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::MatrixXd whitened;    // L^-1 J
    double log_determinant = 0;  // of S and of J' S^-1 J
    Estimator pose;
  };
  Weighing weigh(const Amplitudes& a) const {
    Eigen::MatrixXd s = a[0] * a[0] * prior_.upper + a[1] * a[1] * prior_.lower;
    s.diagonal().array() += variance_;
    Weighing w;
    w.factor.compute(s);
    w.whitened = w.factor.matrixL().solve(jacobian_);
    const Eigen::LLT<Matrix6> normal(w.whitened.transpose() * w.whitened);
    w.pose.covariance = normal.solve(Matrix6::Identity());
    const Eigen::MatrixXd weights = w.factor.matrixU().solve(w.whitened) * w.pose.covariance;
    w.pose.gain = weights.transpose();
    w.pose.of_jitter = variance_ * weights.transpose() * weights;
    const Eigen::VectorXd diagonal = w.factor.matrixLLT().diagonal();
    w.log_determinant =
        2 * diagonal.array().log().sum() + 2 * normal.matrixLLT().diagonal().array().log().sum();
    return w;
  }

  /// Minus twice the restricted log likelihood of the residuals, up to a constant.
  static double misfit(const Weighing& w, const Eigen::VectorXd& residual, const Amplitudes& a) {
    const Eigen::VectorXd white = w.factor.matrixL().solve(residual);
    const Vector6 explained = w.whitened.transpose() * white;
    double sum =
        w.log_determinant + white.squaredNorm() - explained.dot(w.pose.covariance * explained);
    for (const double amplitude : a)
      sum += 2 * kPriorWeight * std::pow(std::max(0.0, std::log(amplitude / kUsualAmplitude)), 2);
    return sum;
  }

  /// The positions of the landmarks in the head's frame, minus those in sample 0: 3 numbers per
  /// landmark.
  Eigen::VectorXd residual(const Points& now, const Eigen::Isometry3d& pose) const {
    const Eigen::Isometry3d back = pose.inverse();
    Points left =
        ((now * back.linear().transpose()).rowwise() + back.translation().transpose()) - reference_;
    return left.reshaped<Eigen::RowMajor>();
  }

  Eigen::Isometry3d rough_pose(const Points& now) const {
    return fit_rigid(reference_, now, trust_);
  }

  Eigen::Isometry3d refined(const Estimator& estimator, const Points& now,
                            Eigen::Isometry3d pose) const {
    constexpr int kIterations = 4;  // the remaining rotations are small: two would be enough
    for (int i = 0; i < kIterations; ++i) {
      const Vector6 step = estimator.gain * residual(now, pose);
      const Vec3 turn = step.head<3>();
      Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
      move.translate(centre_ + Vec3(step.tail<3>()));
      if (turn.norm() > 0) move.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      move.translate(-centre_);
      pose = pose * move;
    }
    return pose;
  }

  const Vec3& centre() const { return centre_; }

 private:
  Points reference_;
  double variance_;
  ExpressionPrior prior_;
  Vec3 centre_;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd trust_;
};

/// The landmarks measured in one sample; `seen` are indices into the known landmarks.
struct Sample {
  std::vector<int> seen;
  Points now;
};

Sample sample_of(const Points& positions, const std::vector<KnownLandmark>& landmarks) {
  Sample sample;
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    if (positions.row(landmarks[i].column).allFinite()) sample.seen.push_back(int(i));
  sample.now.resize(Eigen::Index(sample.seen.size()), 3);
  for (std::size_t j = 0; j < sample.seen.size(); ++j)
    sample.now.row(Eigen::Index(j)) = positions.row(landmarks[std::size_t(sample.seen[j])].column);
  return sample;
}

/// Keeps the Witnesses of the last sample, since most samples have the same landmarks.
class WitnessKeeper {
 public:
  WitnessKeeper(const Motion& motion, const std::vector<KnownLandmark>& landmarks, double jitter_m)
      : motion_(motion), landmarks_(landmarks), jitter_m_(jitter_m) {}

  const Witnesses& of(const std::vector<int>& seen) {
    if (witnesses_.empty() || seen != seen_) {
      Points reference(Eigen::Index(seen.size()), 3);
      std::vector<int> rows;
      for (std::size_t j = 0; j < seen.size(); ++j) {
        const KnownLandmark& landmark = landmarks_[std::size_t(seen[j])];
        reference.row(Eigen::Index(j)) = motion_.positions[0].row(landmark.column);
        rows.push_back(landmark.row);
      }
      seen_ = seen;
      weighings_.clear();
      witnesses_.assign(1, Witnesses(reference, rows, jitter_m_));
    }
    return witnesses_.front();
  }

  /// For amplitudes between those of the grid: estimators interpolated linearly in the square of
  /// each amplitude, as covariances grow with it. Each fits an exact motion of the head exactly, so
  /// their mean does. `at`: places on the grid, of upper and lower face.
  Estimator between(const std::array<double, 2>& at) {
    std::array<int, 2> below{};
    std::array<double, 2> part{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double inside = std::clamp(at[i], 0.0, kAmplitudes - 1.0);
      below[i] = std::min(int(inside), kAmplitudes - 2);
      part[i] = (std::exp2(2 * (inside - below[i])) - 1) / 3;
    }
    Estimator out;
    for (const int up : {0, 1})
      for (const int low : {0, 1}) {
        const double weight = (up ? part[0] : 1 - part[0]) * (low ? part[1] : 1 - part[1]);
        if (weight == 0) continue;
        const Estimator& one = weighing({below[0] + up, below[1] + low}).pose;
        if (out.gain.size() == 0) out.gain = Eigen::MatrixXd::Zero(6, one.gain.cols());
        out.gain += weight * one.gain;
        out.covariance += weight * one.covariance;
        out.of_jitter += weight * one.of_jitter;
      }
    return out;
  }

  /// The most likely amplitudes of a sample on the grid. A descent starts from `before` and another
  /// from usual amplitudes, since there may be more than one minimum.
  std::array<int, 2> likeliest(const Sample& sample, const std::array<int, 2>& before) {
    const Witnesses& witnesses = of(sample.seen);
    const Eigen::VectorXd residual =
        witnesses.residual(sample.now, witnesses.rough_pose(sample.now));
    misfits_.setConstant(std::nan(""));
    const auto near = downhill(before, residual);
    const auto far = downhill({kUsualIndex, kUsualIndex}, residual);
    return misfit(far, residual) < misfit(near, residual) ? far : near;
  }

 private:
  std::array<int, 2> downhill(std::array<int, 2> at, const Eigen::VectorXd& residual) {
    double least = misfit(at, residual);
    for (bool moved = true; moved;) {
      moved = false;
      const std::array<int, 2> from = at;
      for (const auto& [up, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const std::array<int, 2> next = {from[0] + up, from[1] + down};
        if (std::min(next[0], next[1]) < 0 || std::max(next[0], next[1]) >= kAmplitudes) continue;
        if (const double value = misfit(next, residual); value < least - 1e-9) {
          least = value;
          at = next;
          moved = true;
        }
      }
    }
    return at;
  }

  static Amplitudes amplitudes_at(const std::array<int, 2>& at) {
    return {std::ldexp(kLeastAmplitude, at[0]), std::ldexp(kLeastAmplitude, at[1])};
  }

  const Witnesses::Weighing& weighing(const std::array<int, 2>& at) {
    auto found = weighings_.find(at);
    if (found == weighings_.end())
      found = weighings_.emplace(at, witnesses_.front().weigh(amplitudes_at(at))).first;
    return found->second;
  }

  double misfit(const std::array<int, 2>& at, const Eigen::VectorXd& residual) {
    double& known = misfits_(at[0], at[1]);
    if (std::isnan(known)) known = Witnesses::misfit(weighing(at), residual, amplitudes_at(at));
    return known;
  }

  const Motion& motion_;
  const std::vector<KnownLandmark>& landmarks_;
  double jitter_m_;
  std::vector<int> seen_;
  std::vector<Witnesses> witnesses_;  // none or one
  std::map<std::array<int, 2>, Witnesses::Weighing> weighings_;
  Eigen::Matrix<double, kAmplitudes, kAmplitudes> misfits_;  // of the present sample; NaN: unknown
};

/// The most likely amplitudes at sample k, as places on the grid, smoothed over time.
template <typename Times, typename Found>
std::array<double, 2> smoothed(const Times& time_s, const Found& found, std::size_t k) {
  constexpr double kFar = 4;
  std::array<double, 2> out{};
  for (std::size_t part = 0; part < 2; ++part) {
    double sum = 0, weights = 0;
    const auto add = [&](std::size_t j) {
      const double far = (time_s[j] - time_s[k]) / kSmoothing_s;
      if (std::abs(far) > kFar) return false;
      const double weight = std::exp(-far * far / 2);
      sum += weight * found[j][part];
      weights += weight;
      return true;
    };
    for (std::size_t j = k; j < found.size() && add(j);) ++j;
    for (std::size_t j = k; j > 0 && add(j - 1);) --j;
    out[part] = sum / weights;
  }
  return out;
}

}  // namespace

std::vector<KnownLandmark> known_landmarks(const Motion& motion) {
  const LandmarkMotion& table = landmark_motion();
  std::vector<KnownLandmark> known;
  for (std::size_t row = 0; row < table.names.size(); ++row)
    for (const std::string& name : {table.names[row], table.aliases[row]})
      if (const int column = name.empty() ? -1 : motion.index_of(name);
          column >= 0 && motion.positions[0].row(column).allFinite()) {
        known.push_back({column, int(row)});
        break;
      }
  return known;
}

std::vector<UncertainPose> expressive_poses(const Motion& motion,
                                            const std::vector<KnownLandmark>& landmarks) {
  std::vector<int> columns;
  for (const KnownLandmark& landmark : landmarks) columns.push_back(landmark.column);
  const double jitter_m = std::max(kLeastJitter_m, jitter_of_differences(motion, columns));
  WitnessKeeper keeper(motion, landmarks, jitter_m);

  const std::size_t samples = motion.positions.size();
  Progress progress("head pose", long(2 * samples));
  std::vector<std::array<int, 2>> found(samples, {0, 0});
  for (std::size_t k = 0; k < samples; ++k) {
    found[k] = keeper.likeliest(sample_of(motion.positions[k], landmarks),
                                k == 0 ? found[0] : found[k - 1]);
    progress.update(long(k + 1));
  }
  std::vector<UncertainPose> poses;
  for (std::size_t k = 0; k < samples; ++k) {
    const Sample sample = sample_of(motion.positions[k], landmarks);
    const Witnesses& witnesses = keeper.of(sample.seen);
    const auto [upper, lower] = smoothed(motion.time_s, found, k);
    const Eigen::Isometry3d pose = witnesses.refined(keeper.between({upper, lower}), sample.now,
                                                     witnesses.rough_pose(sample.now));
    const Estimator wide = keeper.between(
        {std::max(upper, lower + std::log2(kUpperWithLower)), std::max(upper, lower)});
    poses.push_back({pose, wide.covariance, wide.of_jitter, witnesses.centre()});
    progress.update(long(samples + k + 1));
  }
  return poses;
}

struct ExpressivePoseStream::Impl {
  Impl(Motion rest, double jitter_m)
      : reference(std::move(rest)),
        landmarks(known_landmarks(reference)),
        keeper(reference, landmarks, std::max(kLeastJitter_m, jitter_m)) {}
  Motion reference;
  std::vector<KnownLandmark> landmarks;
  WitnessKeeper keeper;
  std::deque<double> time_s;
  std::deque<std::array<int, 2>> found;
};

ExpressivePoseStream::ExpressivePoseStream(Motion reference, double jitter_m)
    : impl_(std::make_unique<Impl>(std::move(reference), jitter_m)) {
  if (impl_->landmarks.size() < 3)
    refuse(impl_->reference, "head pose needs three landmarks of the face");
}
ExpressivePoseStream::~ExpressivePoseStream() = default;
ExpressivePoseStream::ExpressivePoseStream(ExpressivePoseStream&&) noexcept = default;
ExpressivePoseStream& ExpressivePoseStream::operator=(ExpressivePoseStream&&) noexcept = default;

Eigen::Isometry3d ExpressivePoseStream::pose(double time_s, const Points& positions) {
  Impl& m = *impl_;
  const Sample sample = sample_of(positions, m.landmarks);
  m.found.push_back(
      m.keeper.likeliest(sample, m.found.empty() ? std::array<int, 2>{0, 0} : m.found.back()));
  m.time_s.push_back(time_s);
  while (m.time_s.front() < time_s - 5 * kSmoothing_s) {
    m.time_s.pop_front();
    m.found.pop_front();
  }
  const Witnesses& witnesses = m.keeper.of(sample.seen);
  const Estimator estimator = m.keeper.between(smoothed(m.time_s, m.found, m.found.size() - 1));
  return witnesses.refined(estimator, sample.now, witnesses.rough_pose(sample.now));
}

}  // namespace hyperex::motion
