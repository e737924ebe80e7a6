// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/register_face.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lip_line.hpp"
#include "hyperex/core/assert.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
/// 4 |V| x 3: the affine maps, transposed and stacked.
using Maps = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// Internal unit of length, so that the linear part and the shift of a map have equal weight.
constexpr double kUnit = 0.1;
// A hole of the scan is taken for an opening of the face when its length is this near to the
// opening's own and its middle this near to the opening's middle, in parts of that length.
constexpr double kLoopLengthRatio = 1.6, kLoopOffset = 0.12;

std::vector<std::pair<int, int>> edges_of(const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int c = 0; c < 3; ++c)
      edges.insert(std::minmax(triangles(f, c), triangles(f, (c + 1) % 3)));
  return {edges.begin(), edges.end()};
}

Vec3 loop_middle(const Points& points, const std::vector<int>& loop) {
  Vec3 sum = Vec3::Zero();
  for (const int vertex : loop) sum += points.row(vertex).transpose();
  return sum / double(loop.size());
}

Vec3 closest_on_line(const Vec3& p, const Points& line) {
  Vec3 best = p;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i + 1 < line.rows(); ++i) {
    const Vec3 a = line.row(i), b = line.row(i + 1);
    const double share =
        std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-30), 0.0, 1.0);
    const Vec3 q = a + share * (b - a);
    if ((q - p).squaredNorm() < least) {
      least = (q - p).squaredNorm();
      best = q;
    }
  }
  return best;
}

/// The scan, with what the search for closest points needs.
class Target {
 public:
  explicit Target(const TriMesh& scan)
      : scan_(scan), tree_(scan), loops_(boundary_loops(scan.triangles)) {
    on_border_.assign(std::size_t(scan.points.rows()), false);
    for (const auto& loop : loops_)
      for (const int vertex : loop) on_border_[std::size_t(vertex)] = true;
  }

  const std::vector<std::vector<int>>& loops() const { return loops_; }
  const TriMesh& scan() const { return scan_; }

  /// Closest point of the surface; nothing where that is on the border (the surface ends there),
  /// too far or turned away.
  bool closest(const Vec3& p, const Vec3& normal, const RegisterOptions& options, Vec3& q) const {
    const ClosestPoint hit = tree_.query(p);
    if (hit.squared_distance > options.max_distance_m * options.max_distance_m) return false;
    bool border = true;
    for (int c = 0; c < 3; ++c)
      if (hit.weights[c] > 1e-9 && !on_border_[std::size_t(scan_.triangles(hit.triangle, c))])
        border = false;
    if (border) return false;
    const auto corner = [&](int c) -> Vec3 {
      return scan_.points.row(scan_.triangles(hit.triangle, c));
    };
    const Vec3 there = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const double least = std::cos(options.max_angle_deg * std::numbers::pi / 180);
    if (there.dot(normal) < least * there.norm() * normal.norm()) return false;
    q = hit.point;
    return true;
  }

 private:
  const TriMesh& scan_;
  SurfaceTree tree_;
  std::vector<std::vector<int>> loops_;
  std::vector<bool> on_border_;
};

/// The hole of the scan, if any, that is this opening of the face; -1 where there is none.
int find_opening(const Target& target, const Points& face, const std::vector<int>& contour) {
  const double length = loop_length(contour, face);
  const Vec3 middle = loop_middle(face, contour);
  int best = -1;
  double least = kLoopOffset * length;
  for (std::size_t i = 0; i < target.loops().size(); ++i) {
    const double ratio = loop_length(target.loops()[i], target.scan().points) / length;
    if (ratio > kLoopLengthRatio || ratio < 1 / kLoopLengthRatio) continue;
    const double offset = (loop_middle(target.scan().points, target.loops()[i]) - middle).norm();
    if (offset < least) {
      least = offset;
      best = int(i);
    }
  }
  return best;
}

