// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/mouth_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/fem/solve/complementarity.hpp"

namespace hyperex::simulate {
namespace {

using Eigen::Index;
constexpr double kSettled_m = 10e-6;  // by which pairs may pass when the search ends
/// Pairs with a smaller gap may come into contact within a round.
constexpr double kWithin_m = 1.5e-4;
constexpr int kMostRounds = 12, kMostSweeps = 1000;
/// From this round on, faces of an obstacle that were nearest in earlier rounds are constraints
/// too.
constexpr int kFacesFrom = 4;
constexpr double kSameFace = 0.95;  // cosine between outward normals
constexpr double kSolved_m = 1e-6;
/// Regularisation, relative to the greatest compliance. Many vertices depend on few nodes, so the
/// distribution of the force among them is not unique and does not matter.
constexpr double kRidge = 1e-6;

/// The derivative of a gap with respect to the displacement of each node.
using Row = std::vector<std::pair<int, Vec3>>;

void add_row(const SkinCarrier& from, const Vec3& along, Row& to) {
  for (const auto& [node, weight] : from) to.emplace_back(node, weight * along);
}

/// One entry a node.
void gather(Row& row) {
  std::stable_sort(row.begin(), row.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < row.size(); ++i)
    if (row[i].first == row[last].first)
      row[last].second += row[i].second;
    else
      row[++last] = row[i];
  if (!row.empty()) row.resize(last + 1);
}

Vec3 followed(const SkinCarrier& carrier, const Eigen::VectorXd& nodes) {
  Vec3 out = Vec3::Zero();
  for (const auto& [node, weight] : carrier) out += weight * nodes.segment<3>(3 * node);
  return out;
}

Points followed(const std::vector<SkinCarrier>& carriers, const Eigen::VectorXd& nodes) {
  Points out(Index(carriers.size()), 3);
  for (std::size_t i = 0; i < carriers.size(); ++i)
    out.row(Index(i)) = followed(carriers[i], nodes).transpose();
  return out;
}

}  // namespace

struct MouthContact::Pair {
  double gap_m;
  Row row;
  int place = -1;  // of an obstacle's side, counted through all sides; -1: of the lips
};

namespace {

/// Whether two pairs of the same place belong to the same face of an obstacle. Their rows have the
/// same nodes and weights.
template <class Pair>
bool same_face(const Pair& a, const Pair& b) {
  const Vec3 &m = a.row.front().second, &n = b.row.front().second;
  return m.dot(n) > kSameFace * m.norm() * n.norm();
}

double along(const Row& row, const Eigen::Ref<const Eigen::VectorXd>& moved) {
  double sum = 0;
  for (const auto& [node, derivative] : row) sum += derivative.dot(moved.segment<3>(3 * node));
  return sum;
}

/// Between two teeth a place that is pushed off one enters the other, and back: the nearest face
/// alone leads nowhere. Faces that pressed are therefore kept as planes, with the gap they have
/// where nothing has moved.
template <class Pair>
void keep_faces(const std::vector<Pair>& pairs, const Eigen::VectorXd& lambda,
                std::vector<Pair>& planes) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = pairs[i];
    if (pair.place < 0 || !(lambda[Index(i)] > 0)) continue;
    if (std::none_of(planes.begin(), planes.end(), [&](const Pair& plane) {
          return plane.place == pair.place && same_face(plane, pair);
        }))
      planes.push_back(pair);
  }
}

/// The planes of places among `pairs`, of other faces than theirs.
template <class Pair>
void add_other_faces(const std::vector<Pair>& planes, const Eigen::VectorXd& moved,
                     std::vector<Pair>& pairs) {
  const std::size_t found = pairs.size();
  for (const Pair& plane : planes)
    for (std::size_t i = 0; i < found; ++i)
      if (pairs[i].place == plane.place && !same_face(pairs[i], plane)) {
        Pair& other = pairs.emplace_back(plane);
        other.gap_m += along(other.row, moved);
        break;
      }
}

template <class Pairs>
double depth_of(const Pairs& pairs) {
  double deepest = 0;
  for (const auto& pair : pairs) deepest = std::max(deepest, -pair.gap_m);
  return deepest;
}

}  // namespace

