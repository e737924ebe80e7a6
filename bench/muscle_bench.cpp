// SPDX-License-Identifier: GPL-3.0-or-later
// Compares faces moved by muscles with true faces, through the simulator of the library, for
// constants given on the command line. docs/muscles.md explains how to choose them.
//   muscle_bench CASES.txt [key=value ...]
// today=1: driven by displacement; show=1: prints activations; finite=1: finite strain; contact=1:
// contact of the lips; teeth=1, eyes=1: contact of the tissue with the teeth (an average arch if
// none are scanned) and of the lids with the eyeballs. muscles=FILE: with these muscles of the
// template; write=FOLDER: writes the skin at the peak (NAME_7.ply); coverage=1: prints how often
// the truth lies in the 95 % ellipsoid of the shapes' posterior. still=1: prints what moves on the
// still side of kOneSided. CASES has lines "name scene truth 7|all", or "name scene - markers" for
// the recording of markers. Prints errors over parts of the face at the peak, as shares of the
// error of the warp. bench/rig_cases.py makes truths for other expressions of a rig.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <sstream>
#include <string_view>

#include "hyperex/core/files.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/roughness.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/contact/lip_surfaces.hpp"
#include "hyperex/simulate/load/shape_posterior.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex {
namespace {

std::map<std::string, std::string> given;
bool has(const std::string& key) {
  return given.count(key) > 0;
}
void take(const char* key, double& value, double si = 1) {
  if (has(key)) value = si * std::stod(given[key]);
}
bool listed(const std::string& key, const std::string& name) {
  return !has(key) || ("," + given[key] + ",").find("," + name + ",") != std::string::npos;
}

simulate::SimulationOptions options_of(const session::FaceSession& session) {
  constexpr double kpa_per_mm = 1e6, mm = 1e-3;
  simulate::SimulationOptions o = session.options(0);
  if (has("finite")) o.model.strain = simulate::Strain::finite;
  take("finite_step", o.solver.finite_step_s);
  o.contact.lips = has("contact");
  o.contact.teeth = has("teeth");
  o.contact.eyes = has("eyes");
  take("give", o.contact.point_give);
  take("patch_spring", o.contact.patch_pa_per_m, kpa_per_mm);
  if (has("today")) return o;
  o.drive.by = simulate::DriveBy::muscles;
  take("patch", o.drive.patch_radius_m, mm);
  take("E", o.tissue.uniform[tissue::young], 1e3);
  take("nu", o.tissue.uniform[tissue::poisson]);
  simulate::MuscleOptions& m = o.muscles;
  take("skull_across", m.skull_layer.across_pa_per_m, kpa_per_mm);
  take("skull_along", m.skull_layer.along_pa_per_m, kpa_per_mm);
  take("mandible_across", m.mandible_layer.across_pa_per_m, kpa_per_mm);
  take("mandible_along", m.mandible_layer.along_pa_per_m, kpa_per_mm);
  take("teeth_across", m.teeth_layer.across_pa_per_m, kpa_per_mm);
  take("teeth_along", m.teeth_layer.along_pa_per_m, kpa_per_mm);
  take("teeth_reach", m.teeth_reach_m, mm);
  take("foundation", m.foundation_pa_per_m, kpa_per_mm);
  take("throat", m.throat_pa_per_m, kpa_per_mm);
  take("throat_reach", m.throat_reach_m, mm);
  take("side", m.side_correlation);
  take("lip_E", m.lip_stiffening);
  take("lip_reach", m.lip_reach_m, mm);
  take("band", m.shape.band);
  take("ramp", m.shape.ramp);
  take("tangential", m.shape.tangential);
  take("midline", m.shape.midline_m, mm);
  take("fold_width", m.fold.width_mm);
  take("fold_inwards", m.fold.inwards_deg);
  if (has("fold_by_rule")) m.fold.from_rest = false;
  take("widening", m.widening);
  take("half", m.half);
  take("sigma", m.few_sigma_m, mm);
  take("sigma_all", m.many_sigma_m, mm);
  take("prior", m.activation_sigma);
  take("ring_prior", m.ring_sigma);
  take("tone", m.tone_sigma);
  take("slide_aside", m.slide_sigma_m.x(), mm);
  take("slide_up", m.slide_sigma_m.y(), mm);
  take("slide_forward", m.slide_sigma_m.z(), mm);
  take("patch_all", m.many_patch_m, mm);
  if (const std::string& file = given["muscles"]; !file.empty())
    m.own = muscles::changed_table(m.table(), muscles::read_muscles(read_file(file), file), {});
  take("cheek_share", m.few_cheek_share);
  take("lip_share", m.few_lip_share);
  take("share_all", m.many_muscle_share);
  take("jaw_share", m.jaw_share);
  if (has("tissue_alone")) m.shape_prior = false;
  take("shape_sigma", m.shape_sigma_m, mm);
  take("shape_share", m.shape_share);
  take("shape_smoothing", m.shape_smoothing_m, mm);
  take("shape_clear", m.shape_clear_m, mm);
  take("shape_reach", m.shape_reach_m, mm);
  return o;
}

/// A session with the meshes and landmarks found earlier, as in a run; driven as the scene says, or
/// by displacement.
session::FaceSession session_of(const std::string& scene_file) {
  scene::Scene scene = scene::read_scene(scene_file);
  scene.kept = KeptResults(user_cache_folder());
  scene.origins.emplace("drive.by", scene::Origin{scene.file, 0});
  if (has("teeth")) scene.contact.teeth = true;
  if (has("eyes")) scene.contact.eyes = true;
  return session::FaceSession(std::move(scene), {.certainty = session::Certainty::on_request});
}

struct Score {
  std::string name;
  std::vector<double> share;    ///< error divided by the warp's error
  double apart = std::nan("");  ///< the same for the lips, where the true lips do not overlap
};

/// The distance of a true displacement from the one found, in units of its uncertainty: squared.
double squared_mahalanobis(const simulate::ShapePosterior& posterior, Eigen::Index place,
                           const Vec3& error) {
  return error.dot(posterior.covariance(place).ldlt().solve(error));
}

/// What is known of the skin between the driven points of a run; `upper_margin`: of its skin.
simulate::ShapePosterior posterior_of(const simulate::Performance& p,
                                      const std::vector<double>& upper_margin,
                                      const simulate::MovedPlaces& places,
                                      const io::Landmarks& landmarks) {
  simulate::PosteriorOptions options;
  take("misfit", options.misfit_m, 1e-3);
  take("misfit_share", options.misfit_share);
  take("misfit_length", options.misfit_length_m, 1e-3);
  take("point", options.point_m, 1e-3);
  const metrics::DrivenMotion driven = metrics::driven_motion(p, upper_margin);
  const simulate::CarriedShapes shapes(places.rest, places.upper_margin, landmarks, driven.points,
                                       simulate::MuscleOptions{}.shape_sigma_m);
  return simulate::ShapePosterior(shapes, places, driven.places, options);
}

constexpr double kWithin95 = 7.815;  // 95 % quantile of chi squared with three degrees of freedom

/// Prints for each region the share of vertices in the 95 % ellipsoid, the error's root mean square
/// and the expected one.
void print_coverage(const simulate::ShapePosterior& posterior, const Points& error,
                    const metrics::Regions& regions) {
  const Eigen::VectorXd expected = posterior.distance_m(), determined = posterior.determined();
  fmt::print("   coverage");
  for (const metrics::Region& region : regions.regions) {
    double within = 0, squared = 0, expected_squared = 0, known = 0;
    for (const int v : region.vertices) {
      within += squared_mahalanobis(posterior, v, error.row(v)) < kWithin95;
      squared += error.row(v).squaredNorm();
      expected_squared += expected[v] * expected[v];
      known += determined[v];
    }
    const double n = double(region.vertices.size());
    fmt::print("  {} {:.0f} % (rms {:.2f} mm, expected {:.2f}, determined {:.2f})", region.name,
               100 * within / n, 1e3 * std::sqrt(squared / n),
               1e3 * std::sqrt(expected_squared / n), known / n);
  }
  fmt::print("\n");
}

/// Expressions of bench/rig_cases.py that move one side alone, or one side more: a mouth that goes
/// to one side takes both along.
constexpr std::array<std::string_view, 7> kOneSided = {
    "oneSmile", "oneSmileR", "snarlL", "mouthLeft", "mouthRight", "winkL", "winkR"};

/// Prints how far the skin of that side moves that moves less in truth: there, and how much farther
/// here (0 where less far). Only skin more than 15 mm from the middle counts.
void print_still_side(const TriMesh& truth, const Points& rest, const Points& moved,
                      const metrics::Regions& regions, const io::Landmarks& landmarks) {
  constexpr double from_middle_m = 0.015;
  struct Side {
    std::vector<double> true_mm, beyond_mm;
  };
  Side right, left;
  const auto mean = [](const std::vector<double>& of) {
    return std::accumulate(of.begin(), of.end(), 0.0) / double(of.size());
  };
  const face::FaceFrame frame = face::face_frame(landmarks);
  for (const int v : regions.find("face")->vertices) {
    const double x = frame.local(rest.row(v).transpose()).x();
    if (std::abs(x) < from_middle_m) continue;
    Side& side = x > 0 ? left : right;
    side.true_mm.push_back(1e3 * (truth.points.row(v) - rest.row(v)).norm());
    const double found_mm = 1e3 * (moved.row(v) - rest.row(v)).norm();
    side.beyond_mm.push_back(std::max(0.0, found_mm - side.true_mm.back()));
  }
  const bool left_is_still = mean(left.true_mm) < mean(right.true_mm);
  const Side& still = left_is_still ? left : right;
  fmt::print("   still side {}: up to {:.2f} mm in truth; beyond it up to {:.2f} mm, mean {:.2f}\n",
             left_is_still ? "L" : "R", std::ranges::max(still.true_mm),
             std::ranges::max(still.beyond_mm), mean(still.beyond_mm));
}

/// Vertices of the lips that pass through each other in a motion of the skin. If the truth has such
/// vertices, no face with contact can come close to it there.
std::vector<char> overlapping(const simulate::LipSurfaces& lips, const PointsF& motion) {
  constexpr double kDeep_m = 1e-4;
  std::vector<char> out(std::size_t(motion.rows()), 0);
  for (const simulate::LipPair& pair :
       lips.pairs(motion(lips.lower(), Eigen::all).cast<double>(),
                  motion(lips.upper(), Eigen::all).cast<double>(), -kDeep_m)) {
    out[std::size_t(lips.lower()[std::size_t(pair.point)])] = 1;
    for (const int v : pair.on) out[std::size_t(lips.upper()[std::size_t(v)])] = 1;
  }
  return out;
}

void show(const simulate::MuscleCourse& muscles) {
  std::string line;
  const Eigen::Index last = muscles.activation.cols() - 1;
  for (std::size_t m = 0; m < muscles.names.size(); ++m)
    if (const double a = muscles.activation(Eigen::Index(m), last); std::abs(a) > 0.03)
      line += fmt::format(" {} {:.2f}", muscles.names[m], a);
  fmt::print("   jaw {:.1f} deg;{}\n", muscles.jaw_opening_deg[last], line);
}

double mean_mm(const Eigen::VectorXd& distance_m, const metrics::Region* region,
               const std::vector<char>& without = {}) {
  if (region == nullptr) return std::nan("");
  double sum = 0;
  int count = 0;
  for (const int v : region->vertices)
    if (without.empty() || !without[std::size_t(v)]) sum += distance_m[v], ++count;
  return 1e3 * sum / count;
}

Score score_scan(const std::string& name, const std::string& scene_file,
                 const std::string& truth_file, const std::string& kind) {
  const session::FaceSession session = session_of(scene_file);
  const session::Inputs& inputs = session.inputs();
  const auto mesh = session.shared_mesh();
  simulate::Simulator simulator = session.simulator();
  simulator.set_options(options_of(session));
  const auto result = simulator.run();
  const simulate::Performance& p = result.performance;
  const Points rest = mesh->skin.points.topRows(mesh->scan_vertices);
  const Points moved =
      rest +
      p.skin_displacement_m[std::size_t(p.peak_frame)].topRows(mesh->scan_vertices).cast<double>();
  const TriMesh truth = io::read_mesh(truth_file, *io::length_unit("mm"));
  const auto off = [&](const Points& at) {
    return metrics::distance_to_corresponding(at, truth.points, rest.rows());
  };
  const Eigen::VectorXd ours = off(moved);
  Eigen::VectorXd warps, shapes;
  for (const metrics::Baseline& b :
       metrics::baselines({rest, inputs.scan.mesh.triangles}, truth.points, inputs.landmarks))
    if (b.key == (kind == "all" ? "warp_68" : "warp_7"))
      warps = off(b.moved);
    else if (b.key == (kind == "all" ? "shapes_68" : "shapes_7"))
      shapes = off(b.moved);
  const metrics::Regions regions = metrics::regions_of(rest, inputs.landmarks);
  Score score{name + "/" + kind, {}};
  fmt::print("{:18}", score.name);
  for (const char* part : {"face", "lips", "cheeks", "below_eyes", "chin"}) {
    const double a = mean_mm(ours, regions.find(part)), b = mean_mm(warps, regions.find(part));
    fmt::print("  {} {:.2f} of {:.2f} ({:.2f})", part, a, b, a / b);
    score.share.push_back(a / b);
  }
  fmt::print("  blend shapes");
  for (const char* part : {"face", "lips", "cheeks", "below_eyes", "chin"})
    fmt::print(" {:.2f}", mean_mm(shapes, regions.find(part)) / mean_mm(warps, regions.find(part)));
  if (has("write"))
    io::write_ply(given["write"] + "/" + name + "_" + kind + ".ply",
                  {moved, inputs.scan.mesh.triangles}, *io::length_unit("mm"));
  const simulate::LipSurfaces lips(*mesh, inputs.landmarks);
  PointsF true_motion = PointsF::Zero(mesh->skin.points.rows(), 3);
  true_motion.topRows(mesh->scan_vertices) =
      (truth.points.topRows(mesh->scan_vertices) - rest).cast<float>();
  const auto rough = [&](const PointsF& motion) { return metrics::roughness(mesh->skin, motion); };
  const metrics::Roughness own_rough = rough(p.skin_displacement_m[std::size_t(p.peak_frame)]),
                           true_rough = rough(true_motion);
  fmt::print("  rough {:.3f} (truth {:.3f}), over the truth's:", own_rough.rms_mm,
             true_rough.rms_mm);
  const auto own_parts = metrics::roughness_by_part(own_rough, mesh->skin.points, inputs.landmarks),
             true_parts =
                 metrics::roughness_by_part(true_rough, mesh->skin.points, inputs.landmarks);
  for (std::size_t i = 0; i < own_parts.size(); ++i)
    fmt::print(" {} {:.2f} of {:.3f}", own_parts[i].part,
               own_parts[i].rms_mm / true_parts[i].rms_mm, true_parts[i].rms_mm);
  const std::vector<char> mask = overlapping(lips, true_motion);
  const metrics::Region* both = regions.find("lips");
  const double a = mean_mm(ours, both, mask), b = mean_mm(warps, both, mask);
  score.apart = a / b;
  fmt::print("  lips apart in the truth {:.2f} of {:.2f} ({:.2f})  truth overlaps {:.2f}", a, b,
             score.apart, 1e3 * lips.depth(true_motion));
  const auto& c = result.report.contact;
  fmt::print("  overlap {:.2f} -> {:.3f}",
             c.overlap_mm > 0 ? c.overlap_mm : result.report.lip_overlap_mm,
             result.report.lip_overlap_mm);
  if (has("teeth")) fmt::print("  teeth {:.2f} -> {:.3f}", c.teeth_mm, c.teeth_left_mm);
  if (has("eyes")) fmt::print("  eyes {:.2f} -> {:.3f}", c.eyes_mm, c.eyes_left_mm);
  fmt::print("  residual {:.4f}, {} frames, {:.2f} s\n", c.residual_mm, c.frames, c.seconds);
  if (has("show") && !p.muscles.names.empty()) show(p.muscles);
  if (has("still") && std::ranges::count(kOneSided, name.substr(name.find('_') + 1)) > 0)
    print_still_side(truth, rest, moved, regions, inputs.landmarks);
  if (has("coverage"))
    print_coverage(posterior_of(p, mesh->skin_upper_margin,
                                {rest,
                                 (moved - rest).rowwise().norm(),
                                 {mesh->skin_upper_margin.begin(),
                                  mesh->skin_upper_margin.begin() + mesh->scan_vertices}},
                                inputs.landmarks),
                   moved - truth.points.topRows(rest.rows()), regions);
  return score;
}

/// A motion with rest and then each of `frames`, a second apart, so that the run passes through
/// them in turn.
simulate::AlignedMotion through(const simulate::AlignedMotion& motion,
                                const std::vector<std::size_t>& frames) {
  simulate::AlignedMotion out = motion;
  out.motion.time_s = {0};
  out.motion.positions = {motion.motion.positions.front()};
  for (const std::size_t frame : frames) {
    out.motion.time_s.push_back(out.motion.time_s.back() + 1);
    out.motion.positions.push_back(motion.motion.positions[frame]);
  }
  return out;
}

/// Scores as score_markers.py of the data set does, at 5 of its 100 frames.
Score score_markers(const std::string& name, const std::string& scene_file) {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> groups = {
      {"cheeks",
       {"Lcheek_Down", "Lcheek_Outside", "Lcheek_Up", "Rcheek_Down", "Rcheek_Outside",
        "Rcheek_up"}},
      {"upper lip", {"Mouth_UpL1", "Mouth_UpR1"}},
      {"chin", {"Chin_L1", "Chin_R1", "Chin_L2", "Chin_R2"}},
      {"wings", {"NoseHead_L", "NoseHead_R"}},
      {"eyes", {"Leye_Down", "Reye_Down"}}};
  static const std::vector<std::string> skull = {"ForeHead_L", "ForeHead_M",  "ForeHead_R",
                                                 "NoseTop",    "Leye_Inside", "Reye_Inside"};
  const session::FaceSession session = session_of(scene_file);
  const session::Inputs& inputs = session.inputs();
  const simulate::AlignedMotion& motion = inputs.motion;
  const auto moved = [&](std::size_t frame, const std::string& point) -> Vec3 {
    const int row = motion.motion.index_of(point);
    return (motion.motion.positions[frame].row(row) - motion.rest.row(row)).transpose();
  };
  std::vector<std::string> test;
  for (const auto& group : groups)
    test.insert(test.end(), group.second.begin(), group.second.end());
  std::vector<std::pair<double, std::size_t>> by;
  for (std::size_t k = 0; k < motion.motion.positions.size(); ++k) {
    double sum = 0;
    for (const std::string& point : test) sum += moved(k, point).norm();
    by.emplace_back(-sum, k);
  }
  std::sort(by.begin(), by.end());
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < 100; i += 20) frames.push_back(by[i].second);