bool same_pattern(const Sparse& a, const Sparse& b) {
  return a.nonZeros() == b.nonZeros() && a.cols() == b.cols() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// One step of the registration: the maps of least squares.
class Solver {
 public:
  Solver(const Points& rest, const Triangles& triangles)
      : rest_(rest), edges_(edges_of(triangles)) {}

  struct Pull {
    Eigen::SparseVector<double> row;  ///< over the 4 |V| unknowns
    Vec3 target;
    double weight;
  };

  Pull pull_of_vertices(const std::vector<int>& vertices, const Vec3& target, double weight) const {
    Pull pull{Eigen::SparseVector<double>(4 * rest_.rows()), target, weight};
    for (const int v : vertices) {
      const double share = 1.0 / double(vertices.size());
      for (int c = 0; c < 3; ++c) pull.row.coeffRef(4 * v + c) += share * rest_(v, c);
      pull.row.coeffRef(4 * v + 3) += share;
    }
    return pull;
  }

  Points solve(double stiffness, const std::vector<Pull>& pulls) {
    const Eigen::Index unknowns = 4 * rest_.rows();
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [a, b] : edges_)
      for (int c = 0; c < 4; ++c) {
        const double w = stiffness * stiffness;
        entries.emplace_back(4 * a + c, 4 * a + c, w);
        entries.emplace_back(4 * b + c, 4 * b + c, w);
        entries.emplace_back(4 * a + c, 4 * b + c, -w);
        entries.emplace_back(4 * b + c, 4 * a + c, -w);
      }
    Maps right = Maps::Zero(unknowns, 3);
    for (const auto& pull : pulls) {
      const double w = pull.weight * pull.weight;
      for (Eigen::SparseVector<double>::InnerIterator i(pull.row); i; ++i) {
        right.row(i.index()) += w * i.value() * pull.target.transpose();
        for (Eigen::SparseVector<double>::InnerIterator j(pull.row); j; ++j)
          entries.emplace_back(i.index(), j.index(), w * i.value() * j.value());
      }
    }
    // Keeps the system regular where no pull reaches a part of the affine map (flat patches); the
    // zeros make room for every pull of a vertex.
    for (Eigen::Index i = 0; i < unknowns; ++i)
      for (Eigen::Index j = i / 4 * 4; j < i / 4 * 4 + 4; ++j)
        entries.emplace_back(i, j, i == j ? 1e-9 : 0.0);
    Sparse normal(unknowns, unknowns);
    normal.setFromTriplets(entries.begin(), entries.end());
    // The rounds differ in which vertices are pulled, and so in values alone: ordering takes most
    // of the time.
    if (!same_pattern(normal, ordered_)) factor_.analyzePattern(normal);
    factor_.factorize(normal);
    ordered_.swap(normal);
    HX_ASSERT(factor_.info() == Eigen::Success);
    const Maps maps = factor_.solve(right);
    Points moved(rest_.rows(), 3);
    for (Eigen::Index v = 0; v < rest_.rows(); ++v) {
      const Eigen::RowVector4d here(rest_(v, 0), rest_(v, 1), rest_(v, 2), 1);
      moved.row(v) = here * maps.middleRows<4>(4 * v);
    }
    return moved;
  }

 private:
  Points rest_;
  std::vector<std::pair<int, int>> edges_;
  Eigen::SimplicialLDLT<Sparse> factor_;
  Sparse ordered_;
};