MouthContact::MouthContact(std::shared_ptr<const LipSurfaces> surfaces,
                           std::vector<SkinCarrier> lower, std::vector<SkinCarrier> upper,
                           std::vector<ObstacleSide> sides, std::vector<SkinCarrier> held,
                           double give, const Compliance& compliance)
    : surfaces_(std::move(surfaces)),
      lower_(std::move(lower)),
      upper_(std::move(upper)),
      sides_(std::move(sides)) {
  std::vector<std::vector<SkinCarrier>*> all{&lower_, &upper_, &held};
  for (ObstacleSide& side : sides_) all.push_back(&side.carriers);
  std::map<int, int> place;
  for (const auto* carriers : all)
    for (const SkinCarrier& carrier : *carriers)
      for (const auto& [node, weight] : carrier) place.emplace(node, 0);
  for (auto& [node, at] : place) {
    at = int(nodes_.size());
    nodes_.push_back(node);
  }
  for (auto* carriers : all)
    for (SkinCarrier& carrier : *carriers)
      for (auto& [node, weight] : carrier) node = place.at(node);
  compliance_ = compliance(nodes_);
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

/// Pairs with a gap of at most kWithin_m after nodes_ are also displaced by `moved`.
std::vector<MouthContact::Pair> MouthContact::pairs_at(const FreeFrame& frame, const Points& lower,
                                                       const Points& upper,
                                                       const Eigen::VectorXd& moved) const {
  std::vector<Pair> out;
  if (!lower_.empty())
    for (const LipPair& pair : surfaces_->pairs(lower + followed(lower_, moved),
                                                upper + followed(upper_, moved), kWithin_m)) {
      Row& row = out.emplace_back(Pair{pair.gap_m, {}}).row;
      add_row(lower_[std::size_t(pair.point)], pair.normal, row);
      for (std::size_t k = 0; k < 3; ++k)
        add_row(upper_[std::size_t(pair.on[k])], -pair.weight[Index(k)] * pair.normal, row);
    }
  int place = 0;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const ObstaclePlaces& places = *sides_[s].places;
    const Eigen::Isometry3d pose =
        places.obstacle().now_from_rest(frame.jaw_now_from_rest, frame.upper_teeth_now_from_rest);
    for (Index i = 0; i < places.count(); ++i, ++place) {
      const SkinCarrier& carrier = sides_[s].carriers[std::size_t(i)];
      if (carrier.empty()) continue;
      Vec3 outward;
      const Vec3 at = frame.at_sides[s].row(i).transpose() + followed(carrier, moved);
      const double gap_m = places.gap_m(i, at, pose, outward);
      if (gap_m > kWithin_m) continue;
      add_row(carrier, outward, out.emplace_back(Pair{gap_m, {}, place}).row);
    }
  }
  for (Pair& pair : out) gather(pair.row);
  return out;
}

Eigen::VectorXd MouthContact::force_of(const std::vector<Pair>& pairs,
                                       const Eigen::VectorXd& lambda) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(compliance_.rows());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (lambda[Index(i)] > 0)
      for (const auto& [node, derivative] : pairs[i].row)
        force.segment<3>(3 * node) += lambda[Index(i)] * derivative;
  return force;
}

/// G C G': by how much each pair opens under a unit force of each. Only the nodes of these pairs
/// are needed, a part of nodes_.
void MouthContact::compliance_between(const std::vector<Pair>& pairs,
                                      Eigen::MatrixXd& between) const {
  std::vector<int> place(nodes_.size(), -1), used;
  std::vector<Row> rows;
  for (const Pair& pair : pairs) {
    Row& row = rows.emplace_back(pair.row);
    for (auto& [node, derivative] : row) {
      int& at = place[std::size_t(node)];
      if (at < 0) {
        at = int(used.size());
        used.push_back(node);
      }
      node = at;
    }
  }
  Eigen::MatrixXd part(3 * used.size(), 3 * used.size());
  for (std::size_t c = 0; c < used.size(); ++c)
    for (std::size_t r = 0; r < used.size(); ++r)
      part.block<3, 3>(3 * Index(r), 3 * Index(c)) =
          compliance_.block<3, 3>(3 * Index(used[r]), 3 * Index(used[c]));
  const auto count = Index(pairs.size());
  between.resize(count, count);
  Eigen::VectorXd response(part.rows());
  for (Index k = 0; k < count; ++k) {
    response.setZero();
    for (const auto& [node, derivative] : rows[std::size_t(k)])
      response.noalias() += part.middleCols<3>(3 * Index(node)) * derivative;
    for (Index i = k; i < count; ++i)
      between(i, k) = between(k, i) = along(rows[std::size_t(i)], response);
  }
}

