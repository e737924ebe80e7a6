// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/run/variants.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/scene/grammar/file_names.hpp"
#include "hyperex/scene/output/variants_picture.hpp"
#include "hyperex/scene/stages/simulation_options.hpp"

namespace hyperex::scene {
namespace {
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kNearMouth_m = 0.025;

std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
}

/// A text as a cell: between quotes where it would else be taken for several.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// Positions of a landmark over time; empty where there is none of that name.
Points track_of(const motion::Motion& m, const std::string& name) {
  const int row = m.index_of(name);
  if (row < 0) return {};
  Points track(Eigen::Index(m.positions.size()), 3);
  for (std::size_t k = 0; k < m.positions.size(); ++k)
    track.row(Eigen::Index(k)) = m.positions[k].row(row);
  return track;
}

double farthest(const Points& track) {
  return track.rows() ? (track.rowwise() - track.row(0)).rowwise().norm().maxCoeff() : 0;
}

double integral(const std::vector<double>& time_s, const std::vector<double>& a,
                const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const double area =
        0.5 * (time_s[k] - time_s[k - 1]) * (std::abs(a[k] - b[k]) + std::abs(a[k - 1] - b[k - 1]));
    if (std::isfinite(area)) sum += area;
  }
  return sum;
}

/// The recorded motion of a driven point at the times of the run's frames.
Points driven_track(const Results& r, const std::string& name) {
  const int row = r.inputs.motion.motion.index_of(name);
  if (row < 0) return {};
  const motion::MotionCurve curve(r.inputs.motion.motion);
  const auto& time_s = r.simulation.performance.frame_time_s;
  const double start_s = r.inputs.motion.motion.time_s.front();
  Points track(Eigen::Index(time_s.size()), 3);
  for (std::size_t k = 0; k < time_s.size(); ++k)
    track.row(Eigen::Index(k)) = curve.at(start_s + time_s[k]).row(row);
  return track;
}

double mean(const Eigen::VectorXd& values, const Eigen::VectorXd& weight) {
  return values.dot(weight) / weight.sum();
}

/// At the peak: how far either side of the face moves, in the mean over its area.
void measure_sides(const metrics::Asymmetry& map, const TriMesh& rest, const PointsF& displacement,
                   const Eigen::VectorXd& area, VariantComparison& c) {
  double sum_mm[2] = {0, 0}, all[2] = {0, 0};
  for (const int v : map.face) {
    const Vec3 at = rest.points.row(v);
    const int right = map.plane.normal.dot(at) < map.plane.offset_m;
    sum_mm[right] += 1e3 * area[v] * double(displacement.row(v).norm());
    all[right] += area[v];
  }
  c.mean_displacement_left_mm = sum_mm[0] / all[0];
  c.mean_displacement_right_mm = sum_mm[1] / all[1];
}

/// The border of the lips, corners included, as ibug68_48 to 59 go round it.
Points lip_outline(const io::Landmarks& landmarks) {
  Points outline(12, 3);
  for (int k = 0; k < 12; ++k) outline.row(k) = landmarks.at(face::ibug(48 + k)).transpose();
  return outline;
}

/// The value of the greatest size; 0 where there is none.
double at_greatest(const std::vector<double>& values) {
  const int at = metrics::greatest_sample(values);
  return at < 0 ? 0 : values[std::size_t(at)];
}

bool comes_back(const std::vector<double>& input) {
  double most = 0;
  for (const double value : input) most = std::max(most, std::abs(value));
  return std::abs(input.back()) < 0.5 * most;
}

/// The figures of a row, each under the name that it has in variants.csv and summary.json.
std::vector<std::pair<const char*, double>> figures_of(const VariantComparison& c) {
  return {{"greatest_displacement_mm", c.greatest_displacement_mm},
          {"greatest_distance_mm", c.greatest_distance_mm},
          {"displacement_there_mm", c.displacement_there_mm},
          {"base_displacement_there_mm", c.base_displacement_there_mm},
          {"rms_distance_at_peak_mm", c.rms_distance_mm},
          {"mean_change_at_peak_mm", c.mean_change_mm},
          {"mean_displacement_L_mm", c.mean_displacement_left_mm},
          {"mean_displacement_R_mm", c.mean_displacement_right_mm},
          {"commissure_L_mm", c.commissure_left.to_mm},
          {"commissure_R_mm", c.commissure_right.to_mm},
          {"commissure_L_change_mm", c.commissure_left.change_mm()},
          {"commissure_R_change_mm", c.commissure_right.change_mm()},
          {"commissure_L_band_mm", c.commissure_left.band_mm},
          {"commissure_R_band_mm", c.commissure_right.band_mm},
          {"asymmetry_rms_mm", c.asymmetry_mm},
          {"added_xi_difference", c.added_xi_difference},
          {"added_xi_floor", c.added_xi_floor},
          {"added_xi_decided", c.added_xi_decided()},
          {"share_within_25_mm_of_mouth", c.share_near_mouth},
          {"lag_ms", 1e3 * c.lag.lag_s},
          {"lag_correlation", c.lag.correlation},
          {"hysteresis", c.hysteresis},
          {"symmetry_integral_s", c.symmetry_integral_s}};
}

