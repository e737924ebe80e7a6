// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hyperex/core/error.hpp"
#include "hyperex/ct/filters.hpp"

namespace hyperex::ct {
namespace {

constexpr double kAlwaysThere = 0.95, kAroundCouch_m = 2.5e-3, kThin_m = 3e-3;
constexpr double kBall_m = 4e-3, kDeep_m = 6e-3;
constexpr double kLeastHead_m3 = 20e-6, kLeastStack_m = 0.06;
constexpr double kMostCouch_m = 0.03, kBeyondHead_m = 8e-3, kMostCouchShare = 0.5;

/// The columns of a volume along one of its indices, as a plane of the two others.
class Columns {
 public:
  explicit Columns(const Volume& volume)
      : volume_(volume),
        along_(volume.upward_axis()),
        across_{along_ == 0 ? 1 : 0, along_ == 2 ? 1 : 2} {
    const Vec3 spacing = volume.spacing_m();
    grid_.size = {volume.size[std::size_t(across_[0])], volume.size[std::size_t(across_[1])], 1};
    grid_.spacing_m = {spacing[across_[0]], spacing[across_[1]], 1};
  }
  const Grid& grid() const { return grid_; }
  std::size_t count() const { return std::size_t(grid_.size[0]) * grid_.size[1]; }
  double height_m() const { return length() * volume_.step_m.col(along_).norm(); }
  int length() const { return volume_.size[std::size_t(along_)]; }
  std::size_t voxel(std::size_t column, int n) const {
    std::array<int, 3> index{};
    index[std::size_t(across_[0])] = int(column % std::size_t(grid_.size[0]));
    index[std::size_t(across_[1])] = int(column / std::size_t(grid_.size[0]));
    index[std::size_t(along_)] = n;
    return volume_.at(index[0], index[1], index[2]);
  }
  std::array<int, 2> place(std::size_t column) const {
    return {int(column % std::size_t(grid_.size[0])), int(column / std::size_t(grid_.size[0]))};
  }
  /// How far a column is from the border of the slices.
  double from_border_m(std::size_t column) const {
    const std::array<int, 2> at = place(column);
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 2; ++a)
      out = std::min(out,
                     std::min(at[a] + 1, grid_.size[a] - at[a]) * grid_.spacing_m[Eigen::Index(a)]);
    return out;
  }

 private:
  const Volume& volume_;
  int along_;
  std::array<int, 2> across_;
  Grid grid_;
};

struct Box {
  std::array<int, 2> low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()},
      high{-1, -1};
  void take(const std::array<int, 2>& p) {
    for (std::size_t a = 0; a < 2; ++a)
      low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
  }
  /// Whether `other` reaches beyond it by no more than `margin_m`.
  bool holds(const Box& other, const Grid& grid, double margin_m) const {
    for (std::size_t a = 0; a < 2; ++a) {
      const double step_m = grid.spacing_m[Eigen::Index(a)];
      if ((low[a] - other.low[a]) * step_m > margin_m ||
          (other.high[a] - high[a]) * step_m > margin_m)
        return false;
    }
    return true;
  }
};

Mask complement(const Mask& mask) {
  Mask out(mask.size());
  std::transform(mask.begin(), mask.end(), out.begin(), [](auto v) { return v == 0 ? 1 : 0; });
  return out;
}

bool is_empty(const Mask& mask) {
  return std::none_of(mask.begin(), mask.end(), [](auto v) { return v != 0; });
}

/// The outline, across the columns, of the largest piece that is thicker than a sheet.
Box outline_of(const Mask& mask, const Columns& columns, const Grid& grid) {
  const Mask around = complement(mask);
  Box box;
  if (is_empty(around)) return box;
  const std::vector<float> depth = distance_to(around, grid);
  Mask core(mask.size());
  for (std::size_t v = 0; v < core.size(); ++v) core[v] = depth[v] > kThin_m ? 1 : 0;
  const Pieces pieces = pieces_of(core, grid);
  for (std::size_t c = 0; c < columns.count(); ++c)
    for (int n = 0; n < columns.length(); ++n)
      if (pieces.number[columns.voxel(c, n)] == 1) {
        box.take(columns.place(c));
        break;
      }
  return box;
}