  // The markers are used as landmarks of the skin, so that the run outputs their motion.
  io::Landmarks landmarks = inputs.landmarks;
  for (const std::string& point : test)
    landmarks[point] = motion.rest.row(motion.motion.index_of(point)).transpose();
  simulate::SimulationOptions options = options_of(session);
  options.time.frame_rate_hz = 1;
  options.time.end_s = double(frames.size() + 1);
  const auto result =
      simulate::Simulator(session.shared_mesh(), landmarks, through(motion, frames), options).run();
  const motion::Motion& tracks = result.performance.landmarks;

  Points places(Eigen::Index(test.size()), 3);
  for (std::size_t i = 0; i < test.size(); ++i)
    places.row(Eigen::Index(i)) = landmarks.at(test[i]).transpose();
  Eigen::VectorXd of_places(places.rows());
  for (std::size_t i = 0; i < test.size(); ++i) {
    const int row = tracks.index_of(test[i]);
    of_places[Eigen::Index(i)] =
        (tracks.positions[1].row(row) - tracks.positions[0].row(row)).norm();
  }
  const simulate::ShapePosterior posterior =
      posterior_of(result.performance, session.mesh().skin_upper_margin,
                   {places, of_places, std::vector<double>(test.size(), 0.0)}, inputs.landmarks);
  std::map<std::string, double> run, warp, within, squared_error;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::vector<std::string> held = inputs.driven;
    held.insert(held.end(), skull.begin(), skull.end());
    Points centres(Eigen::Index(held.size()), 3), by_points = Points::Zero(centres.rows(), 3);
    for (std::size_t i = 0; i < held.size(); ++i) {
      centres.row(Eigen::Index(i)) = motion.rest.row(motion.motion.index_of(held[i]));
      if (i < inputs.driven.size())
        by_points.row(Eigen::Index(i)) = moved(frames[f], held[i]).transpose();
    }
    const Rbf rbf(centres, by_points);
    for (const std::string& point : test) {
      const int row = tracks.index_of(point);
      const Vec3 truth = moved(frames[f], point);
      const Vec3 ours =
          (tracks.positions[f + 1].row(row) - tracks.positions[0].row(row)).transpose();
      run[point] += (ours - truth).norm();
      const auto place = std::find(test.begin(), test.end(), point) - test.begin();
      within[point] += squared_mahalanobis(posterior, place, ours - truth) < kWithin95;
      squared_error[point] += (ours - truth).squaredNorm();
      warp[point] += (rbf.at(landmarks[point]) - truth).norm();
    }
  }
  const auto share = [&](const std::vector<std::string>& points) {
    double a = 0, b = 0;
    for (const std::string& point : points) a += run[point], b += warp[point];
    return a / b;
  };
  Score score{name, {share(test)}};
  fmt::print("{:18}  all 16 ({:.2f})", name, score.share[0]);
  for (const auto& [group, points] : groups) {
    score.share.push_back(share(points));
    fmt::print("  {} ({:.2f})", group, score.share.back());
    if (!has("coverage")) continue;
    double inside = 0, squared = 0, expected = 0;
    for (const std::string& point : points) {
      const auto place = std::find(test.begin(), test.end(), point) - test.begin();
      inside += within[point];
      squared += squared_error[point];
      expected += posterior.covariance(place).trace();
    }
    const double n = double(points.size() * frames.size());
    fmt::print(" {:.0f} % (rms {:.2f} mm, expected {:.2f})", 100 * inside / n,
               1e3 * std::sqrt(squared / n), 1e3 * std::sqrt(expected / double(points.size())));
  }
  fmt::print("\n");
  if (has("show") && !result.performance.muscles.names.empty()) show(result.performance.muscles);
  return score;
}

