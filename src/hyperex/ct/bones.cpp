// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/bones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/ct/filters.hpp"

namespace hyperex::ct {
namespace {

constexpr double kStep_hu = 25, kMostRise_hu = 1200;
constexpr double kLeastVolume_m3 = 8e-6, kLeastWidth_m = 0.055, kMiddle_m = 0.015;
constexpr double kBelow_m = 0.03, kBehind_m = 0.04, kFragment_m3 = 0.1e-6;
constexpr double kSeedReach_m = 6e-3, kSeedBall_m = 3e-3;
constexpr std::uint8_t kNeither = 3;  // a marker

/// The part of a volume that holds the bone, with one value around it.
struct Crop {
  Volume volume;
  std::array<int, 3> low{};
};

Crop crop_to(const Volume& volume, double least_hu) {
  std::array<int, 3> low = volume.size, high{-1, -1, -1};
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        if (!(volume.hu[volume.at(i, j, k)] >= least_hu)) continue;
        const std::array<int, 3> at = {i, j, k};
        for (std::size_t a = 0; a < 3; ++a)
          low[a] = std::min(low[a], at[a]), high[a] = std::max(high[a], at[a]);
      }
  Crop out;
  if (high[0] < 0) return out;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::max(0, low[a] - 1);
    high[a] = std::min(volume.size[a] - 1, high[a] + 1);
    out.volume.size[a] = high[a] - low[a] + 1;
  }
  out.low = low;
  out.volume.step_m = volume.step_m;
  out.volume.origin_m = volume.place(low[0], low[1], low[2]);
  out.volume.hu.reserve(out.volume.count());
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const auto from = volume.hu.begin() + std::ptrdiff_t(volume.at(low[0], j, k));
      out.volume.hu.insert(out.volume.hu.end(), from, from + out.volume.size[0]);
    }
  return out;
}

struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low,
       sum = Vec3::Zero();
  double count = 0;
  void take(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p), sum += p, ++count; }
  Vec3 middle() const { return sum / count; }
};

/// The pieces of bone at one level that are large enough to be looked at.
std::vector<Extent> extents_of(const Volume& volume, const Pieces& pieces, double least_m3) {
  std::size_t large = 1;
  while (large < pieces.count.size() && double(pieces.count[large]) * volume.voxel_m3() >= least_m3)
    ++large;
  std::vector<Extent> out(std::max<std::size_t>(large, 2));
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if (const auto p = std::size_t(pieces.number[volume.at(i, j, k)]); p > 0 && p < out.size())
          out[p].take(volume.place(i, j, k));
  return out;
}

bool is_mandible(const Extent& one, const Extent& skull) {
  return one.high.x() - one.low.x() >= kLeastWidth_m &&
         std::abs(one.middle().x() - (skull.low.x() + skull.high.x()) / 2) <= kMiddle_m &&
         one.middle().y() <= skull.middle().y() - kBelow_m &&
         one.high.z() >= skull.high.z() - kBehind_m;
}

/// The densest value of bone near a seed.
std::size_t value_at_seed(const Volume& volume, const Vec3& seed_m, double bone_hu,
                          const char* option, const std::string& source) {
  std::size_t best = volume.count();
  float highest = float(bone_hu);
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const std::size_t v = volume.at(i, j, k);
        if (volume.hu[v] < highest || (volume.place(i, j, k) - seed_m).norm() > kSeedReach_m)
          continue;
        highest = volume.hu[v], best = v;
      }
  if (best == volume.count())
    throw InputError(fmt::format(
        "{}: {}: no bone within {:g} mm of {:.1f},{:.1f},{:.1f} mm; expected "
        "a point in the bone, in the frame of the outputs",
        source, option, 1e3 * kSeedReach_m, 1e3 * seed_m.x(), 1e3 * seed_m.y(), 1e3 * seed_m.z()));
  return best;
}

/// Markers of a watershed, and the level at which they fell apart.
struct Markers {
  Mask mask;
  double level_hu = 0;
  bool found = false;
};

class Separation {
 public:
  Separation(const Volume& bone, const Mask& region, double bone_hu)
      : bone_(bone), region_(region), grid_(grid_of(bone)), bone_hu_(bone_hu) {}