/// Takes out what is thicker than a couch: in a short stack most columns of the head are dense in
/// all slices, and hang together with the couch.
void take_out_thick(Mask& always, const Columns& columns) {
  const Mask around = complement(always);
  if (is_empty(around)) return always.assign(always.size(), 0);
  const std::vector<float> depth = distance_to(around, columns.grid());
  Mask core(always.size());
  for (std::size_t c = 0; c < core.size(); ++c)
    core[c] = std::min(double(depth[c]), columns.from_border_m(c)) > kMostCouch_m / 2 ? 1 : 0;
  if (is_empty(core)) return;
  const std::vector<float> away = distance_to(core, columns.grid());
  for (std::size_t c = 0; c < core.size(); ++c)
    if (away[c] <= kMostCouch_m / 2) always[c] = 0;
}

/// Columns that are dense in nearly all slices and no thicker than a couch.
Mask thin_columns(const Mask& mask, const Columns& columns) {
  Mask always(columns.count(), 0);
  for (std::size_t c = 0; c < columns.count(); ++c) {
    int there = 0;
    for (int n = 0; n < columns.length(); ++n) there += mask[columns.voxel(c, n)];
    always[c] = there >= kAlwaysThere * columns.length() ? 1 : 0;
  }
  if (!is_empty(always)) take_out_thick(always, columns);
  return always;
}

/// Flags of the columns that are couch, with what is around them.
Mask couch_columns(const Mask& mask, const Columns& columns, const Grid& grid) {
  Mask couch(columns.count(), 0);
  if (columns.height_m() < kLeastStack_m) return couch;
  const Mask thin = thin_columns(mask, columns);
  if (is_empty(thin)) return couch;
  Mask rest = mask;
  for (std::size_t c = 0; c < columns.count(); ++c)
    for (int n = 0; thin[c] != 0 && n < columns.length(); ++n) rest[columns.voxel(c, n)] = 0;
  const Box head = outline_of(rest, columns, grid);
  const Pieces pieces = pieces_of(thin, columns.grid());
  std::vector<Box> boxes(pieces.count.size());
  for (std::size_t c = 0; c < columns.count(); ++c)
    boxes[std::size_t(pieces.number[c])].take(columns.place(c));
  for (std::size_t c = 0; c < columns.count(); ++c)
    couch[c] =
        pieces.number[c] > 0 && head.high[0] >= 0 &&
                !head.holds(boxes[std::size_t(pieces.number[c])], columns.grid(), kBeyondHead_m)
            ? 1
            : 0;
  if (is_empty(couch)) return couch;
  const std::vector<float> away = distance_to(couch, columns.grid());
  for (std::size_t c = 0; c < couch.size(); ++c) couch[c] = away[c] <= kAroundCouch_m ? 1 : 0;
  return couch;
}

/// Takes the couch out of `mask`; returns how many values that were. Where it would be most of
/// all, it is no couch: nothing is removed, and `doubtful` is set.
std::size_t remove_couch(Mask& mask, const Columns& columns, const Grid& grid, bool& doubtful) {
  const Mask couch = couch_columns(mask, columns, grid);
  Mask without = mask;
  for (std::size_t c = 0; c < columns.count(); ++c)
    for (int n = 0; couch[c] != 0 && n < columns.length(); ++n) without[columns.voxel(c, n)] = 0;
  const auto count = [](const Mask& of) {
    return std::size_t(std::count(of.begin(), of.end(), Mask::value_type(1)));
  };
  const std::size_t all = count(mask), removed = all - count(without);
  doubtful = double(removed) > kMostCouchShare * double(all);
  if (doubtful) return 0;
  mask = std::move(without);
  return removed;
}

/// Whether a value lies on the border of the volume, the lowest slice excepted.
bool on_open_border(const Volume& volume, int i, int j, int k) {
  const std::array<int, 3> index = {i, j, k};
  const int up = volume.upward_axis();
  for (int a = 0; a < 3; ++a) {
    const int last = volume.size[std::size_t(a)] - 1, at = index[std::size_t(a)];
    if (at != 0 && at != last) continue;
    const int lowest = volume.step_m(1, a) > 0 ? 0 : last;
    if (a != up || at != lowest) return true;
  }
  return false;
}

