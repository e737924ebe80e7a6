// SPDX-License-Identifier: GPL-3.0-or-later
// Contact: frames that were found without it, corrected.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/solve/condensed_inverse.hpp"
#include "hyperex/simulate/contact/finite_correction.hpp"
#include "hyperex/simulate/drive/support.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kHeldNear_m = 0.015;  // of what touches: farther points need not be held
constexpr int kMostFiniteRounds = 20, kMostIdleRounds = 3, kMostHalvings = 3;
constexpr double kFiniteSettled_m = 2e-5;
constexpr double kMayTouch_m = 0.0015;  // places never as near to an obstacle do without contact

/// Springs that hold driven nodes where they are driven, as contact feels them.
void add_patches(const tissue::TissueMesh& mesh, const std::vector<int>& nodes,
                 double stiffness_pa_per_m, fem::SparseMatrix& stiffness) {
  const Eigen::VectorXd areas = node_areas(mesh.volume.outer);
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis)
      stiffness.coeffRef(3 * node + axis, 3 * node + axis) += areas[node] * stiffness_pa_per_m;
}

/// Of the driven points near what may touch.
std::vector<SkinCarrier> carriers_near(const tissue::TissueMesh& mesh, const DrivenPoints& points,
                                       const Points& touching) {
  const CarrierMatrix all = carriers(mesh, points.places);
  std::vector<SkinCarrier> near;
  if (touching.rows() == 0) return near;
  for (Eigen::Index p = 0; p < all.rows(); ++p) {
    if ((touching.rowwise() - points.rest.row(p)).rowwise().norm().minCoeff() > kHeldNear_m)
      continue;
    SkinCarrier& one = near.emplace_back();
    for (CarrierMatrix::InnerIterator it(all, p); it; ++it)
      one.emplace_back(int(it.col()), it.value());
  }
  return near;
}

/// Columns of the free unknowns, of forces on some nodes.
Eigen::MatrixXd on_free(const fem::PartitionedFactor& factor, Eigen::Index unknowns,
                        const std::vector<int>& nodes, const Eigen::MatrixXd& force) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, force.cols());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    all.middleRows<3>(3 * Eigen::Index(nodes[n])) = force.middleRows<3>(3 * Eigen::Index(n));
  return all(factor.free(), Eigen::all);
}

}  // namespace

/// The stiffness that contact works against, in an order that ends with the nodes that may touch:
/// what they feel can then be read off the factor.
void Simulator::Impl::make_contact_factor(const std::vector<int>& nodes) {
  fem::System system;
  assembler->assemble(material(), system);
  boundary->add_springs(system.stiffness);
  std::vector<int> prescribed = boundary->prescribed();
  if (!by_forces()) {
    add_patches(*mesh, boundary->driven_nodes(), options.contact.patch_pa_per_m, system.stiffness);
    prescribed = boundary->released().prescribed();
  }
  std::shared_ptr<const fem::NodeOrder> last;
  if (order)
    last = std::make_shared<const fem::NodeOrder>(fem::order_with_last(
        *order->nodes, order->prescribed, prescribed, int(3 * mesh->volume.nodes.rows()), nodes));
  contact_factor.emplace(std::move(system.stiffness), std::move(prescribed), "contact",
                         mesh->volume.nodes, options.solver.linear, std::move(last));
}

void Simulator::Impl::need_contact(std::vector<std::vector<char>> coming_near) {
  if (contact && contact_near == coming_near) return;
  drop_contact();
  const auto of_skin = [&](const std::vector<int>& vertices) {
    return skin_carriers(*mesh, driven_points->rim, *region, vertices);
  };
  const std::shared_ptr<const LipSurfaces>& lips = readout->lip_surfaces();
  std::vector<SkinCarrier> lower, upper;
  std::vector<Vec3> touching;
  if (options.contact.lips) {
    lower = of_skin(lips->lower());
    upper = of_skin(lips->upper());
    for (const Points* rest : {&lips->lower_rest(), &lips->upper_rest()})
      for (const Vec3& p : rest->rowwise()) touching.push_back(p);
  }
  std::vector<ObstacleSide> sides;
  for (std::size_t s = 0; s < touchable->size(); ++s) {
    const std::shared_ptr<const ObstaclePlaces>& all = (*touchable)[s];
    std::vector<SkinCarrier> carriers = of_skin(all->skin());
    for (const int node : all->nodes()) carriers.push_back({{node, 1.0}});
    for (std::size_t i = 0; i < carriers.size(); ++i)
      if (!coming_near[s][i])
        carriers[i].clear();
      else
        touching.push_back(all->rest().row(Eigen::Index(i)));
    sides.push_back({all, std::move(carriers)});
  }
  Points about(Eigen::Index(touching.size()), 3);
  for (std::size_t i = 0; i < touching.size(); ++i)
    about.row(Eigen::Index(i)) = touching[i].transpose();
  contact.emplace(
      lips, std::move(lower), std::move(upper), std::move(sides),
      by_forces() ? carriers_near(*mesh, *driven_points, about) : std::vector<SkinCarrier>(),
      options.contact.point_give, [&](const std::vector<int>& nodes) {
        make_contact_factor(nodes);
        ask();
        return fem::condensed_inverse(*contact_factor, nodes);
      });
  contact_near = std::move(coming_near);
}