/// Vertex -> where the scan's surface, or the border of its eye openings, pulls it to.
std::vector<std::pair<int, Vec3>> surface_pulls(const Target& target, const Points& points,
                                                const RegisterOptions& options) {
  std::vector<std::pair<int, Vec3>> pulls;
  // Lids and lips end at their contours: the nearest surface there need not be theirs.
  std::vector<bool> on_contour(std::size_t(points.rows()), false);
  for (const int v : lip_contour()) on_contour[std::size_t(v)] = true;
  for (const auto* contour : {&right_eye_contour(), &left_eye_contour()}) {
    const int loop = find_opening(target, points, *contour);
    for (const int v : *contour) on_contour[std::size_t(v)] = true;
    if (loop < 0) continue;
    Points border(Eigen::Index(target.loops()[std::size_t(loop)].size()) + 1, 3);
    for (Eigen::Index i = 0; i + 1 < border.rows(); ++i)
      border.row(i) = target.scan().points.row(target.loops()[std::size_t(loop)][std::size_t(i)]);
    border.bottomRows<1>() = border.topRows<1>();
    for (const int v : *contour) pulls.emplace_back(v, closest_on_line(points.row(v), border));
  }
  const Points normals = vertex_normals({points, canonical_face().mesh.triangles});
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    Vec3 q;
    if (!on_contour[std::size_t(v)] && target.closest(points.row(v), normals.row(v), options, q))
      pulls.emplace_back(int(v), q);
  }
  return pulls;
}

/// The middle between the inner lips, from the right corner of the mouth to the left.
Points lip_line_guess(const Points& points) {
  const std::vector<int>& contour =
      lip_contour();  // right corner, upper lip, left corner, lower lip
  const std::size_t half = contour.size() / 2;
  Points guess(Eigen::Index(half) + 3, 3);
  const CanonicalFace& face = canonical_face();
  guess.topRows<1>() = face.landmark("cheilion_R", points).transpose();
  guess.bottomRows<1>() = face.landmark("cheilion_L", points).transpose();
  for (std::size_t i = 0; i <= half; ++i)
    guess.row(Eigen::Index(i) + 1) =
        0.5 * (points.row(contour[i]) + points.row(contour[(contour.size() - i) % contour.size()]));
  return guess;
}

}  // namespace

RegisteredFace register_canonical_face(const io::Landmarks& given, const TriMesh& scan,
                                       const RegisterOptions& options) {
  const CanonicalFace& face = canonical_face();
  std::vector<std::string> known;
  for (const auto& [name, position] : given)
    if (face.landmarks.contains(name)) known.push_back(name);
  HX_ASSERT(known.size() >= 3);
  Points there(Eigen::Index(known.size()), 3), here = there;
  for (std::size_t i = 0; i < known.size(); ++i) {
    there.row(Eigen::Index(i)) = given.at(known[i]).transpose();
    here.row(Eigen::Index(i)) = face.landmark(known[i], face.mesh.points).transpose();
  }
  RegisteredFace result;
  result.scan_from_canonical = fit_similarity(here, there);
  result.points = result.scan_from_canonical.apply(face.mesh.points);
  result.rms_landmarks_m = rms_distance(result.scan_from_canonical.apply(here), there);

  const Target target(scan);
  const Vec3 origin = result.points.colwise().mean();
  Solver solver((result.points.rowwise() - origin.transpose()) / kUnit, face.mesh.triangles);
  std::optional<LipLine> lip_line;
  const auto run_stages = [&](std::size_t first) {
    for (std::size_t stage = first; stage < options.stiffness.size(); ++stage)
      for (int round = 0; round < options.rounds_per_stage; ++round) {
        std::vector<Solver::Pull> pulls;
        for (const auto& [vertex, q] : surface_pulls(target, result.points, options))
          pulls.push_back(solver.pull_of_vertices({vertex}, (q - origin) / kUnit, 1));
        if (lip_line)
          for (const int v : lip_contour())
            pulls.push_back(solver.pull_of_vertices(
                {v}, (closest_on_line(result.points.row(v), lip_line->points) - origin) / kUnit,
                1));
        for (const auto& name : known)
          pulls.push_back(solver.pull_of_vertices(
              face.landmarks.at(name), (given.at(name) - origin) / kUnit, options.landmark_weight));
        result.points =
            (kUnit * solver.solve(options.stiffness[stage], pulls)).rowwise() + origin.transpose();
      }
  };
  run_stages(0);
  lip_line =
      find_lip_line(scan, lip_line_guess(result.points), result.scan_from_canonical.rotation);
  result.lip_line_found = lip_line.has_value();
  if (lip_line) run_stages(options.stiffness.size() / 2);
  return result;
}

}  // namespace hyperex::anatomy