/// Air that the ball reaches from the border.
Mask outside_of(const Volume& volume, const Mask& body, const Grid& grid) {
  const std::vector<float> away = distance_to(body, grid);
  Mask far(body.size());
  for (std::size_t v = 0; v < far.size(); ++v) far[v] = away[v] > kBall_m ? 1 : 0;
  const Pieces pieces = pieces_of(far, grid);
  std::vector<char> open(pieces.count.size(), 0);
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if (on_open_border(volume, i, j, k))
          open[std::size_t(pieces.number[volume.at(i, j, k)])] = 1;
  open[0] = 0;
  for (std::size_t v = 0; v < far.size(); ++v)
    far[v] = Mask::value_type(open[std::size_t(pieces.number[v])]);
  if (is_empty(far)) return complement(body);
  const std::vector<float> reached = distance_to(far, grid);
  Mask outside(body.size());
  for (std::size_t v = 0; v < outside.size(); ++v)
    outside[v] = body[v] == 0 && reached[v] <= kBall_m ? 1 : 0;
  return outside;
}

/// Fills the air inside the head; returns how many values that were.
std::size_t fill_cavities(Volume& volume, const Mask& body, const Grid& grid, float filling_hu) {
  const Mask outside = outside_of(volume, body, grid);
  if (is_empty(outside)) return 0;
  Mask inner(body.size());
  for (std::size_t v = 0; v < inner.size(); ++v) inner[v] = body[v] == 0 && outside[v] == 0 ? 1 : 0;
  const std::vector<float> depth = distance_to(outside, grid);
  const Pieces pieces = pieces_of(inner, grid);
  std::vector<float> deepest(pieces.count.size(), 0), nearest(pieces.count.size(), 1);
  for (std::size_t v = 0; v < inner.size(); ++v) {
    const auto p = std::size_t(pieces.number[v]);
    deepest[p] = std::max(deepest[p], depth[v]);
    nearest[p] = std::min(nearest[p], depth[v]);
  }
  const double beside = grid.spacing_m.norm() * 1.001;
  std::size_t filled = 0;
  for (std::size_t v = 0; v < inner.size(); ++v) {
    const auto p = std::size_t(pieces.number[v]);
    if (p == 0 || (deepest[p] < kDeep_m && nearest[p] <= beside)) continue;
    volume.hu[v] = filling_hu;
    ++filled;
  }
  return filled;
}

}  // namespace

Body find_body(const Volume& volume, const Thresholds& thresholds, const std::string& source) {
  Body out;
  out.volume = volume;
  const Grid grid = grid_of(volume);
  const Columns columns(volume);
  Mask mask(volume.count());
  for (std::size_t v = 0; v < mask.size(); ++v)
    mask[v] = volume.hu[v] >= thresholds.skin_hu ? 1 : 0;
  Mask without = mask;
  const std::size_t removed = remove_couch(without, columns, grid, out.doubtful_couch);
  const Pieces pieces = pieces_of(without, grid);
  if (pieces.count.size() < 2 || double(pieces.count[1]) * volume.voxel_m3() < kLeastHead_m3)
    throw InputError(source +
                     ": nothing of a head's size is denser than the skin's value; expected "
                     "the CT of a head");
  out.mask.resize(mask.size());
  for (std::size_t v = 0; v < mask.size(); ++v) {
    out.mask[v] = pieces.number[v] == 1 ? 1 : 0;
    if (mask[v] != 0 && out.mask[v] == 0) out.volume.hu[v] = float(thresholds.air_hu);
  }
  out.couch = removed > 0;
  out.too_low_for_couch = columns.height_m() < kLeastStack_m;
  out.couch_cm3 = double(removed) * volume.voxel_m3() * 1e6;
  out.cavities_cm3 = double(fill_cavities(out.volume, out.mask, grid, float(thresholds.soft_hu))) *
                     volume.voxel_m3() * 1e6;
  return out;
}

}  // namespace hyperex::ct
