// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/curves.hpp"
#include "experiments/model_pictures.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/variant_difference.hpp"

namespace hyperex::bench {
namespace {

using simulate::Performance;
using simulate::SimulationResult;
constexpr double kNear_m = 0.025, kClose_m = 0.010;
constexpr double kSettled_s = 0.1;  // before, xi_L - xi_R is hardly above the floor
constexpr const char* kAtOnce = "a hundredth of the viscosity and mass";
constexpr const char* kChanged = "crista_philtri_superior_R";

/// Three models under one condition; only the evaluated parts of the curves are kept.
struct Condition {
  std::string name;
  std::array<Trial, 3> trials;
  std::array<metrics::SymmetryCurve, 3> curves;
  bool model_1_as_before = false;  ///< the same as in the condition before
};

std::vector<Condition> conditions_of(const std::array<Tissue, 3>& models,
                                     const std::array<Tissue, 3>& harmonic) {
  std::vector<Condition> all;
  const auto add = [&](const std::string& name, fem::ElementKind element, fem::ViscousForm form,
                       const auto& tissue_of) {
    Condition condition{name, {}, {}, false};
    for (std::size_t m = 0; m < 3; ++m) condition.trials[m] = {tissue_of(m), element, form};
    all.push_back(std::move(condition));
  };
  const auto mixed = [&](tissue::Parameter parameter) {
    return [&models, parameter](std::size_t m) {
      Tissue tissue = models[m];
      tissue[parameter] = models[0][parameter];
      return tissue;
    };
  };
  const auto star = fem::ElementKind::tet4_star, plain = fem::ElementKind::tet4;
  const auto isotropic = fem::ViscousForm::isotropic, printed = fem::ViscousForm::printed;
  for (const auto element : {star, plain})
    for (const auto form : {isotropic, printed}) {
      add("as given", element, form, [&](std::size_t m) { return models[m]; });
      add("E alone differs", element, form, mixed(tissue::viscosity));
      all.back().model_1_as_before = true;
      add("eta alone differs", element, form, mixed(tissue::young));
      all.back().model_1_as_before = true;
    }
  add(kAtOnce, star, isotropic, [&](std::size_t m) { return at_once(models[m]); });
  add("ten times the viscosity", star, isotropic,
      [&](std::size_t m) { return times(models[m], tissue::viscosity, 10); });
  add("harmonic interpolation", star, isotropic, [&](std::size_t m) { return harmonic[m]; });
  return all;
}

/// Fills the curves; returns the greatest estimated error of the reduced models.
double simulate_all(const Study& study, std::vector<Condition>& conditions) {
  // Where only E or eta differs, model 1 is that of the previous condition and is not simulated
  // again.
  std::vector<Trial> trials;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t c = 0; c < conditions.size(); ++c)
    for (std::size_t m = conditions[c].model_1_as_before ? 1 : 0; m < 3; ++m) {
      trials.push_back(conditions[c].trials[m]);
      places.emplace_back(c, m);
    }
  std::vector<double> errors(trials.size());
  study.simulate_all(trials, [&](std::size_t i, const SimulationResult& result) {
    const auto [c, m] = places[i];
    conditions[c].curves[m] = study.symmetry_of(result.performance.landmarks);
    errors[i] = result.report.estimated_error;
  });
  for (std::size_t c = 1; c < conditions.size(); ++c)
    if (conditions[c].model_1_as_before) conditions[c].curves[0] = conditions[c - 1].curves[0];
  return *std::max_element(errors.begin(), errors.end());
}

double at_greatest(const std::vector<double>& values) {
  const int at = metrics::greatest_sample(values);
  return at < 0 ? std::nan("") : values[std::size_t(at)];
}

SpreadRow row_of(const Condition& c) {
  const std::vector<double>& time_s = c.curves[0].time_s;
  const std::vector<double> spread = metrics::spread_of({c.curves.begin(), c.curves.end()});
  SpreadRow row;
  row.condition = c.name;
  row.element = fem::to_string(c.trials[0].element);
  row.form = c.trials[0].form == fem::ViscousForm::printed ? "printed" : "isotropic";
  row.tissue_2 = at_greatest(metrics::added_difference(c.curves[1], c.curves[0]));
  row.tissue_3 = at_greatest(metrics::added_difference(c.curves[2], c.curves[0]));
  row.spread = at_greatest(spread);
  const int at = metrics::greatest_sample(spread);
  row.spread_at_s = at < 0 ? std::nan("") : time_s[std::size_t(at)];
  row.share_in_window =
      metrics::share_between(time_s, spread, kSourceWindow_s[0], kSourceWindow_s[1]);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < time_s.size(); ++k)
    if (time_s[k] >= kSourceWindow_s[0] && time_s[k] <= kSourceWindow_s[1] &&
        std::isfinite(spread[k])) {
      sum += spread[k];
      ++count;
    }
  row.spread_in_window = sum / count;
  return row;
}

