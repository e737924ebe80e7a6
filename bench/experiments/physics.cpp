// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/physics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/pictures.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/variant_difference.hpp"

namespace hyperex::bench {
namespace {

using simulate::Performance;
using simulate::SimulationResult;

double largest_mm(const Performance& p) {
  float most = 0;
  for (const PointsF& d : p.skin_displacement_m)
    most = std::max(most, d.rowwise().norm().maxCoeff());
  return 1e3 * double(most);
}

PhysicsRow row_of(const Trial& trial, const SimulationResult& result, const Performance& quick,
                  const Performance& base, const std::vector<std::string>& landmarks) {
  const Performance& p = result.performance;
  PhysicsRow row;
  row.element = fem::to_string(trial.element);
  row.form = trial.form == fem::ViscousForm::printed ? "printed" : "isotropic";
  row.viscosity_pa_s = trial.tissue[tissue::viscosity].front();
  row.largest_mm = largest_mm(p);
  row.inverted_tets = result.report.inverted_tets;
  const auto apart = [&](const Performance& other) {
    return metrics::variant_difference(other.skin_displacement_m, p.skin_displacement_m,
                                       base.peak_frame);
  };
  row.from_base_mm = 1e3 * apart(base).greatest_m.maxCoeff();
  const metrics::VariantDifference behind = apart(quick);
  row.behind_mm = 1e3 * behind.greatest_m.maxCoeff();
  row.behind_at_end_mm = 1e3 * behind.frame_max_m.back();
  std::vector<double> lags_ms;
  for (const std::string& name : landmarks) {
    const metrics::Lag lag =
        metrics::lag_of(p.frame_time_s, metrics::along_farthest(track_of(quick.landmarks, name)),
                        metrics::along_farthest(track_of(p.landmarks, name)));
    if (std::isfinite(lag.lag_s) && !lag.at_limit) lags_ms.push_back(1e3 * lag.lag_s);
  }
  if (!lags_ms.empty()) {
    row.lag_median_ms = median(lags_ms);
    row.lag_least_ms = *std::min_element(lags_ms.begin(), lags_ms.end());
    row.lag_most_ms = *std::max_element(lags_ms.begin(), lags_ms.end());
  }
  return row;
}

void add_pictures(const Study& study, const SimulationResult& result, render::ContactSheet& sheet) {
  const Performance& p = result.performance;
  const FacePictures pictures(study);
  const std::vector<double>& times = study.scene().time.still_times_s;
  for (std::size_t s = 0; s < result.still_displacement_m.size(); ++s) {
    const PointsF& d = result.still_displacement_m[s];
    std::vector<render::Marker> markers;
    if (s == 0) {  // as in the thesis, at rest
      for (const auto at : p.held_points_rest.rowwise())
        markers.push_back(pictures.marker(at.transpose(), render::palette::held));
      for (const auto at : p.driven_points_rest.rowwise())
        markers.push_back(pictures.marker(at.transpose(), render::palette::driven));
    }
    sheet.pictures.push_back(
        {pictures.draw({{.mesh = moved_skin(p, d),
                         .scalar = 1e3F * d.rowwise().norm(),
                         .range = sheet.bar->range}},
                       render::front_view(), 240, 304, markers),
         fmt::format("{}, {:.1f} s", study.name(), times[std::min(s, times.size() - 1)])});
  }
}

PhysicsFace face_of(const Setting& setting, bool subject_a, render::ContactSheet& sheet) {
  // A higher frame rate than the recording's, since lags of milliseconds are measured.
  Study study(setting.scene(2, subject_a), {"time.frame_rate_hz=100"});
  const Trial own = study.own_trial();
  std::vector<Trial> trials;
  for (const auto element : {fem::ElementKind::tet4_star, fem::ElementKind::tet4}) {
    for (const auto form : {fem::ViscousForm::isotropic, fem::ViscousForm::printed})
      trials.push_back({own.tissue, element, form});
    // It hardly damps jitter, for which a reduced model would need hundreds of unknowns.
    trials.push_back({at_once(own.tissue), element, fem::ViscousForm::isotropic, false});
  }
  const double eta = own.tissue[tissue::viscosity].front();
  trials.push_back({times(own.tissue, tissue::viscosity, 10), own.element, own.form});
  // Shapes that creep for seconds would also stop the growth of a reduced model.
  trials.push_back({times(own.tissue, tissue::viscosity, 100), own.element, own.form, false});
  std::vector<SimulationResult> results(trials.size());
  study.simulate_all(
      trials, [&](std::size_t i, SimulationResult result) { results[i] = std::move(result); });
  const Performance& base = results[0].performance;
  const std::vector<std::string> landmarks = undriven_landmarks(study, base);

  PhysicsFace face;
  face.name = study.name();
  const simulate::SimulationReport& report = results[0].report;
  face.driven_points = int(base.driven_names.size());
  face.driven_nodes = report.driven_nodes;
  face.skull_nodes = report.skull_nodes;
  face.mandible_nodes = report.mandible_nodes;
  face.nodes = int(base.nodes.rows());
  face.tets = int(base.tets.rows());
  face.landmarks = int(landmarks.size());
  face.young_pa = own.tissue[tissue::young].front();
  face.poisson = own.tissue[tissue::poisson].front();
  face.viscosity_pa_s = eta;
  face.relaxation_ms = 1e3 * eta * 2 * (1 + face.poisson) / face.young_pa;
  face.slowest_input_s = base.frame_time_s[std::size_t(base.peak_frame)];
  for (const std::string& name : base.driven_names) {
    const Points track = track_of(study.inputs().motion.motion, name);
    face.input_left_mm =
        std::max(face.input_left_mm, 1e3 * (track.row(track.rows() - 1) - track.row(0)).norm());
  }
  for (const std::size_t i : {0, 1, 3, 4})
    face.elements.push_back(
        row_of(trials[i], results[i], results[i < 3 ? 2 : 5].performance, base, landmarks));
  for (const std::size_t i : {0, 6, 7})
    face.viscosities.push_back(
        row_of(trials[i], results[i], results[2].performance, base, landmarks));
  for (const SimulationResult& result : results)
    face.estimated_error = std::max(face.estimated_error, result.report.estimated_error);
  add_pictures(study, results[0], sheet);
  return face;
}

}  // namespace

std::vector<PhysicsFace> mouth_opening_by_physics(const Setting& setting) {
  constexpr double scale_mm = 30;
  render::ContactSheet sheet;
  sheet.title = "Mouth opening by physics at the thesis' five times";
  sheet.note = "displacement of the skin; red: driven points, blue: held nodes";
  sheet.columns = 5;
  sheet.bar = render::ColourBar{{0, scale_mm}, "displacement (mm)"};
  std::vector<PhysicsFace> faces;
  for (const bool subject_a : setting.faces()) {
    faces.push_back(face_of(setting, subject_a, sheet));
    sheet.bar->open_end = sheet.bar->open_end || faces.back().elements[0].largest_mm > scale_mm;
  }
  write_jpeg(setting.pictures / "experiment_2_times.jpg", render::contact_sheet(sheet));
  return faces;
}

}  // namespace hyperex::bench