/// Displacement of nodes() by forces on them, most of which are 0.
Eigen::VectorXd MouthContact::moved_by(const Eigen::VectorXd& force) const {
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(compliance_.rows());
  for (Index node = 0; node < Index(nodes_.size()); ++node)
    if (const Vec3 f = force.segment<3>(3 * node); !f.isZero(0))
      moved.noalias() += compliance_.middleCols<3>(3 * node) * f;
  return moved;
}

MouthContact::Correction MouthContact::correct(const FreeFrame& frame) const {
  Correction out;
  const Points lower = frame.skin(surfaces_->lower(), Eigen::all).cast<double>();
  const Points upper = frame.skin(surfaces_->upper(), Eigen::all).cast<double>();
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(compliance_.rows());
  std::vector<Pair> pairs = pairs_at(frame, lower, upper, moved), planes;
  out.before_m = out.after_m = depth_of(pairs);
  out.force.setZero(compliance_.rows());
  out.moved = moved;
  if (out.before_m < kFelt_m) return out;
  Eigen::MatrixXd between;
  Eigen::VectorXd gap, lambda;
  while (out.rounds < kMostRounds && !pairs.empty()) {
    const auto count = Index(pairs.size());
    gap.resize(count);
    for (Index i = 0; i < count; ++i)
      gap[i] = pairs[std::size_t(i)].gap_m - along(pairs[std::size_t(i)].row, moved);
    compliance_between(pairs, between);
    // Pairs that nothing can move (skin that follows the recording, held nodes) are left as they
    // are.
    std::vector<Pair> movable;
    for (Index i = 0; i < count; ++i)
      if (between(i, i) > 0) movable.push_back(pairs[std::size_t(i)]);
    if (movable.size() < pairs.size()) {
      pairs = std::move(movable);
      continue;
    }
    between.diagonal().array() += kRidge * between.diagonal().maxCoeff();
    lambda.setZero(count);
    const fem::Complementarity solved =
        fem::solve_complementarity(between, gap, kSolved_m, kMostSweeps, lambda);
    const Eigen::VectorXd force = force_of(pairs, lambda);
    moved = moved_by(force);
    ++out.rounds;
    std::vector<Pair> now = pairs_at(frame, lower, upper, moved);
    const double depth = depth_of(now);
    if (depth < out.after_m) {
      out.after_m = depth;
      out.residual_m = solved.residual;
      out.moved = moved;
      out.force = force;
      out.pairs = static_cast<int>((lambda.array() > 0).count());
    }
    if (depth < kSettled_m) break;
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].gap_m = gap[Index(i)];
    keep_faces(pairs, lambda, planes);
    pairs = std::move(now);
    if (out.rounds >= kFacesFrom) add_other_faces(planes, moved, pairs);
  }
  if (holding_.rows() > 0) out.force += (holding_ * out.force).eval();
  return out;
}

void MouthContact::take_off(const Eigen::VectorXd& moved, PointsF& skin,
                            std::vector<Points>& at_sides) const {
  const auto off = [&](const std::vector<int>& vertices, const std::vector<SkinCarrier>& carriers) {
    for (std::size_t i = 0; i < carriers.size(); ++i)
      skin.row(vertices[i]) -= followed(carriers[i], moved).cast<float>().transpose();
  };
  off(surfaces_->lower(), lower_);
  off(surfaces_->upper(), upper_);
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for (std::size_t i = 0; i < sides_[s].carriers.size(); ++i)
      at_sides[s].row(Index(i)) -= followed(sides_[s].carriers[i], moved).transpose();
}

}  // namespace hyperex::simulate
