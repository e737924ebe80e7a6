// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/points_off.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "hyperex/face/point_words.hpp"

namespace hyperex::simulate {
namespace {

/// A point within one edge of the mesh is not far from it, nor is one within this distance.
constexpr double kNearMesh_m = 0.010;
/// Points within this distance of each other have the same nodes, whatever drives them.
constexpr double kOnePlace_m = 0.001;
/// Points that share this much of their nodes' weights cannot be told apart by them.
constexpr double kSameNodes = 0.7;
/// A cause that accounts for this share of the distance is named.
constexpr double kMostOfIt = 0.75;
/// The square root of the 95th percentile of chi^2 with three degrees of freedom.
constexpr double kInSpace95 = 2.795;

double departure_m(const PointCurve& wanted, int row, double time_s, double step_s) {
  const double before_s = step_s * std::floor(time_s / step_s);
  const double share = (time_s - before_s) / step_s;
  const auto at = [&](double t_s) -> Vec3 { return wanted.at(t_s).row(row).transpose(); };
  return (at(time_s) - (1 - share) * at(before_s) - share * at(before_s + step_s)).norm();
}

/// Of the outer triangles that have one of the nodes.
double longest_edge_m(const TriMesh& outer, const std::vector<int>& nodes) {
  double longest_m = 0;
  for (Eigen::Index t = 0; t < outer.triangles.rows(); ++t) {
    const auto has = [&](int node) { return (outer.triangles.row(t).array() == node).any(); };
    if (std::ranges::none_of(nodes, has)) continue;
    for (int k = 0; k < 3; ++k) {
      const int from = outer.triangles(t, k), to = outer.triangles(t, (k + 1) % 3);
      longest_m = std::max(longest_m, (outer.points.row(from) - outer.points.row(to)).norm());
    }
  }
  return longest_m;
}

void find_mesh_place(const tissue::TissueMesh& mesh, const DrivenPoints& driven, std::size_t worst,
                     FarthestPoint& out) {
  const CarrierMatrix carrier = carriers(mesh, {driven.places[worst]});
  std::vector<int> nodes;
  Vec3 followed = Vec3::Zero();
  for (CarrierMatrix::InnerIterator it(carrier, 0); it; ++it) {
    nodes.push_back(int(it.col()));
    followed += it.value() * mesh.volume.outer.points.row(it.col()).transpose();
  }
  out.from_mesh_m = (driven.rest.row(Eigen::Index(worst)).transpose() - followed).norm();
  out.edge_m = longest_edge_m(mesh.volume.outer, nodes);
}

void find_neighbour(const DrivenPoints& driven, const PointCurve& wanted,
                    const std::vector<double>& frame_time_s, std::size_t worst,
                    FarthestPoint& out) {
  std::vector<double> apart_m(driven.rows.size(), 0);
  for (const double time_s : frame_time_s) {
    const Points there = wanted.at(time_s);
    for (std::size_t i = 0; i < apart_m.size(); ++i)
      apart_m[i] =
          std::max(apart_m[i], (there.row(driven.rows[i]) - there.row(driven.rows[worst])).norm());
  }
  for (std::size_t i = 0; i < apart_m.size(); ++i) {
    const double distance_m =
        (driven.rest.row(Eigen::Index(i)) - driven.rest.row(Eigen::Index(worst))).norm();
    if (i == worst || apart_m[i] < out.off_m || distance_m >= out.neighbour_m) continue;
    out.neighbour = driven.names[i];
    out.neighbour_m = distance_m;
  }
}

/// The sum over the outer nodes of the smaller of both places' weights.
double shared_weight(const tissue::TissueMesh& mesh, const Match& one, const Match& other) {
  const CarrierMatrix both = carriers(mesh, {one, other});
  double shared = 0;
  for (CarrierMatrix::InnerIterator it(both, 0); it; ++it)
    shared += std::min(it.value(), both.coeff(1, it.col()));
  return shared;
}

/// Forces that are found as reactions belong to no muscle.
bool changes_muscles(const SimulationOptions& options) {
  if (options.drive.by != DriveBy::muscles) return false;
  return options.muscles.mirrored ||
         std::ranges::any_of(options.muscles.gains,
                             [](const MuscleGain& gain) { return gain.gain != 1; });
}

bool driven_by_forces(const SimulationOptions& options) {
  return options.drive.by != DriveBy::displacement && options.region.measured != Measured::all;
}

/// A cause in the step or in the mesh, as a part of a sentence; empty where there is none.
std::string coarse_reason(const FarthestPoint& point, const SimulationOptions& options) {
  if (options.model.strain == Strain::linear && point.between_steps_m >= kMostOfIt * point.off_m)
    return fmt::format(
        "between steps of time.step_s = {:g} the recorded motion of {} departs from "
        "a straight line by {:.2f} mm: a shorter step follows it",
        options.time.step_s, point.name, 1e3 * point.between_steps_m);
  if (point.from_mesh_m > std::max(kNearMesh_m, point.edge_m))
    return fmt::format(
        "the mesh of the tissue ends {:.0f} mm from {}: mesh.trim_border_mm and "
        "mesh.element_size_mm say where it ends",
        1e3 * point.from_mesh_m, point.name);
  // Forces place points that share elements as exactly as any others while the tissue is at rest.
  if (point.neighbour_m <= (driven_by_forces(options) ? kOnePlace_m : point.edge_m))
    return fmt::format(
        "{} is {:.1f} mm from {}, closer than the elements' edges of {:.1f} mm: "
        "points that lie closer together than the elements and move differently are "
        "met only on average",
        point.name, 1e3 * point.neighbour_m, face::name_in_words(point.neighbour),
        1e3 * point.edge_m);
  if (point.shared >= kSameNodes)
    return fmt::format(
        "the tissue's mesh has the same nodes for {} and {}, {:.1f} mm from it: such points are "
        "met only on average",
        point.name, face::name_in_words(point.neighbour), 1e3 * point.neighbour_m);
  return "";
}

}  // namespace

FarthestPoint farthest_point(const tissue::TissueMesh& mesh, const DrivenPoints& driven,
                             const PointCurve& wanted, const std::vector<double>& frame_time_s,
                             double step_s, const std::vector<double>& off_m) {
  const auto worst = std::size_t(std::ranges::max_element(off_m) - off_m.begin());
  FarthestPoint out;
  out.name = driven.names[worst];
  out.off_m = off_m[worst];
  for (const double time_s : frame_time_s)
    out.between_steps_m =
        std::max(out.between_steps_m, departure_m(wanted, driven.rows[worst], time_s, step_s));
  find_mesh_place(mesh, driven, worst, out);
  find_neighbour(driven, wanted, frame_time_s, worst, out);
  if (const auto at = std::ranges::find(driven.names, out.neighbour); at != driven.names.end())
    out.shared = shared_weight(mesh, driven.places[worst],
                               driven.places[std::size_t(at - driven.names.begin())]);
  return out;
}

std::string points_off_text(const std::vector<std::string>& names, const std::vector<double>& off_m,
                            double within_m) {
  constexpr double matters_m = 0.002;
  constexpr std::size_t few = 2, some = 8;
  std::vector<std::size_t> off;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (off_m[i] > within_m) off.push_back(i);
  if (off.empty()) return "";
  std::ranges::stable_sort(off, std::ranges::greater{}, [&](std::size_t i) { return off_m[i]; });
  const double most_m = off_m[off.front()];
  std::vector<std::string> named;
  for (const std::size_t i : off)
    if (named.size() < (most_m < matters_m ? few : some))
      named.push_back(face::name_in_words(names[i]));
  return fmt::format("{} driven point{} up to {:.2f} mm from where {} driven{}: {}", off.size(),
                     off.size() > 1 ? "s end" : " ends", 1e3 * most_m,
                     off.size() > 1 ? "they are" : "it is",
                     off.size() > named.size() ? ", the farthest" : "", fmt::join(named, ", "));
}

bool is_within_jitter(double off_m, double jitter_m) {
  return off_m <= kInSpace95 * jitter_m;
}

std::string jitter_text(double jitter_m) {
  return fmt::format(
      "the recording's jitter of {:.2f} mm alone moves a point by up to {:.2f} mm (95 %)",
      1e3 * jitter_m, 1e3 * kInSpace95 * jitter_m);
}

bool is_asked_for(const FarthestPoint& point, const SimulationOptions& options) {
  if (options.region.measured == Measured::all) return false;
  return changes_muscles(options) && coarse_reason(point, options).empty();
}

std::string reason_of(const FarthestPoint& point, const SimulationOptions& options, bool touched) {
  if (options.region.measured == Measured::all) return "";
  if (std::string coarse = coarse_reason(point, options); !coarse.empty()) return coarse;
  if (!driven_by_forces(options)) return "";
  if (changes_muscles(options))
    return fmt::format(
        "{} changes the forces that were found for the points: they end where the changed muscles "
        "carry them, which is a result and no fault; a run without it meets them as far as its "
        "forces can",
        options.muscles.mirrored ? "muscles.mirrored" : "muscles.gain");
  return fmt::format(
      "with drive.by = \"{}\" forces carry the points, exactly only at rest and in the tissue for "
      "which they were found; drive.by = \"displacement\" meets them{}",
      word_of(options.drive.by), touched ? ". Contact moves points too where surfaces touch" : "");
}

std::string likely_reason(bool touched) {
  return touched ? "contact acted in this run: a point ends only as near as the surface that is in "
                   "its way allows"
                 : "no one cause was found; a finer mesh (mesh.element_size_mm) or a shorter step "
                   "(time.step_s) may meet them";
}

}  // namespace hyperex::simulate
