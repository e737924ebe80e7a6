// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/weight_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/gaze.hpp"

namespace hyperex::expression {
namespace {

constexpr double kLarge = 0.3, kStretch_s = 0.3, kStart_s = 0.1, kSlack_s = 1e-9;

/// The name with Left for Right at its end, or Right for Left; empty where neither stands there.
std::string on_other_side(const std::string& name) {
  for (const auto& [one, other] :
       {std::pair<std::string, std::string>{"Left", "Right"}, {"Right", "Left"}})
    if (name.ends_with(one)) return name.substr(0, name.size() - one.size()) + other;
  return "";
}

/// The same shape of the other side; empty for shapes that exist once.
std::string counterpart_of(const std::string& shape) {
  const bool direction =
      is_gaze(shape) || shape.starts_with("jaw") || shape == "mouthLeft" || shape == "mouthRight";
  return direction ? "" : on_other_side(shape);
}

/// Mean weights over an interval, without those of gaze; nothing if the face was not seen in it.
std::optional<Eigen::RowVectorXd> mean_weights(const BlendShapes& shapes, double from_s,
                                               double to_s) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(shapes.weights.cols());
  int count = 0;
  const auto& t = shapes.time_s;
  const auto first = std::lower_bound(t.begin(), t.end(), t.front() + from_s - kSlack_s);
  const auto last = std::upper_bound(t.begin(), t.end(), t.front() + to_s + kSlack_s);
  for (auto k = first - t.begin(); k < last - t.begin(); ++k) {
    const Eigen::RowVectorXd row = shapes.weights.row(k);
    if (row.array().isNaN().all()) continue;
    sum += row.array().isNaN().select(0, row.array()).matrix();  // an empty cell counts as 0
    ++count;
  }
  if (count == 0) return std::nullopt;
  for (std::size_t c = 0; c < shapes.names.size(); ++c)
    if (is_gaze(shapes.names[c])) sum[static_cast<Eigen::Index>(c)] = 0;
  return sum / count;
}

}  // namespace

std::string lost_shapes(const BlendShapes& shapes, const FaceModel& model, double from_s,
                        double to_s) {
  std::set<std::string> made;
  for (const auto* units : {&model.animation_units, &model.recorded_units})
    for (const DeformationUnit& unit : *units)
      for (const std::string& pattern : {unit.arkit, unit.arkit_negative})
        for (const std::string& name : arkit_names(pattern)) made.insert(name);
  std::string text;
  for (std::size_t c = 0; c < shapes.names.size(); ++c) {
    if (made.contains(shapes.names[c]) || is_gaze(shapes.names[c])) continue;
    double most = 0, at_s = 0;
    for (std::size_t k = 0; k < shapes.time_s.size(); ++k) {
      const double t = shapes.time_s[k] - shapes.time_s.front();
      const double w = shapes.weights(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c));
      if (t < from_s - kSlack_s || t > to_s + kSlack_s || !(w > most)) continue;
      most = w;
      at_s = t;
    }
    if (most > kLarge)
      text += fmt::format("{}{} up to {:.2g} at {:.2f} s", text.empty() ? "" : "; ",
                          shapes.names[c], most, at_s);
  }
  return text;
}

MissingSides missing_sides(const BlendShapes& shapes) {
  constexpr double least = 0.05;
  MissingSides out;
  std::vector<std::string> missing;
  for (std::size_t c = 0; c < shapes.names.size(); ++c) {
    const std::string other = counterpart_of(shapes.names[c]);
    if (other.empty()) continue;
    if (std::ranges::find(shapes.names, other) != shapes.names.end()) {
      out.doubtful = true;
      continue;
    }
    const auto weights = shapes.weights.col(static_cast<Eigen::Index>(c)).array();
    const double most = weights.isNaN().select(0, weights).maxCoeff();
    const std::string& column = shapes.columns.empty() ? shapes.names[c] : shapes.columns[c];
    if (most > least)
      missing.push_back(fmt::format("{} ({} reaches {:.2g})", on_other_side(column), column, most));
  }
  if (!missing.empty())
    out.text = fmt::format(
        "columns of one side are missing and count as 0: {}; expected: columns of both sides, with "
        "0 "
        "where a side is still, as otherwise left and right differ",
        fmt::join(missing, ", "));
  out.doubtful = out.doubtful && !missing.empty();
  return out;
}

std::optional<RestInWeights> rest_in_weights(const BlendShapes& shapes) {
  const double length_s = shapes.time_s.back() - shapes.time_s.front();
  const auto start = mean_weights(shapes, 0, kStart_s);
  if (!start || length_s < 2 * kStretch_s) return std::nullopt;
  double least = start->sum(), from_s = 0;
  Eigen::RowVectorXd there = *start;
  double tried_s = -std::numeric_limits<double>::infinity();
  for (const double time_s : shapes.time_s) {
    const double t = time_s - shapes.time_s.front();
    if (t + kStretch_s > length_s + kSlack_s) break;
    if (t - tried_s < kStretch_s / 3 - kSlack_s) continue;
    tried_s = t;
    const auto here = mean_weights(shapes, t, t + kStretch_s);
    if (!here || here->sum() >= least) continue;
    least = here->sum();
    there = *here;
    from_s = t;
  }
  Eigen::Index shape = 0;
  const double falls = (*start - there).maxCoeff(&shape);
  if (falls < kLarge || there.maxCoeff() > kLarge) return std::nullopt;
  return RestInWeights{from_s, from_s + kStretch_s, shapes.names[static_cast<std::size_t>(shape)],
                       (*start)[shape], there[shape]};
}

}  // namespace hyperex::expression