void Simulator::Impl::need_places() {
  if (touchable) return;
  auto found = std::make_shared<std::vector<std::shared_ptr<const ObstaclePlaces>>>();
  if (obstacles)
    for (const Obstacle& obstacle : *obstacles)
      if (obstacle.kind == Obstacle::Kind::teeth ? options.contact.teeth : options.contact.eyes)
        found->push_back(std::make_shared<const ObstaclePlaces>(*mesh, *landmarks, obstacle));
  touchable = std::move(found);
}

/// Frames in which something touches, as they are without contact.
struct Simulator::Impl::Touching {
  const std::vector<Shot>& shots;
  const std::vector<std::size_t>& which;  // of the shots
  const std::vector<PointsF>& skin;       // of each of `which`
  const std::vector<std::vector<Points>>& at_sides;
  const std::vector<Eigen::Isometry3d>& jaw_now_from_rest;
  const PointCurve& points;
};

double Simulator::Impl::correct_linear(const Touching& frames, Solution& solution) {
  const std::size_t count = frames.which.size();
  std::vector<MouthContact::Correction> corrections(count);
  for_frames(count, [&](std::size_t i) {
    corrections[i] =
        contact->correct({frames.skin[i], frames.at_sides[i], frames.jaw_now_from_rest[i]});
  });
  Eigen::MatrixXd force(3 * Eigen::Index(contact->nodes().size()), Eigen::Index(count));
  double residual_m = 0;
  for (std::size_t i = 0; i < count; ++i) {
    force.col(Eigen::Index(i)) = corrections[i].force;
    residual_m = std::max(residual_m, corrections[i].residual_m);
  }
  fem::PartitionedFactor& factor = *contact_factor;
  Eigen::MatrixXd moved = on_free(factor, solution.displacement.rows(), contact->nodes(), force);
  factor.solve(moved);
  for (std::size_t i = 0; i < count; ++i) {
    auto column = solution.displacement.col(Eigen::Index(frames.which[i]));
    for (std::size_t u = 0; u < factor.free().size(); ++u)
      column[factor.free()[u]] += moved(Eigen::Index(u), Eigen::Index(i));
  }
  return residual_m;
}

