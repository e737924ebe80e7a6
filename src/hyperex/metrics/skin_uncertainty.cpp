// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/skin_uncertainty.hpp"

#include <cmath>
#include <limits>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/metrics/regions.hpp"

namespace hyperex::metrics {
namespace {

/// The vertex next to a point; of a lip's point, on that lip.
Eigen::Index nearest_on_its_lip(const Points& skin, const std::vector<double>& upper_margin,
                                const simulate::DrivenPoint& point) {
  const int lip = anatomy::lip_of(point.name);
  Eigen::Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index v = 0; v < skin.rows(); ++v) {
    if (lip != 0 && (upper_margin[std::size_t(v)] > 0) != (lip > 0)) continue;
    if (const double far = (skin.row(v).transpose() - point.rest).squaredNorm(); far < least) {
      least = far;
      nearest = v;
    }
  }
  return nearest;
}

}  // namespace

DrivenMotion driven_motion(const simulate::Performance& performance,
                           const std::vector<double>& upper_margin) {
  const Points& skin = performance.skin_rest.points;
  const PointsF& moved_m = performance.skin_displacement_m[std::size_t(performance.peak_frame)];
  DrivenMotion driven{.points = {}, .places = {performance.driven_points_rest, {}}};
  driven.places.motion_m.resize(driven.places.rest.rows());
  for (std::size_t i = 0; i < performance.driven_names.size(); ++i) {
    const auto row = Eigen::Index(i);
    driven.points.push_back({performance.driven_names[i], driven.places.rest.row(row).transpose()});
    const Eigen::Index vertex = nearest_on_its_lip(skin, upper_margin, driven.points.back());
    driven.places.motion_m[row] = moved_m.row(vertex).cast<double>().norm();
    driven.places.upper_margin.push_back(upper_margin[std::size_t(vertex)]);
  }
  return driven;
}

SkinUncertainty skin_uncertainty(const simulate::Performance& performance,
                                 const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  constexpr Eigen::Index most = 20000;  // vertices at once, which limits the memory
  const Points& skin = performance.skin_rest.points;
  const Eigen::VectorXd motion_m =
      performance.skin_displacement_m[std::size_t(performance.peak_frame)]
          .cast<double>()
          .rowwise()
          .norm();
  const DrivenMotion driven = driven_motion(performance, mesh.skin_upper_margin);
  SkinUncertainty out{Eigen::VectorXf(skin.rows()), Eigen::VectorXf(skin.rows())};
  for (Eigen::Index from = 0; from < skin.rows(); from += most) {
    const Eigen::Index rows = std::min(most, skin.rows() - from);
    const auto margin = mesh.skin_upper_margin.begin() + from;
    const simulate::MovedPlaces places{
        skin.middleRows(from, rows), motion_m.segment(from, rows), {margin, margin + rows}};
    const simulate::CarriedShapes shapes(places.rest, places.upper_margin, landmarks, driven.points,
                                         simulate::MuscleOptions{}.shape_sigma_m);
    const simulate::ShapePosterior posterior(shapes, places, driven.places);
    out.distance_mm.segment(from, rows) = (1e3 * posterior.distance_m()).cast<float>();
    out.determined.segment(from, rows) = posterior.determined().cast<float>();
  }
  return out;
}

nlohmann::ordered_json json_of(const SkinUncertainty& uncertainty, const TriMesh& skin,
                               const io::Landmarks& landmarks) {
  auto json = nlohmann::ordered_json::object();
  for (const Region& region : regions_of(skin.points, landmarks).regions) {
    double squared = 0, determined = 0;
    for (const int v : region.vertices) {
      squared += double(uncertainty.distance_mm[v]) * double(uncertainty.distance_mm[v]);
      determined += double(uncertainty.determined[v]);
    }
    const auto count = double(region.vertices.size());
    json[region.name] = {{"distance_rms_mm", std::sqrt(squared / count)},
                         {"determined", determined / count}};
  }
  return json;
}

}  // namespace hyperex::metrics