  Markers by_shape() const {
    Progress progress("separating the jaw", long(kMostRise_hu / kStep_hu));
    for (double rise = 0; rise <= kMostRise_hu; rise += kStep_hu) {
      progress.update(long(rise / kStep_hu));
      const Pieces pieces = pieces_at(bone_hu_ + rise);
      if (pieces.count.size() < 3) continue;
      const std::vector<Extent> extents = extents_of(bone_, pieces, kLeastVolume_m3);
      for (std::size_t p = 2; p < extents.size(); ++p)
        if (is_mandible(extents[p], extents[1]))
          return of_pieces(pieces, {1}, int(p), bone_hu_ + rise);
    }
    return {};
  }

  Markers by_seeds(std::size_t skull, std::size_t mandible) const {
    const int levels = int((bone_.hu[mandible] - bone_hu_) / kStep_hu) + 1;
    Progress progress("separating the jaw", levels);
    for (int n = 0; n < levels; ++n) {
      progress.update(n);
      const double level = bone_hu_ + n * kStep_hu;
      const Pieces pieces = pieces_at(level);
      const int a = pieces.number[skull], b = pieces.number[mandible];
      if (double(pieces.count[std::size_t(b)]) * bone_.voxel_m3() < kLeastVolume_m3) break;
      // The skull's seed may be below this value, or in a fragment that fell off before the jaw.
      if (b > 1 && a != b)
        return of_pieces(pieces, a > 0 ? std::vector{1, a} : std::vector{1}, b, level);
    }
    return around_seeds(skull, mandible, std::min(bone_.hu[skull], bone_.hu[mandible]));
  }

  double between_m(std::size_t a, std::size_t b) const {
    return (place_of(a) - place_of(b)).norm();
  }

  /// The label of each value of the region.
  Mask flooded(const Markers& markers) const {
    Mask level(bone_.count(), 255), from = markers.mask;
    const double range = std::max(1.0, markers.level_hu - bone_hu_);
    for (std::size_t v = 0; v < level.size(); ++v) {
      if (region_[v] == 0)
        from[v] = kNeither;
      else
        level[v] =
            std::uint8_t(std::clamp(254 * (markers.level_hu - bone_.hu[v]) / range, 0.0, 254.0));
    }
    Mask label = watershed(level, from, grid_);
    for (std::size_t v = 0; v < label.size(); ++v)
      if (region_[v] == 0 || label[v] > kMandible) label[v] = 0;
    return label;
  }

 private:
  /// Balls around the two points.
  Markers around_seeds(std::size_t skull, std::size_t mandible, double level_hu) const {
    Markers out{Mask(bone_.count(), 0), level_hu, true};
    for (std::size_t v = 0; v < out.mask.size(); ++v) {
      if (region_[v] == 0) continue;
      if (between_m(v, skull) <= kSeedBall_m) out.mask[v] = kSkull;
      if (between_m(v, mandible) <= kSeedBall_m) out.mask[v] = kMandible;
    }
    return out;
  }
  Vec3 place_of(std::size_t v) const {
    const auto row = std::size_t(bone_.size[0]), slice = row * std::size_t(bone_.size[1]);
    return bone_.place(double(v % row), double(v % slice / row), double(v / slice));
  }
  Pieces pieces_at(double level_hu) const {
    Mask mask(bone_.count());
    for (std::size_t v = 0; v < mask.size(); ++v)
      mask[v] = region_[v] != 0 && bone_.hu[v] >= level_hu ? 1 : 0;
    return pieces_of(mask, grid_);
  }
  Markers of_pieces(const Pieces& pieces, const std::vector<int>& skull, int mandible,
                    double level_hu) const {
    Markers out{Mask(bone_.count(), 0), level_hu, true};
    std::vector<std::uint8_t> label(pieces.count.size(), 0);
    // At a high value the skull is in several pieces; those above the mandible are its own.
    const std::vector<Extent> extents = extents_of(bone_, pieces, kFragment_m3);
    for (std::size_t p = 1; p < extents.size(); ++p)
      if (extents[p].middle().y() > extents[std::size_t(mandible)].high.y()) label[p] = kSkull;
    for (const int p : skull) label[std::size_t(p)] = kSkull;
    label[std::size_t(mandible)] = kMandible;
    for (std::size_t v = 0; v < out.mask.size(); ++v)
      out.mask[v] = label[std::size_t(pieces.number[v])];
    return out;
  }

