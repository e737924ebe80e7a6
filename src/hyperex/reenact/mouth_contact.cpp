// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/mouth_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/fem/solve/complementarity.hpp"
#include "hyperex/fem/solve/condensed_inverse.hpp"

namespace hyperex::reenact {
namespace {

using Eigen::Index;
constexpr double kSettled_m = 10e-6;  // by which pairs may pass when the search ends
constexpr double kWithin_m = 5e-4;    // pairs as near as this may come to touch in a round
constexpr int kMostRounds = 12, kMostSweeps = 1000;
constexpr double kSolved_m = 1e-6;
/// Of the greatest compliance: many vertices hang on few nodes, and how they share the force does
/// not matter.
constexpr double kRidge = 1e-6;

/// The derivative of a gap: what each node's motion, along the pair's normal, adds to it.
using Row = std::vector<std::pair<int, double>>;

void add(const SkinCarrier& from, double factor, Row& to) {
  for (const auto& [node, weight] : from) to.emplace_back(node, factor * weight);
}

/// One entry a node.
void gather(Row& row) {
  std::sort(row.begin(), row.end());
  std::size_t last = 0;
  for (std::size_t i = 1; i < row.size(); ++i)
    if (row[i].first == row[last].first)
      row[last].second += row[i].second;
    else
      row[++last] = row[i];
  if (!row.empty()) row.resize(last + 1);
}

Points followed(const std::vector<SkinCarrier>& carriers, const Eigen::VectorXd& nodes) {
  Points out = Points::Zero(Index(carriers.size()), 3);
  for (std::size_t i = 0; i < carriers.size(); ++i)
    for (const auto& [node, weight] : carriers[i])
      out.row(Index(i)) += weight * nodes.segment<3>(3 * node).transpose();
  return out;
}

double depth_of(const std::vector<LipPair>& pairs) {
  double deepest = 0;
  for (const LipPair& pair : pairs) deepest = std::max(deepest, -pair.gap_m);
  return deepest;
}

}  // namespace

MouthContact::MouthContact(std::shared_ptr<const LipSurfaces> surfaces,
                           std::vector<SkinCarrier> lower, std::vector<SkinCarrier> upper,
                           std::vector<SkinCarrier> held, double give,
                           fem::PartitionedFactor& factor)
    : surfaces_(std::move(surfaces)), lower_(std::move(lower)), upper_(std::move(upper)) {
  std::map<int, int> place;
  for (const auto* lip : {&lower_, &upper_, &held})
    for (const SkinCarrier& carrier : *lip)
      for (const auto& [node, weight] : carrier) place.emplace(node, 0);
  for (auto& [node, at] : place) {
    at = int(nodes_.size());
    nodes_.push_back(node);
  }
  for (auto* lip : {&lower_, &upper_, &held})
    for (SkinCarrier& carrier : *lip)
      for (auto& [node, weight] : carrier) node = place.at(node);
  compliance_ = fem::condensed_inverse(factor, nodes_);
  if (held.empty()) return;
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(3 * Index(held.size()), compliance_.rows());
  for (std::size_t p = 0; p < held.size(); ++p)
    for (const auto& [node, weight] : held[p])
      at.block<3, 3>(3 * Index(p), 3 * node).diagonal().array() += weight;
  const Eigen::MatrixXd moved = at * compliance_;
  Eigen::MatrixXd own = moved * at.transpose();
  own.diagonal().array() += give * own.diagonal().mean();
  const Eigen::MatrixXd reaction = own.ldlt().solve(moved);
  holding_ = -at.transpose() * reaction;
  compliance_ -= moved.transpose() * reaction;
  compliance_ = 0.5 * (compliance_ + compliance_.transpose()).eval();
}

MouthContact::Correction MouthContact::correct(const PointsF& skin) const {
  Correction out;
  const Points lower_free = skin(surfaces_->lower(), Eigen::all).cast<double>();
  const Points upper_free = skin(surfaces_->upper(), Eigen::all).cast<double>();
  std::vector<LipPair> pairs = surfaces_->pairs(lower_free, upper_free, kWithin_m);
  out.before_m = out.after_m = depth_of(pairs);
  out.force.setZero(compliance_.rows());
  if (out.before_m < kFelt_m) return out;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(compliance_.rows());
  std::vector<Row> rows;
  Eigen::MatrixXd response, between;
  Eigen::VectorXd gap, lambda;
  while (out.rounds < kMostRounds && !pairs.empty()) {
    const auto count = Index(pairs.size());
    rows.assign(pairs.size(), {});
    gap.resize(count);
    response.setZero(compliance_.rows(), count);
    for (Index i = 0; i < count; ++i) {
      const LipPair& pair = pairs[std::size_t(i)];
      Row& row = rows[std::size_t(i)];
      add(lower_[std::size_t(pair.point)], 1, row);
      for (int k = 0; k < 3; ++k)
        add(upper_[std::size_t(pair.on[std::size_t(k)])], -pair.weight[k], row);
      gather(row);
      gap[i] = pair.gap_m;
      for (const auto& [node, weight] : row) {
        gap[i] -= weight * pair.normal.dot(moved.segment<3>(3 * node));
        response.col(i).noalias() +=
            compliance_.middleCols<3>(3 * Index(node)) * (weight * pair.normal);
      }
    }
    between.resize(count, count);
    for (Index i = 0; i < count; ++i)
      for (Index k = 0; k <= i; ++k) {
        double sum = 0;
        for (const auto& [node, weight] : rows[std::size_t(i)])
          sum += weight * pairs[std::size_t(i)].normal.dot(response.col(k).segment<3>(3 * node));
        between(i, k) = between(k, i) = sum;
      }
    // Pairs that nothing can move (skin that follows the recording, held nodes) are left as they
    // are.
    std::vector<LipPair> movable;
    for (Index i = 0; i < count; ++i)
      if (between(i, i) > 0) movable.push_back(pairs[std::size_t(i)]);
    if (movable.size() < pairs.size()) {
      pairs = movable;
      continue;
    }
    between.diagonal().array() += kRidge * between.diagonal().maxCoeff();
    lambda.setZero(count);
    const fem::Complementarity solved =
        fem::solve_complementarity(between, gap, kSolved_m, kMostSweeps, lambda);
    moved.noalias() = response * lambda;
    ++out.rounds;
    const std::vector<LipPair> now = surfaces_->pairs(
        lower_free + followed(lower_, moved), upper_free + followed(upper_, moved), kWithin_m);
    const double depth = depth_of(now);
    if (depth < out.after_m) {
      out.after_m = depth;
      out.residual_m = solved.residual;
      out.force.setZero(compliance_.rows());
      out.pairs = 0;
      for (Index i = 0; i < count; ++i) {
        if (lambda[i] <= 0) continue;
        ++out.pairs;
        for (const auto& [node, weight] : rows[std::size_t(i)])
          out.force.segment<3>(3 * node) += lambda[i] * weight * pairs[std::size_t(i)].normal;
      }
    }
    if (depth < kSettled_m) break;
    pairs = now;
  }
  if (holding_.rows() > 0) out.force += (holding_ * out.force).eval();
  return out;
}

}  // namespace hyperex::reenact