void write_table(const fs::path& file, const VariantComparison& base,
                 const std::vector<VariantComparison>& compared, const ResponsePair& pair) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "variant";
    for (const auto& figure : figures_of(base)) out << ',' << figure.first;
    out << ",farthest_near,driven_point,response_point\n";
    const auto row = [&](const VariantComparison& c) {
      out << cell(c.name);
      for (const auto& figure : figures_of(c)) out << ',' << field(figure.second);
      fmt::print(out, ",{},{},{}\n", cell(c.farthest_near), cell(pair.driven), cell(pair.response));
    };
    row(base);
    for (const auto& one : compared) row(one);
  });
}

/// A row a variant, pair of landmarks and side: how far it travels in base and in the variant.
void write_excursion_table(const fs::path& file, const Results& base,
                           const std::vector<VariantRun>& runs) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "variant,point,side,base_mm,variant_mm,change_mm,band_mm,decided\n";
    const metrics::Excursions& before = base.symmetry.excursions;
    for (const VariantRun& run : runs)
      for (std::size_t i = 0; i < before.pairs.size(); ++i)
        for (const auto side : {metrics::Side::left, metrics::Side::right}) {
          const metrics::PairExcursion& pair = run.symmetry.excursions.pairs.at(i);
          const auto change = metrics::change_of(before.pairs[i], pair, side, before.jitter_m);
          fmt::print(out, "{},{},{},{},{},{},{},{}\n", cell(run.scene.title), cell(pair.name),
                     side == metrics::Side::left ? 'L' : 'R', field(change.from_mm),
                     field(change.to_mm), field(change.change_mm()), field(change.band_mm),
                     field(change.decided()));
        }
  });
}

Json json_of(const VariantComparison& c) {
  Json json;
  json["name"] = c.name;
  for (const auto& [name, value] : figures_of(c)) json[name] = value;  // NaN is written as null
  json["farthest_near"] = c.farthest_near;
  return json;
}

}  // namespace

std::vector<VariantRun> prepare_variants(const Scene& scene, const Inputs& inputs,
                                         TissueFields& fields) {
  std::vector<VariantRun> runs;
  for (const Variant& variant : scene.variants) {
    VariantRun run;
    run.scene = variant.scene;
    run.scene.title = variant.name;
    run.folder = variant.folder;
    run.scene.output.vtu = run.scene.output.vtu && run.scene.output.variants_vtu;
    run.scene.output.report = false;
    run.inputs = inputs_of_variant(variant.scene, inputs);
    run.field = fields.of(variant.scene, fmt::format("variant[{}].", runs.size()));
    runs.push_back(std::move(run));
  }
  return runs;
}

void simulate_variants(std::vector<VariantRun>& runs, const reenact::Simulator& base,
                       const MirroredTwin& base_twin, const metrics::RestAsymmetry& at_rest) {
  Progress progress("simulating variants", static_cast<long>(runs.size()));
  std::mutex telling;
  long done = 0;
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    VariantRun& run = runs[i];
    try {
      reenact::SimulationOptions options = simulation_options(run.scene, run.inputs);
      if (run.field) options.tissue.element = run.field->element;
      reenact::Simulator simulator = base;
      simulator.hold_load();
      simulator.set_options(std::move(options));
      run.simulation = simulator.run();
      const MirroredTwin twin =
          simulate_twin(run.scene, run.inputs, run.field ? &*run.field : nullptr, at_rest.plane,
                        simulator, &base_twin);
      run.symmetry =
          symmetry_measures(run.scene, run.inputs, at_rest, run.simulation.performance, twin);
    } catch (const NumericalError& error) {
      throw NumericalError(fmt::format("variant {}: {}", run.scene.title, error.what()));
    }
    const std::lock_guard lock(telling);
    progress.update(++done);
  });
}

ResponsePair response_pair(const Results& base) {
  const reenact::Performance& p = base.simulation.performance;
  ResponsePair pair;
  double most = 0;
  for (const std::string& name : p.driven_names)
    if (const double moved = farthest(driven_track(base, name)); moved > most) {
      most = moved;
      pair.driven = name;
    }
  most = 0;
  const double clear_m = 2 * base.scene.drive.patch_radius_m;
  for (const std::string& name : p.landmarks.names) {
    const Points track = track_of(p.landmarks, name);
    bool off = true;
    for (const auto at : p.driven_points_rest.rowwise())
      off = off && (at - track.row(0)).norm() > clear_m;
    if (const double moved = farthest(track); off && moved > most) {
      most = moved;
      pair.response = name;
    }
  }
  return pair;
}