  const Volume& bone_;
  const Mask& region_;
  Grid grid_;
  double bone_hu_;
};

/// Bone of the head: at least its value.
Mask region_of(const Volume& bone, double bone_hu) {
  Mask region(bone.count());
  for (std::size_t v = 0; v < region.size(); ++v) region[v] = bone.hu[v] >= bone_hu ? 1 : 0;
  return region;
}

Markers markers_of_seeds(const Separation& separation, const Volume& bone, const Seeds& seeds,
                         double bone_hu, const std::string& source) {
  const std::size_t skull = value_at_seed(bone, seeds.skull_m, bone_hu, "--seed-skull", source),
                    mandible =
                        value_at_seed(bone, seeds.mandible_m, bone_hu, "--seed-mandible", source);
  const double apart_m =
      std::min((seeds.skull_m - seeds.mandible_m).norm(), separation.between_m(skull, mandible));
  if (apart_m <= 2 * kSeedBall_m)
    throw InputError(
        fmt::format("{}: --seed-skull and --seed-mandible: the two are within {:g} mm; expected a "
                    "point in each",
                    source, 2e3 * kSeedBall_m));
  return separation.by_seeds(skull, mandible);
}

void check_sizes(const Mask& label, const std::string& source) {
  const auto skull = std::count(label.begin(), label.end(), kSkull),
             mandible = std::count(label.begin(), label.end(), kMandible);
  if (mandible > skull)
    throw InputError(
        source +
        ": --seed-skull and --seed-mandible: the mandible would be larger than the skull; expected "
        "a point in each, not the other way round, in dense bone");
}

/// Labels of the crop at their places in the whole volume.
Mask placed(const Mask& label, const Crop& crop, const Volume& volume) {
  Mask out(volume.count(), 0);
  for (int k = 0; k < crop.volume.size[2]; ++k)
    for (int j = 0; j < crop.volume.size[1]; ++j)
      std::copy_n(
          label.begin() + std::ptrdiff_t(crop.volume.at(0, j, k)), crop.volume.size[0],
          out.begin() + std::ptrdiff_t(volume.at(crop.low[0], crop.low[1] + j, crop.low[2] + k)));
  return out;
}

}  // namespace

Bones find_bones(const Body& body, const Thresholds& thresholds, const std::optional<Seeds>& seeds,
                 const std::string& source) {
  const double bone_hu = thresholds.bone_hu;
  const Crop crop = crop_to(body.volume, bone_hu);
  if (crop.volume.hu.empty())
    throw InputError(
        fmt::format("{}: nothing is denser than bone ({:g} HU); expected a CT with bones, "
                    "or another --bone-hu",
                    source, bone_hu));
  const Mask region = region_of(crop.volume, bone_hu);
  const Separation separation(crop.volume, region, bone_hu);
  Markers markers;
  if (seeds)
    markers = markers_of_seeds(separation, crop.volume, *seeds, bone_hu, source);
  else
    markers = separation.by_shape();
  Bones out;
  out.separated = markers.found;
  out.level_hu = markers.found ? markers.level_hu : bone_hu;
  if (markers.found) {
    const Mask label = separation.flooded(markers);
    if (seeds) check_sizes(label, source);
    out.label = placed(label, crop, body.volume);
    return out;
  }
  const Pieces pieces = pieces_of(region, grid_of(crop.volume));
  Mask label(region.size());
  for (std::size_t v = 0; v < label.size(); ++v) label[v] = pieces.number[v] == 1 ? kSkull : 0;
  out.label = placed(label, crop, body.volume);
  return out;
}

Volume bone_alone(const Body& body, const Bones& bones, int part, const Thresholds& thresholds) {
  Volume out = body.volume;
  for (std::size_t v = 0; v < out.hu.size(); ++v) {
    const int label = bones.label[v];
    const bool keeps = part == 0 ? label != 0 : label == part;
    if (!keeps && out.hu[v] >= thresholds.bone_hu) out.hu[v] = float(thresholds.soft_hu);
  }
  return out;
}

}  // namespace hyperex::ct
