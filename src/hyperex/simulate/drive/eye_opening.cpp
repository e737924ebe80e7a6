// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/eye_opening.hpp"

#include <algorithm>
#include <cstdlib>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kRow_m = 1e-4;
constexpr int kColumns = 40, kRows = 120;  // from the middle to either side
constexpr double kMostBehind_m = 4e-3;     // a lid lies at most this far behind the landmarks

std::size_t place(int column, int row) {
  return std::size_t(column + kColumns) * (2 * kRows + 1) + std::size_t(row + kRows);
}

}  // namespace

EyeOpening::EyeOpening(const io::Landmarks& landmarks, const EyePoints& points) {
  const auto at = [&](int point) { return landmarks.at(face::ibug(point)); };
  for (std::size_t k = 0; k < 2; ++k)
    pairs_[k] = {at(points.pairs[k].first), at(points.pairs[k].second)};
  const face::FaceFrame frame = face::face_frame(landmarks);
  forward_ = frame.z;
  middle_ = (between(0) + between(1)) / 2;
  const Vec3 way = at(points.outer) - at(points.inner);
  along_ = (way - way.dot(forward_) * forward_).normalized();
  up_ = forward_.cross(along_);
  if (up_.dot(frame.y) < 0) up_ = -up_;
  for (const Vec3& on_line : {at(points.inner), between(0), between(1), at(points.outer)})
    line_.emplace_back(along_m(on_line), on_line);
}

std::vector<LidColumn> EyeOpening::columns(const TriMesh& skin) const {
  const Picks seen = look(skin);
  const std::optional<Run> middle = run_in(seen, 0, {0, 0});
  if (!middle) return {};
  std::vector<LidColumn> all;
  const auto add = [&](int column, const Run& run) {
    all.push_back({column * kLidColumn_m, *seen[place(column, run.last + 1)],
                   *seen[place(column, run.first - 1)]});
  };
  std::optional<Run> run = middle;
  for (int column = 0; run; run = run_in(seen, --column, *run)) add(column, *run);
  std::reverse(all.begin(), all.end());
  run = run_in(seen, 1, *middle);
  for (int column = 1; run; run = run_in(seen, ++column, *run)) add(column, *run);
  return all;
}

EyeOpening::Picks EyeOpening::look(const TriMesh& skin) const {
  constexpr int pixels = 1000;
  const render::Camera camera{middle_, forward_, up_, 0.2};
  Eigen::MatrixX2d places((2 * kColumns + 1) * (2 * kRows + 1), 2);
  for (int column = -kColumns; column <= kColumns; ++column)
    for (int row = -kRows; row <= kRows; ++row) {
      const Vec3 at = middle_ + column * kLidColumn_m * along_ + row * kRow_m * up_;
      const render::Projected p = render::project(camera, pixels, pixels, at);
      places.row(Eigen::Index(place(column, row))) << p.x, p.y;
    }
  return render::pick({{.mesh = skin}}, camera, pixels, pixels, places);
}

/// How far forward the line through the corners and the middles of the pairs lies there.
double EyeOpening::forward_m(double along_m) const {
  std::size_t k = 1;
  while (k + 1 < line_.size() && line_[k].first < along_m) ++k;
  const auto& [start_m, start] = line_[k - 1];
  const auto& [end_m, end] = line_[k];
  const double share = std::clamp((along_m - start_m) / (end_m - start_m), 0.0, 1.0);
  return (start + share * (end - start) - middle_).dot(forward_);
}

bool EyeOpening::is_open(const Picks& seen, int column, int row) const {
  const auto& picked = seen[place(column, row)];
  return !picked || picked->facing <= 0 ||
         (picked->point - middle_).dot(forward_) < forward_m(column * kLidColumn_m) - kMostBehind_m;
}

/// The rows between the lids in that column, beside those of the column before.
std::optional<EyeOpening::Run> EyeOpening::run_in(const Picks& seen, int column,
                                                  const Run& beside) const {
  if (std::abs(column) > kColumns) return {};
  int row = beside.first;
  while (row <= beside.last && !is_open(seen, column, row)) ++row;
  if (row > beside.last) return {};
  Run run{row, row};
  while (run.first > -kRows && is_open(seen, column, run.first - 1)) --run.first;
  while (run.last < kRows && is_open(seen, column, run.last + 1)) ++run.last;
  if (run.first == -kRows || run.last == kRows) return {};
  return run;
}

}  // namespace hyperex::simulate