double Simulator::Impl::correct_finite(const Touching& frames, Solution& solution) {
  fem::SparseMatrix springs = assembler->stiffness_pattern();
  boundary->add_springs(springs);
  std::vector<int> prescribed = boundary->prescribed();
  if (!by_forces()) {
    add_patches(*mesh, boundary->driven_nodes(), options.contact.patch_pa_per_m, springs);
    prescribed = boundary->released().prescribed();
  }
  springs.prune(0.0);
  fem::FiniteNewtonOptions how;
  how.tolerance = options.solver.finite_tolerance;
  how.most_halvings = kMostHalvings;
  FiniteCorrection tissue(*assembler, material(), options.model.law, std::move(springs),
                          std::move(prescribed), how, options.solver.linear,
                          by_forces() ? known_order() : nullptr);
  double residual_m = 0, hopeless_m = std::numeric_limits<double>::infinity();
  int given_up = 0;
  const auto depth_of = [&](std::size_t i, const PointsF& skin, const std::vector<Points>& sides) {
    double deepest = options.contact.lips ? readout->lip_surfaces()->depth(skin) : 0;
    for (std::size_t s = 0; s < touchable->size(); ++s) {
      const ObstaclePlaces& side = *(*touchable)[s];
      deepest = std::max(
          deepest, side.depth(sides[s], side.obstacle().with_jaw ? frames.jaw_now_from_rest[i]
                                                                 : Eigen::Isometry3d::Identity()));
    }
    return deepest;
  };
  // What contact did in the frame before, altogether and to first order at rest: where the frame
  // after it begins.
  std::size_t last = 0;
  Eigen::VectorXd last_pushed, last_moved, guess;
  for (std::size_t i = 0; i < frames.which.size(); ++i) {
    ask();
    auto column = solution.displacement.col(Eigen::Index(frames.which[i]));
    const Eigen::VectorXd d0 = column;
    const Points points = frames.points.at(frames.shots[frames.which[i]].time_s);
    PointsF skin = frames.skin[i];
    std::vector<Points> sides = frames.at_sides[i];
    const auto look_at = [&](const Eigen::VectorXd& d) {
      const Eigen::Map<const Points> nodes(d.data(), mesh->volume.nodes.rows(), 3);
      skin = readout->skin(*region, driven_points->rim, nodes, points);
      for (std::size_t s = 0; s < touchable->size(); ++s)
        sides[s] = (*touchable)[s]->moved(skin, nodes);
    };
    double least_m = depth_of(i, skin, sides);
    if (least_m >= hopeless_m) {
      ++given_up;
      continue;
    }
    tissue.begin(d0);
    double own_residual_m = 0;
    Eigen::VectorXd moved, more;
    const bool follows = last_pushed.size() > 0 && frames.which[i] == last + 1;
    if (follows) {
      guess = d0 + last_pushed;
      moved = last_moved;
      look_at(guess);
    }
    last_pushed.resize(0);
    int idle = 0;  // rounds in a row that gain little
    for (int round = 0;
         round < kMostFiniteRounds && idle < kMostIdleRounds && least_m > kFiniteSettled_m;
         ++round) {
      // What the forces of the last round did, to first order at rest, is taken off; what they did
      // in the tissue as it stands and what they should have done then differ less and less.
      if (round > 0 || follows) contact->take_off(moved, skin, sides);
      const MouthContact::Correction next =
          contact->correct({skin, sides, frames.jaw_now_from_rest[i]});
      more.setZero(d0.size());
      for (std::size_t n = 0; n < contact->nodes().size(); ++n)
        more.segment<3>(3 * contact->nodes()[n]) = next.force.segment<3>(3 * Eigen::Index(n));
      moved = next.moved;
      Eigen::VectorXd d;
      try {
        d = tissue.under(more, round == 0 && follows ? &guess : nullptr);
      } catch (const NumericalError&) {
        // The frame stays as the rounds before left it, and deeper ones are not tried.
        if (round == 0) hopeless_m = std::min(hopeless_m, least_m);
        given_up += round == 0;
        break;
      }
      look_at(d);
      const double depth_m = depth_of(i, skin, sides);
      idle = depth_m < 0.9 * least_m ? 0 : idle + 1;
      if (depth_m < least_m) {
        least_m = depth_m;
        column = d;
        own_residual_m = next.residual_m;
        last = frames.which[i];
        last_pushed = d - d0;
        last_moved = moved;
      }
    }
    residual_m = std::max(residual_m, own_residual_m);
    tell(told + 0.5 * (1 - told) / double(frames.which.size()));
  }
  report.iterations += tissue.iterations();
  report.factorisations += tissue.factorisations();
  if (given_up > 0)
    report.notes.push_back(fmt::format(
        "in {} frames no equilibrium with contact was found at finite strain: what passes through "
        "each other there, by {:.2f} mm and more, was left so",
        given_up, 1e3 * hopeless_m));
  return residual_m;
}

