// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/recording_model.hpp"

#include <cmath>

namespace hyperex::estimate {
namespace {

/// How both bands act at an activation, and the derivatives of that.
struct BandShares {
  double narrow, wide, narrow_by, wide_by;
};
BandShares band_shares(double a, double half) {
  if (a <= 0) return {a, 0, 1, 0};
  const double sum = a + half;
  return {a * half / sum, a * a / sum, half * half / (sum * sum), a * (a + 2 * half) / (sum * sum)};
}

/// Displacements of points by a small rotation about their middle (rad) and a shift (m).
Eigen::MatrixXd rigid_columns(const Points& places) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * places.rows(), 6);
  const Eigen::RowVector3d middle = places.colwise().mean();
  for (Eigen::Index p = 0; p < places.rows(); ++p) {
    const Vec3 arm = (places.row(p) - middle).transpose();
    for (int axis = 0; axis < 3; ++axis) {
      out.block<3, 1>(3 * p, axis) = Vec3::Unit(axis).cross(arm);
      out(3 * p + axis, 3 + axis) = 1;
    }
  }
  return out;
}

}  // namespace

RecordingModel::RecordingModel(FaceModel& face, const Unknowns& unknowns, std::vector<int> loads)
    : face_(face),
      unknowns_(unknowns),
      loads_(std::move(loads)),
      head_(rigid_columns(face.places)) {}

/// The load with its errors of direction.
Vec3 RecordingModel::turned_load(const Eigen::VectorXd& x, Eigen::Index recording) const {
  const KnownLoad& load = face_.loads[std::size_t(loads_[std::size_t(recording)])];
  const Vec3 after = x.segment<3>(unknowns_.load_turn(recording)),
             before = x.segment<3>(unknowns_.load_turn(recording) + 3);
  return load.amount() + after.cross(load.after) - before.cross(load.before);
}

/// Displacement without the error of the head's pose.
Eigen::VectorXd RecordingModel::under_load(const Eigen::VectorXd& x, Eigen::Index recording) const {
  const auto load = std::size_t(loads_[std::size_t(recording)]);
  return std::exp(x[unknowns_.tissue()] - x[unknowns_.young()]) *
         (face_.responses.columns().loads[load] * turned_load(x, recording));
}

Eigen::MatrixXd RecordingModel::derivative_under_load(const Eigen::VectorXd& x,
                                                      Eigen::Index recording) {
  const auto load = std::size_t(loads_[std::size_t(recording)]);
  const double softer = std::exp(x[unknowns_.tissue()] - x[unknowns_.young()]);
  const Eigen::VectorXd moved = under_load(x, recording);
  const Eigen::MatrixXd by_stiffness =
      softer * face_.responses.by_stiffness(load, turned_load(x, recording));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(head_.rows(), unknowns_.all());
  out.leftCols(unknowns_.ratios) = by_stiffness.leftCols(unknowns_.ratios);
  out.col(unknowns_.tissue()) = by_stiffness.rightCols<1>() + moved;
  out.col(unknowns_.young()) = -moved;
  const KnownLoad& known = face_.loads[load];
  const Eigen::MatrixXd by_load = softer * face_.responses.columns().loads[load];
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Index turn = unknowns_.load_turn(recording) + axis;
    out.col(turn) = by_load * Vec3::Unit(axis).cross(known.after);
    out.col(turn + 3) = -by_load * Vec3::Unit(axis).cross(known.before);
  }
  out.middleCols<6>(unknowns_.head(recording)) = head_;
  return out;
}

/// Per muscle: the product of the gains that act on it, but for one of them.
Eigen::VectorXd RecordingModel::gains(const Eigen::VectorXd& x, Eigen::Index without) const {
  Eigen::VectorXd out = Eigen::VectorXd::Ones(unknowns_.muscles);
  for (Eigen::Index k = 0; k < unknowns_.gains; ++k)
    if (k != without)
      for (const int muscle : face_.acts[std::size_t(k)]) out[muscle] *= x[unknowns_.gain(k)];
  return out;
}