/// The distance from a place within which half of the weighted sum of squares lies.
double half_radius_m(const Eigen::VectorXd& distance, const Points& rest, const Vec3& centre,
                     const Eigen::VectorXd& weight) {
  std::vector<std::pair<double, double>> order;
  double all = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const double share = weight[v] * distance[v] * distance[v];
    order.emplace_back((rest.row(v).transpose() - centre).norm(), share);
    all += share;
  }
  std::sort(order.begin(), order.end());
  double sum = 0;
  for (const auto& [radius, share] : order)
    if ((sum += share) >= 0.5 * all) return radius;
  return std::nan("");
}

/// Weighted mean over the points within a radius.
double mean_within(const Eigen::VectorXd& values, const Points& rest, const Vec3& centre,
                   double radius_m, const Eigen::VectorXd& weight) {
  double sum = 0, all = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    if ((rest.row(v).transpose() - centre).norm() <= radius_m) {
      sum += weight[v] * values[v];
      all += weight[v];
    }
  return sum / all;
}

/// Greatest difference of S between two runs, after kSettled_s and above the floor.
double greatest_change(const metrics::SymmetryCurve& a, const metrics::SymmetryCurve& b) {
  const std::vector<double> spread = metrics::spread_of({a, b});
  double most = 0;
  for (std::size_t k = 0; k < spread.size(); ++k)
    if (a.time_s[k] >= kSettled_s && std::isfinite(spread[k])) most = std::max(most, spread[k]);
  return most;
}

/// The effect of noise on S(t): the floor, and the largest jitter at which models 2 and 3 can be
/// distinguished.
void look_at_noise(const motion::Motion& landmarks, const std::array<std::vector<double>, 3>& d,
                   ModelsFace& face) {
  constexpr double trial_m = 1e-4;  // the floor is proportional to it
  const std::vector<double> noise = metrics::symmetry_noise(landmarks, trial_m);
  for (std::size_t k = 0; k < noise.size(); ++k)
    face.jitter_to_tell_mm =
        std::max(face.jitter_to_tell_mm, 1e3 * trial_m * std::abs(d[1][k] - d[2][k]) / noise[k]);
  constexpr double typical_mm = 0.3;
  const double jitter_m = face.jitter_mm > 0 ? 1e-3 * face.jitter_mm : 1e-3 * typical_mm;
  face.noise_floor = std::log(noise.back() * jitter_m / trial_m);
}

ModelsFace face_of(const Setting& setting, bool subject_a, std::vector<CurvePanel>& panels) {
  Study study(setting.scene(3, subject_a));
  const scene::Scene& scene = study.scene();
  std::array<Tissue, 3> models = {study.tissue_of(scene)}, harmonic;
  for (std::size_t m = 1; m < 3; ++m) models[m] = study.tissue_of(scene.variants[m - 1].scene);
  for (std::size_t m = 0; m < 3; ++m) {
    scene::Scene other = m == 0 ? scene : scene.variants[m - 1].scene;
    other.tissue.interpolation = tissue::Interpolation::harmonic;
    harmonic[m] = study.tissue_of(other);
  }
  std::vector<Condition> conditions = conditions_of(models, harmonic);
  ModelsFace face;
  face.name = study.name();
  face.jitter_mm = 1e3 * study.inputs().jitter_m;
  const double error = simulate_all(study, conditions);
  for (const Condition& condition : conditions) face.rows.push_back(row_of(condition));
  face.meshes = models_on_meshes(setting.scene(3, subject_a));

  std::array<SimulationResult, 3> runs;
  study.simulate_all({conditions[0].trials.begin(), conditions[0].trials.end()},
                     [&](std::size_t m, SimulationResult run) { runs[m] = std::move(run); });
  const Performance& base = runs[0].performance;
  face.end_s = base.frame_time_s.back();
  face.estimated_error_mm =
      1e3 * error * double(base.skin_displacement_m.back().rowwise().norm().maxCoeff());
  const Eigen::VectorXd area = metrics::vertex_areas(base.skin_rest);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(area.size());
  const auto& landmarks = study.inputs().landmarks;
  face.area_share = metrics::share_within(ones, base.skin_rest.points,
                                          landmarks.at(kChanged).transpose(), kNear_m, area);
  const Vec3 mouth = (landmarks.at(face::ibug(48)) + landmarks.at(face::ibug(54))) / 2;
  face.area_share_mouth =
      metrics::share_within(ones, base.skin_rest.points, mouth.transpose(), kNear_m, area);
  for (std::size_t m = 1; m < 3; ++m) {
    face.pairs.push_back(pair_of(study, fmt::format("1 and {}", m + 1), base, runs[m].performance));
    face.pairs.back().young_change_pa =
        *scene.variants[m - 1].scene.tissue.points.front().value[tissue::young];
  }

  const auto& curves = conditions[0].curves;
  std::array<std::vector<double>, 3> d;
  face.s_least = INFINITY;
  face.s_most = -INFINITY;
  for (std::size_t m = 0; m < 3; ++m) {
    d[m] = metrics::signed_difference(curves[m]);
    face.difference_at_end[m] = d[m].back();
    for (std::size_t k = 0; k < d[m].size(); ++k)
      if (curves[m].time_s[k] >= kSettled_s) {
        face.s_least = std::min(face.s_least, curves[m].s[k]);
        face.s_most = std::max(face.s_most, curves[m].s[k]);
      }
    for (const Condition& condition : conditions)
      if (condition.name == kAtOnce)
        face.at_once_change =
            std::max(face.at_once_change, greatest_change(curves[m], condition.curves[m]));
  }
  std::vector<double> own_size;
  for (std::size_t k = 0; k < d[0].size(); ++k)
    own_size.push_back(curves[0].time_s[k] < kSettled_s ? std::nan("") : 1 / std::abs(d[0][k]));
  const auto least = std::size_t(metrics::greatest_sample(own_size));
  face.own_least = std::abs(d[0][least]);
  face.own_least_s = curves[0].time_s[least];
  const std::vector<double> parted = metrics::added_difference(curves[1], curves[2]);
  face.parted_most_s = curves[0].time_s[std::size_t(metrics::greatest_sample(parted))];
  face.parted_window_share =
      metrics::share_between(curves[0].time_s, parted, kSourceWindow_s[0], kSourceWindow_s[1]);
  look_at_noise(base.landmarks, d, face);
  const auto mirrored = metrics::signed_difference(study.symmetry_of(
      study.simulate(conditions[0].trials[0], study.mirrored_motion()).performance.landmarks));
  face.own_mesh = 0.5 * (d[0].back() + mirrored.back());
  face.own_motion = 0.5 * (d[0].back() - mirrored.back());

  draw_model_maps(study, {&runs[0], &runs[1], &runs[2]},
                  setting.pictures / fmt::format("experiment_3_maps_{}.jpg",
                                                 subject_a ? "subject_a" : "embedded"));
  add_model_panels(face.name, curves, panels);
  return face;
}

}  // namespace