void Simulator::Impl::touch(const std::vector<Shot>& shots, const PointCurve& points,
                            Solution& solution, SimulationResult& result) {
  Stopwatch watch;
  report.contact = {};
  need_places();
  const LipSurfaces& lips = *readout->lip_surfaces();
  const bool lips_touch = options.contact.lips && !lips.empty();
  const auto skin_of = [&](std::size_t shot) -> const PointsF& {
    const int frame = shots[shot].frame;
    return frame < 0 ? result.still_displacement_m[std::size_t(-1 - frame)]
                     : result.performance.skin_displacement_m[std::size_t(frame)];
  };
  const auto nodes_of = [&](std::size_t shot) {
    return Eigen::Map<const Points>(solution.displacement.col(Eigen::Index(shot)).data(),
                                    mesh->volume.nodes.rows(), 3);
  };
  const auto jaw_of = [&](std::size_t shot) -> const Eigen::Isometry3d& {
    const int frame = shots[shot].frame;
    return frame < 0 ? result.still_jaw_now_from_rest[std::size_t(-1 - frame)]
                     : result.performance.jaw_now_from_rest[std::size_t(frame)];
  };
  const Eigen::Isometry3d skull = Eigen::Isometry3d::Identity();
  const auto pose_of = [&](const ObstaclePlaces& side,
                           std::size_t shot) -> const Eigen::Isometry3d& {
    return side.obstacle().with_jaw ? jaw_of(shot) : skull;
  };
  std::vector<std::vector<Points>> at_sides(shots.size());
  std::vector<double> depth_m(shots.size());
  struct Depths {
    double lips = 0, teeth = 0, eyes = 0;
  };
  std::vector<Depths> each(shots.size());
  const auto measure = [&](const std::vector<std::size_t>& which) {
    for_frames(which.size(), [&](std::size_t at) {
      const std::size_t i = which[at];
      each[i] = {};
      if (lips_touch) each[i].lips = lips.depth(skin_of(i));
      at_sides[i].resize(touchable->size());
      for (std::size_t s = 0; s < touchable->size(); ++s) {
        const ObstaclePlaces& side = *(*touchable)[s];
        at_sides[i][s] = side.moved(skin_of(i), nodes_of(i));
        const double depth = side.depth(at_sides[i][s], pose_of(side, i));
        double& most = side.obstacle().kind == Obstacle::Kind::teeth ? each[i].teeth : each[i].eyes;
        most = std::max(most, depth);
      }
      depth_m[i] = std::max({each[i].lips, each[i].teeth, each[i].eyes});
    });
    Depths most;
    for (const Depths& one : each) {
      most.lips = std::max(most.lips, 1e3 * one.lips);
      most.teeth = std::max(most.teeth, 1e3 * one.teeth);
      most.eyes = std::max(most.eyes, 1e3 * one.eyes);
    }
    return most;
  };
  SimulationReport::Contact& told_of = report.contact;
  std::vector<std::size_t> all(shots.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  const Depths before = measure(all);
  told_of.overlap_mm = told_of.left_mm = before.lips;
  told_of.teeth_mm = told_of.teeth_left_mm = before.teeth;
  told_of.eyes_mm = told_of.eyes_left_mm = before.eyes;
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < shots.size(); ++i)
    if (depth_m[i] >= MouthContact::kFelt_m) touching.push_back(i);
  if (!touching.empty()) {
    std::vector<std::vector<char>> near(touchable->size());
    for (std::size_t s = 0; s < touchable->size(); ++s) {
      const ObstaclePlaces& side = *(*touchable)[s];
      near[s].assign(std::size_t(side.count()), 0);
      tbb::parallel_for(Eigen::Index(0), side.count(), [&](Eigen::Index k) {
        Vec3 outward;
        near[s][std::size_t(k)] = std::any_of(touching.begin(), touching.end(), [&](std::size_t i) {
          return side.gap_m(k, at_sides[i][s].row(k), pose_of(side, i), outward) < kMayTouch_m;
        });
      });
    }
    ask();
    need_contact(std::move(near));
    ask();
    std::vector<std::vector<Points>> at_touching;
    std::vector<Eigen::Isometry3d> jaws;
    std::vector<PointsF> skins;
    for (const std::size_t i : touching) {
      at_touching.push_back(at_sides[i]);
      jaws.push_back(jaw_of(i));
      skins.push_back(skin_of(i));
      told_of.frames += shots[i].frame >= 0;
    }
    const Touching frames{shots, touching, skins, at_touching, jaws, points};
    told_of.residual_mm =
        1e3 * (options.model.strain == Strain::finite ? correct_finite(frames, solution)
                                                      : correct_linear(frames, solution));
    for_frames(touching.size(), [&](std::size_t i) {
      store(shots[touching[i]], nodes_of(touching[i]), points, result);
    });
    const Depths after = measure(touching);
    told_of.left_mm = after.lips;
    told_of.teeth_left_mm = after.teeth;
    told_of.eyes_left_mm = after.eyes;
  }
  told_of.seconds = watch.lap();
}

}  // namespace hyperex::simulate
