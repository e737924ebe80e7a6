// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/skin_uncertainty.hpp"

#include <cmath>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/simulate/load/shape_posterior.hpp"

namespace hyperex::metrics {

SkinUncertainty skin_uncertainty(const simulate::Performance& performance,
                                 const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  constexpr Eigen::Index most = 20000;  // vertices at once, which limits the memory
  const Points& skin = performance.skin_rest.points;
  const Eigen::VectorXd motion_m =
      performance.skin_displacement_m[std::size_t(performance.peak_frame)]
          .cast<double>()
          .rowwise()
          .norm();
  const SurfaceTree tree(performance.skin_rest);
  std::vector<simulate::DrivenPoint> points;
  simulate::MovedPlaces driven{performance.driven_points_rest,
                               Eigen::VectorXd(performance.driven_points_rest.rows())};
  for (std::size_t i = 0; i < performance.driven_names.size(); ++i) {
    const Vec3 rest = driven.rest.row(Eigen::Index(i)).transpose();
    points.push_back({performance.driven_names[i], rest});
    const int triangle = tree.query(rest).triangle;
    driven.motion_m[Eigen::Index(i)] =
        motion_m(performance.skin_rest.triangles.row(triangle).transpose()).mean();
  }
  SkinUncertainty out{Eigen::VectorXf(skin.rows()), Eigen::VectorXf(skin.rows())};
  for (Eigen::Index from = 0; from < skin.rows(); from += most) {
    const Eigen::Index rows = std::min(most, skin.rows() - from);
    const simulate::MovedPlaces places{skin.middleRows(from, rows), motion_m.segment(from, rows)};
    const auto margin = mesh.skin_upper_margin.begin() + from;
    const simulate::CarriedShapes shapes(places.rest, {margin, margin + rows}, landmarks, points,
                                         simulate::MuscleOptions{}.shape_sigma_m);
    const simulate::ShapePosterior posterior(shapes, places, driven);
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