Acting RecordingModel::acting(const Eigen::VectorXd& x, Eigen::Index recording) const {
  const Eigen::Index n = unknowns_.muscles;
  Acting out{Eigen::VectorXd(n),
             Eigen::VectorXd(n),
             {x.segment(unknowns_.lines(0), n), x.segment(unknowns_.lines(1), n)},
             face_.jaw.motion(x.segment<6>(unknowns_.jaw(recording)))};
  const Eigen::VectorXd gain = gains(x);
  for (Eigen::Index m = 0; m < n; ++m) {
    const BandShares share = band_shares(x[unknowns_.activations(recording) + m], face_.half);
    out.narrow[m] = gain[m] * share.narrow;
    out.wide[m] = gain[m] * share.wide;
  }
  return out;
}

Eigen::VectorXd RecordingModel::displacement(const Eigen::VectorXd& x, Eigen::Index recording) {
  face_.responses.set_stiffness(unknowns_.stiffness(x));
  if (loads_[std::size_t(recording)] >= 0)
    return under_load(x, recording) + head_ * x.segment<6>(unknowns_.head(recording));
  const Acting now = acting(x, recording);
  const PointColumns& columns = face_.responses.columns();
  Eigen::VectorXd out = columns.muscles.narrow * now.narrow + columns.muscles.wide * now.wide +
                        columns.jaw * now.jaw + head_ * x.segment<6>(unknowns_.head(recording));
  for (std::size_t way = 0; way < 2; ++way)
    out += columns.lines[way].narrow * now.narrow.cwiseProduct(now.line_m[way]) +
           columns.lines[way].wide * now.wide.cwiseProduct(now.line_m[way]);
  return out;
}

Eigen::MatrixXd RecordingModel::derivative(const Eigen::VectorXd& x, Eigen::Index recording) {
  face_.responses.set_stiffness(unknowns_.stiffness(x));
  if (loads_[std::size_t(recording)] >= 0) return derivative_under_load(x, recording);
  const Acting now = acting(x, recording);
  const PointColumns& columns = face_.responses.columns();
  const Eigen::Index n = unknowns_.muscles;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(head_.rows(), unknowns_.all());
  const Eigen::MatrixXd by_stiffness = face_.responses.by_stiffness(now);
  out.leftCols(unknowns_.ratios) = by_stiffness.leftCols(unknowns_.ratios);
  out.col(unknowns_.tissue()) = by_stiffness.rightCols<1>();
  Bands at = columns.muscles;  // with the lines where they are now
  for (std::size_t way = 0; way < 2; ++way) {
    at.narrow += columns.lines[way].narrow * now.line_m[way].asDiagonal();
    at.wide += columns.lines[way].wide * now.line_m[way].asDiagonal();
    out.middleCols(unknowns_.lines(int(way)), n) =
        columns.lines[way].narrow * now.narrow.asDiagonal() +
        columns.lines[way].wide * now.wide.asDiagonal();
  }
  const Eigen::VectorXd gain = gains(x);
  const Eigen::Index first = unknowns_.activations(recording);
  for (Eigen::Index m = 0; m < n; ++m) {
    const BandShares share = band_shares(x[first + m], face_.half);
    out.col(first + m) =
        gain[m] * (at.narrow.col(m) * share.narrow_by + at.wide.col(m) * share.wide_by);
  }
  for (Eigen::Index k = 0; k < unknowns_.gains; ++k) {
    const Eigen::VectorXd others = gains(x, k);
    for (const int m : face_.acts[std::size_t(k)]) {
      const BandShares share = band_shares(x[first + m], face_.half);
      out.col(unknowns_.gain(k)) +=
          others[m] * (at.narrow.col(m) * share.narrow + at.wide.col(m) * share.wide);
    }
  }
  out.middleCols<6>(unknowns_.jaw(recording)) =
      columns.jaw * face_.jaw.derivative(x.segment<6>(unknowns_.jaw(recording)));
  out.middleCols<6>(unknowns_.head(recording)) = head_;
  return out;
}

}  // namespace hyperex::estimate