VariantComparison compare_variant(const std::string& name, const Results& base, const Results& run,
                                  const ResponsePair& pair) {
  const reenact::Performance &own = base.simulation.performance, &p = run.simulation.performance;
  VariantComparison c;
  c.name = name;
  c.greatest_displacement_mm = 1e3 * metrics::greatest_displacement_m(p.skin_displacement_m);
  c.difference =
      metrics::variant_difference(own.skin_displacement_m, p.skin_displacement_m, own.peak_frame);
  const auto& landmarks = base.inputs.landmarks;
  const auto peak = std::size_t(own.peak_frame);
  const Eigen::VectorXd area = metrics::vertex_areas(own.skin_rest);
  c.rms_distance_mm = 1e3 * std::sqrt(mean(c.difference.at_peak_m.cwiseAbs2(), area));
  c.mean_change_mm = 1e3 * mean(c.difference.change_at_peak_m, area);
  Eigen::Index there = 0;
  c.greatest_distance_mm = 1e3 * c.difference.greatest_m.maxCoeff(&there);
  c.displacement_there_mm = c.base_displacement_there_mm = std::nan("");
  if (c.greatest_distance_mm > 0) {
    c.displacement_there_mm = 1e3 * double(p.skin_displacement_m[peak].row(there).norm());
    c.base_displacement_there_mm = 1e3 * double(own.skin_displacement_m[peak].row(there).norm());
    double nearest_m = INFINITY;
    for (const auto& [landmark, at] : landmarks)
      if (const double d = (at.transpose() - own.skin_rest.points.row(there)).norm();
          d < nearest_m) {
        nearest_m = d;
        c.farthest_near = landmark;
      }
  }
  c.commissure_left = c.commissure_right = {std::nan(""), std::nan(""), std::nan("")};
  const metrics::Excursions& before = base.symmetry.excursions;
  const metrics::Excursions& excursions = run.symmetry.excursions;
  for (std::size_t i = 0; i < excursions.pairs.size(); ++i)
    if (const int left = excursions.pairs[i].left;
        left >= 0 && left == excursions.commissure.left) {
      const auto change = [&](metrics::Side side) {
        return metrics::change_of(before.pairs.at(i), excursions.pairs[i], side, before.jitter_m);
      };
      c.commissure_left = change(metrics::Side::left);
      c.commissure_right = change(metrics::Side::right);
    }
  const metrics::Asymmetry& map = *run.symmetry.map;
  measure_sides(map, own.skin_rest, p.skin_displacement_m[peak], area, c);
  c.asymmetry_mm = map.frames[peak].face_rms_mm;
  const metrics::SymmetryCurve& s = run.symmetry.curve;
  c.added_xi_difference = at_greatest(metrics::added_difference(s, base.symmetry.curve));
  c.added_xi_floor = metrics::added_mesh_floor(s, base.symmetry.curve);
  c.share_near_mouth = metrics::share_within(c.difference.greatest_m, own.skin_rest.points,
                                             lip_outline(landmarks), kNearMouth_m, area);
  c.lag.lag_s = c.lag.correlation = c.hysteresis = std::nan("");
  if (!pair.driven.empty() && !pair.response.empty()) {
    const auto input = metrics::along_farthest(driven_track(base, pair.driven));
    const auto response = metrics::along_farthest(track_of(p.landmarks, pair.response));
    if (comes_back(input)) {
      c.lag = metrics::lag_of(p.frame_time_s, input, response);
      c.hysteresis = metrics::hysteresis_of(input, response);
    }
  }
  c.symmetry_integral_s = integral(s.time_s, s.xi_left, s.xi_right);
  return c;
}

Json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                    const tissue::TissueMesh& mesh, const fs::path& directory) {
  const ResponsePair pair = response_pair(base);
  std::vector<VariantComparison> compared(runs.size());
  std::vector<std::optional<report::GlbReport>> glb(runs.size());
  Progress progress("writing variants", 0);
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    const VariantRun& run = runs[i];
    Results results{run.scene,    run.inputs, mesh, run.simulation,
                    run.symmetry, {},         {},   run.field ? &*run.field : nullptr};
    if (run.scene.output.glb)
      results.modes = report::displacement_modes(run.simulation.performance.skin_displacement_m);
    compared[i] = compare_variant(run.scene.title, base, results, pair);
    const fs::path folder = directory / "variants" / run.folder;
    fs::create_directories(folder);
    glb[i] = write_outputs(results, folder);
  });
  const VariantComparison own = compare_variant("base", base, base, pair);
  write_table(directory / "variants.csv", own, compared, pair);
  write_excursion_table(directory / "variants_excursions.csv", base, runs);
  draw_variants(base, compared, runs, directory / "variants.png");
  draw_variant_symmetry(base, runs, directory / "variants_symmetry.png");
  Json json;
  json["driven_point"] = pair.driven;
  json["response_point"] = pair.response;
  json["table"] = Json::array({json_of(own)});
  for (std::size_t i = 0; i < compared.size(); ++i) {
    Json one = json_of(compared[i]);
    one["folder"] = "variants/" + runs[i].folder;
    one["changes"] = echoed_changes(base.scene, base.scene.variants[i].changes);
    one["inverted_tets"] = runs[i].simulation.report.inverted_tets;
    if (glb[i]) one["glb"] = glb_json(*glb[i]);
    one["excursions"] = metrics::summary_of(runs[i].symmetry).at("excursions");
    json["table"].push_back(one);
  }
  return json;
}

}  // namespace hyperex::scene
