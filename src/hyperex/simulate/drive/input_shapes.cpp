// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/input_shapes.hpp"

#include <algorithm>

#include "hyperex/motion/resample.hpp"
#include "hyperex/simulate/drive/principal_directions.hpp"

namespace hyperex::simulate {
namespace {

/// A turn counts as much as the way of a point at this distance from the axis (m).
constexpr double kLever = 0.1;
/// Less is rounding of places in space (m).
constexpr double kLeastWay = 1e-12;

/// The numbers of the input at one time, in this order: the acting points' displacements, then
/// kLever times the jaw's turn, then its slide.
class Layout {
 public:
  explicit Layout(const Boundary& boundary) : jaw_(boundary.jaw_acts()) {
    const std::vector<char> acts = boundary.acting_points();
    for (std::size_t p = 0; p < acts.size(); ++p)
      if (acts[p]) points_.push_back(static_cast<int>(p));
    all_points_ = static_cast<Eigen::Index>(acts.size());
  }
  Eigen::Index size() const { return 3 * Eigen::Index(points_.size()) + (jaw_ ? 12 : 0); }

  void pack(const Points& points, const Boundary::JawMotion& jaw,
            Eigen::Ref<Eigen::VectorXd> out) const {
    Eigen::Index at = 0;
    for (const int p : points_) out.segment<3>(3 * at++) = points.row(p).transpose();
    if (!jaw_) return;
    out.segment<9>(3 * at) = kLever * jaw.turn.reshaped();
    out.segment<3>(3 * at + 9) = jaw.slide;
  }
  void unpack(const Eigen::VectorXd& in, Points& points, Boundary::JawMotion& jaw) const {
    points = Points::Zero(all_points_, 3);
    Eigen::Index at = 0;
    for (const int p : points_) points.row(p) = in.segment<3>(3 * at++).transpose();
    if (!jaw_) return;
    jaw.turn = in.segment<9>(3 * at).reshaped(3, 3) / kLever;
    jaw.slide = in.segment<3>(3 * at + 9);
  }

 private:
  std::vector<int> points_;
  Eigen::Index all_points_ = 0;
  bool jaw_;
};

/// Orthonormal directions (columns) of the columns of `input`.
Eigen::MatrixXd directions_within(const Eigen::MatrixXd& input, double tolerance) {
  // A motion recorded at 30 Hz is smooth between its frames: some hundred instants span it.
  const Eigen::Index stride = std::max<Eigen::Index>(1, input.cols() / 600);
  const Eigen::MatrixXd some = input(Eigen::all, Eigen::seq(0, Eigen::last, stride));
  const double allowed = std::max(tolerance * input.cwiseAbs().maxCoeff(), kLeastWay);
  const Eigen::MatrixXd directions = principal_directions(some).directions;
  Eigen::MatrixXd rest = input;
  Eigen::Index kept = 0;
  while (kept < directions.cols() && rest.cwiseAbs().maxCoeff() > allowed) {
    const auto u = directions.col(kept++);
    rest -= u * (u.transpose() * rest);
  }
  return directions.leftCols(kept);
}

}  // namespace

fem::Drive compressed_drive(const Eigen::MatrixXd& input, double dt_s, int steps, double tolerance,
                            Eigen::Index prescribed, Eigen::Index unknowns, const FillShape& fill) {
  const Eigen::MatrixXd directions = directions_within(input, tolerance);
  const Eigen::Index r = directions.cols();
  fem::Drive drive;
  drive.prescribed.resize(prescribed, r);
  drive.force.resize(unknowns, r);
  for (Eigen::Index i = 0; i < r; ++i)
    fill(directions.col(i), drive.prescribed.col(i), drive.force.col(i));
  std::vector<double> time_s;
  for (Eigen::Index k = 0; k < input.cols(); ++k) time_s.push_back(static_cast<double>(k) * dt_s);
  const Eigen::MatrixXd value = input.transpose() * directions;  // a row a step
  const Eigen::MatrixXd slope = motion::spline_slopes(time_s, value);
  drive.s = value.topRows(steps + 1).transpose();
  drive.rate = slope.topRows(steps + 1).transpose();
  drive.second.resize(r, steps + 1);
  for (int k = 0; k <= steps; ++k)
    drive.second.col(k) = (6 / (dt_s * dt_s) * (value.row(k + 1) - value.row(k)) -
                           (4 * slope.row(k) + 2 * slope.row(k + 1)) / dt_s)
                              .transpose();
  return drive;
}

InputShapes input_shapes(Boundary& boundary, const std::function<Points(double)>& points_at,
                         double dt_s, int steps, double tolerance) {
  InputShapes out;
  const Layout layout(boundary);
  Eigen::MatrixXd input(layout.size(), steps + 1 + kBeyond);
  for (Eigen::Index k = 0; k < input.cols(); ++k) {
    const Points points = points_at(static_cast<double>(k) * dt_s);
    layout.pack(points, boundary.follow(points), input.col(k));
    if (k <= steps)
      out.greatest_opening_deg = std::max(out.greatest_opening_deg, boundary.jaw_opening_deg());
  }
  out.drive = compressed_drive(
      input, dt_s, steps, tolerance, static_cast<Eigen::Index>(boundary.prescribed().size()),
      3 * boundary.node_count(),
      [&](const Eigen::VectorXd& direction, Eigen::Ref<Eigen::VectorXd> prescribed,
          Eigen::Ref<Eigen::VectorXd> force) {
        Points points;
        Boundary::JawMotion jaw;
        layout.unpack(direction, points, jaw);
        boundary.prescribe(points, jaw, prescribed, force);
      });
  return out;
}

}  // namespace hyperex::simulate