/// Geometric means and worst values over the rig's cases; the real faces separately.
void summarise(const std::vector<Score>& scores) {
  for (const char* kind : {"/7", "/all"}) {
    double sum[3] = {0, 0, 0}, worst[2] = {0, 0}, apart = 0;
    int count = 0;
    for (const Score& s : scores) {
      if (!s.name.ends_with(kind) || s.name.starts_with("real")) continue;
      apart += std::log(s.apart);
      for (int k = 0; k < 3; ++k) sum[k] += std::log(s.share[std::size_t(k)]);
      for (int k = 0; k < 2; ++k) worst[k] = std::max(worst[k], s.share[std::size_t(k)]);
      ++count;
    }
    if (count > 0)
      fmt::print("rig {}: {:.3f} / {:.3f} / {:.3f}; worst {:.2f} / {:.2f}; lips apart {:.3f}\n",
                 kind, std::exp(sum[0] / count), std::exp(sum[1] / count), std::exp(sum[2] / count),
                 worst[0], worst[1], std::exp(apart / count));
  }
  for (const Score& s : scores)
    if (s.name.starts_with("real") || s.name == "markers")
      fmt::print("  {} {:.2f}/{:.2f}/{:.2f}/{:.2f}", s.name, s.share[0], s.share[1], s.share[2],
                 s.share[3]);
  fmt::print("\n");
}

}  // namespace
}  // namespace hyperex

int main(int argc, char** argv) {
  using namespace hyperex;
  if (argc < 2) {
    std::cerr << "usage: muscle_bench CASES.txt [key=value ...]\n";
    return 2;
  }
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i];
    given[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
  }
  std::vector<Score> scores;
  std::ifstream list(argv[1]);
  for (std::string line; std::getline(list, line);) {
    std::istringstream in(line);
    std::string name, scene, truth, kind;
    if (!(in >> name >> scene >> truth >> kind) || name[0] == '#') continue;
    if (!listed("only", name) || !listed("kind", kind)) continue;
    scores.push_back(kind == "markers" ? score_markers(name, scene)
                                       : score_scan(name, scene, truth, kind));
  }
  summarise(scores);
  return 0;
}
