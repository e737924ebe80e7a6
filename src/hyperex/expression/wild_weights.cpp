// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/wild_weights.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/stays.hpp"

namespace hyperex::expression {
namespace {

constexpr std::size_t kWindow = 5;
constexpr double kAlone = 1.0 / 3;  // of the jump: the most that the readings beside it may differ
constexpr double kSlack = 1.02;     // times in a file are rounded, and 24 Hz may be 23.976

bool is_fast(const std::string& shape) {
  return shape.starts_with("eye") || shape == "tongueOut";
}

/// The readings of one weight, without empty cells.
struct Track {
  std::vector<std::size_t> sample;
  std::vector<double> time_s, weight;
};

Track track_of(const BlendShapes& shapes, std::size_t shape) {
  Track track;
  for (std::size_t k = 0; k < shapes.time_s.size(); ++k) {
    const double w = shapes.weights(Eigen::Index(k), Eigen::Index(shape));
    if (!std::isfinite(w)) continue;
    track.sample.push_back(k);
    track.time_s.push_back(shapes.time_s[k]);
    track.weight.push_back(w);
  }
  return track;
}

bool is_at_end(const Track& track, std::size_t i) {
  return i == 0 || i + 1 == track.weight.size();
}

/// The longer one of the times to the readings before and after, s.
double step_s(const Track& track, std::size_t i) {
  const auto& t = track.time_s;
  return std::max(i > 0 ? t[i] - t[i - 1] : 0, i + 1 < t.size() ? t[i + 1] - t[i] : 0);
}

/// The reading minus the median around it, if it is far off and alone.
std::optional<double> jump_of(const Track& track, std::size_t i) {
  const auto& w = track.weight;
  // At the ends the window is shifted, not shortened.
  const std::size_t first = std::min(i > kWindow / 2 ? i - kWindow / 2 : 0, w.size() - kWindow);
  const auto window = w.begin() + std::ptrdiff_t(first);
  const double middle = median({window, window + kWindow}), off = w[i] - middle;
  if (std::abs(off) <= kWildWeight * std::max(1.0, step_s(track, i) / (kSlack * kWildWeight_s)))
    return std::nullopt;
  const auto agrees = [&](std::size_t j, double with) {
    return std::abs(w[j] - with) <= kAlone * std::abs(off);
  };
  bool alone = true;
  if (is_at_end(track, i)) {
    for (std::size_t j = first; j < first + kWindow; ++j) alone &= j == i || agrees(j, middle);
  } else {
    alone = agrees(i - 1, middle) && agrees(i + 1, middle) && (i < 2 || agrees(i - 1, w[i - 2])) &&
            (i + 2 >= w.size() || agrees(i + 1, w[i + 2]));
  }
  return alone ? std::optional(off) : std::nullopt;
}

/// Several readings at a wrong weight. A single one is for jump_of().
std::vector<motion::Stay> stays_of(const Track& track) {
  const auto at = [&](std::size_t i) { return Eigen::RowVector3d(track.weight[i], 0, 0); };
  const auto is_longer = [](const motion::Stay& stay) { return stay.after > stay.before + 2; };
  return motion::stays_of(at, track.time_s, {kWildWeight, kSlack * kWildWeight_s, is_longer});
}

/// Reading i on the line in time through two others.
double between(const Track& track, std::size_t before, std::size_t i, std::size_t after) {
  const auto& [sample, t, w] = track;
  const double share = (t[i] - t[before]) / (t[after] - t[before]);
  return (1 - share) * w[before] + share * w[after];
}

/// Mends brief stays of a weight, and names longer ones.
void settle_stays(const Track& track, std::size_t shape, BlendShapes& shapes, MendedShapes& out) {
  for (const motion::Stay& stay : stays_of(track)) {
    const bool mended = motion::is_mended(stay, track.time_s);
    for (std::size_t i = stay.before + 1; i < stay.after; ++i) {
      const double right = between(track, stay.before, i, stay.after);
      (mended ? out.wild : out.doubtful)
          .push_back({track.sample[i], shape, track.weight[i] - right});
      if (mended) shapes.weights(Eigen::Index(track.sample[i]), Eigen::Index(shape)) = right;
    }
  }
}

/// The place of each reading, as "weights.csv:22, mouthSmileLeft at 0.333 s: by +0.65".
std::vector<std::string> places_of(const BlendShapes& shapes,
                                   const std::vector<WildWeight>& readings) {
  const auto& columns = shapes.columns.empty() ? shapes.names : shapes.columns;
  std::vector<std::string> places;
  std::optional<std::pair<std::size_t, std::string>> last;
  for (const WildWeight& reading : readings) {
    const auto cell = std::pair(reading.sample, columns[reading.shape]);
    if (std::exchange(last, cell) == cell) continue;
    std::string at = shapes.file.string();
    if (reading.sample < shapes.lines.size())
      at += fmt::format(":{}", shapes.lines[reading.sample]);
    places.push_back(fmt::format("{}, {} at {:.3f} s: by {:+.2f}", at, cell.second,
                                 shapes.time_s[reading.sample], reading.off));
  }
  return places;
}

std::string first_of(std::vector<std::string> places) {
  constexpr std::size_t most_named = 3;
  const std::size_t all = places.size();
  places.resize(std::min(all, most_named));
  add_rest(places, all);
  return fmt::format("{}", fmt::join(places, "; "));
}

}  // namespace

MendedShapes without_wild_weights(BlendShapes shapes) {
  MendedShapes out;
  for (std::size_t c = 0; c < shapes.names.size(); ++c) {
    if (is_fast(shapes.names[c])) continue;
    const Track track = track_of(shapes, c);
    for (std::size_t i = 0; track.weight.size() >= kWindow && i < track.weight.size(); ++i) {
      const std::optional<double> off = jump_of(track, i);
      if (!off) continue;
      const std::size_t k = track.sample[i];
      const bool real = is_at_end(track, i) || step_s(track, i) > kSlack * kWildWeight_s;
      (real ? out.doubtful : out.wild).push_back({k, c, *off});
      if (!real) shapes.weights(Eigen::Index(k), Eigen::Index(c)) = between(track, i - 1, i, i + 1);
    }
    if (track.weight.size() >= kWindow) settle_stays(track, c, shapes, out);
  }
  const auto place = [](const WildWeight& w) { return std::pair(w.sample, w.shape); };
  std::ranges::sort(out.wild, {}, place);
  std::ranges::sort(out.doubtful, {}, place);
  out.shapes = std::move(shapes);
  return out;
}

std::string wild_weights_sentence(const MendedShapes& mended) {
  if (mended.wild.empty()) return "";
  const auto places = places_of(mended.shapes, mended.wild);
  return fmt::format(
      "a weight jumps away and soon back, which no face does; {} such reading{} left out and "
      "interpolated: {}",
      places.size(), places.size() > 1 ? "s were" : " was", first_of(places));
}

std::string doubtful_weights_sentence(const MendedShapes& mended) {
  if (mended.doubtful.empty()) return "";
  const auto places = places_of(mended.shapes, mended.doubtful);
  return fmt::format(
      "a weight jumps where a face could: at an end of the recording, between readings more than "
      "1/24 s apart, or away for more than 0.2 s; {} such reading{} kept, so correct what is wrong "
      "or leave its cell empty: {}",
      places.size(), places.size() > 1 ? "s were" : " was", first_of(places));
}

}  // namespace hyperex::expression