ModelPair pair_of(const Study& study, const std::string& name, const Performance& one,
                  const Performance& other) {
  const Points& rest = one.skin_rest.points;
  const auto& landmarks = study.inputs().landmarks;
  const Vec3 cphs = landmarks.at(kChanged);
  const Vec3 mouth = (landmarks.at(face::ibug(48)) + landmarks.at(face::ibug(54))) / 2;
  const Eigen::VectorXd area = metrics::vertex_areas(one.skin_rest);
  const int last = int(one.frame_time_s.size()) - 1;
  const auto d =
      metrics::variant_difference(one.skin_displacement_m, other.skin_displacement_m, last);
  ModelPair pair;
  pair.name = name;
  Eigen::Index at = 0;
  pair.largest_mm = 1e3 * d.greatest_m.maxCoeff(&at);
  const Vec3 place = rest.row(at);
  pair.largest_from_cphs_mm = 1e3 * (place - cphs).norm();
  double nearest = INFINITY;
  for (const auto& [landmark, where] : landmarks)
    if ((where - place).norm() < nearest) {
      nearest = (where - place).norm();
      pair.nearest_landmark = landmark;
    }
  pair.rms_at_end_mm =
      1e3 * std::sqrt(area.dot(d.at_peak_m.array().square().matrix()) / area.sum());
  pair.share_near_cphs = metrics::share_within(d.greatest_m, rest, cphs.transpose(), kNear_m, area);
  pair.share_near_mouth =
      metrics::share_within(d.greatest_m, rest, mouth.transpose(), kNear_m, area);
  pair.half_radius_mm = 1e3 * half_radius_m(d.greatest_m, rest, cphs, area);
  const Eigen::VectorXd change = 1e3 * d.change_at_peak_m;
  const Eigen::VectorXd moved =
      1e3 * one.skin_displacement_m[std::size_t(last)].cast<double>().rowwise().norm();
  pair.change_mm = mean_within(change, rest, cphs, kClose_m, area);
  pair.change_near_mm = mean_within(change, rest, cphs.transpose(), kNear_m, area);
  pair.moved_mm = mean_within(moved, rest, cphs, kClose_m, area);
  pair.most_less_mm = change.minCoeff();
  pair.most_more_mm = change.maxCoeff();
  const auto signal = [](const Performance& p) {
    return metrics::along_farthest(track_of(p.landmarks, kChanged));
  };
  pair.lag_ms = 1e3 * metrics::lag_of(one.frame_time_s, signal(one), signal(other)).lag_s;
  return pair;
}

std::vector<ModelsFace> hyper_expression(const Setting& setting) {
  std::vector<CurvePanel> panels;
  std::vector<ModelsFace> faces;
  for (const bool subject_a : setting.faces()) faces.push_back(face_of(setting, subject_a, panels));
  render::write_png(setting.pictures / "experiment_3_symmetry.png", draw_curves(panels, 3));
  return faces;
}

}  // namespace hyperex::bench
