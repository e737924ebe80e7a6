// SPDX-License-Identifier: GPL-3.0-or-later
// How near muscles and what they leave over come to true faces, at the peak, for constants on the
// command line: what docs/muscles.md says of choosing them. One case takes a quarter of a second.
//   muscle_bench CASES.txt [key=value ...]     today=1: driven by displacement; show=1: activations
// CASES: lines "name scene truth 7|all", or "name scene - markers" for the recording of markers.
// The share of the warp's error over face, lips, cheeks, the face below the eyes, and chin. Truths
// for other expressions of a rig: bench/rig_cases.py.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "hyperex/geometry/rbf.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "hyperex/reenact/muscle_fit.hpp"
#include "hyperex/reenact/muscle_model.hpp"
#include "hyperex/reenact/support.hpp"
#include "hyperex/scene/inputs.hpp"
#include "hyperex/scene/pipeline.hpp"

namespace hyperex {
namespace {

std::map<std::string, std::string> given;
double number(const std::string& key, double otherwise) {
  return given.count(key) ? std::stod(given[key]) : otherwise;
}

struct Face {
  scene::Scene scene;
  scene::Inputs inputs;
  std::shared_ptr<const tissue::TissueMesh> mesh;
  std::unique_ptr<fem::Assembler> assembler;
  std::unique_ptr<reenact::MuscleModel> model;
  metrics::Regions regions;
  std::vector<int> below;
};
std::map<std::string, std::unique_ptr<Face>> faces;

reenact::MuscleModelOptions model_options() {
  reenact::MuscleModelOptions o;
  auto& s = o.support;
  s.skull_layer = {1e6 * number("skull_across", 2.5), 1e6 * number("skull_along", 4.8)};
  s.mandible_layer = {1e6 * number("mandible_across", 33), 1e6 * number("mandible_along", 10)};
  s.muscle_pa_per_m = 1e6 * number("deep", 0.31);
  s.teeth_layer = {1e6 * number("teeth_across", 0.31), 1e6 * number("teeth_along", 1.04)};
  s.teeth_reach_m = 1e-3 * number("teeth_reach", 13);
  o.shape.band = number("band", 2.1);
  o.widening = number("widening", 2.3);
  o.shape.tangential = number("tangential", 0.54);
  o.shape.ramp = number("ramp", 6);
  o.shape.midline_m = 1e-3 * number("midline", 5);
  return o;
}

std::vector<muscles::TemplateMuscle> muscle_rows() {
  auto rows = muscles::muscle_template();
  static const std::map<std::string, int> wide = {
      {"zyg_major", 1}, {"zyg_minor", 1},  {"malaris", 1},     {"risorius", 1},   {"buccinator", 1},
      {"platysma", 1},  {"lev_anguli", 2}, {"lev_lab_sup", 2}, {"lev_alaeque", 2}};
  for (auto& r : rows) {
    const auto it = wide.find(r.name);
    if (it != wide.end() && it->second == 1 && given.count("cheek_band"))
      r.band = number("cheek_band", 0);
    if (it != wide.end() && it->second == 2 && given.count("lip_band"))
      r.band = number("lip_band", 0);
    if (r.kind == muscles::MuscleKind::ring && given.count("ring_band"))
      r.band = number("ring_band", 0);
    if (given.count("band_" + r.name)) r.band = number("band_" + r.name, 0);
  }
  return rows;
}

Face& face_of(const std::string& scene_file) {
  const scene::Scene scene = scene::read_scene(scene_file);
  const std::string key = scene.scan.source.file.string();
  auto& slot = faces[key];
  if (slot) {
    slot->scene = scene;
    slot->inputs = scene::read_inputs(scene);
    return *slot;
  }
  slot = std::make_unique<Face>();
  Face& f = *slot;
  f.scene = scene;
  f.inputs = scene::read_inputs(scene);
  f.mesh = std::make_shared<tissue::TissueMesh>(
      tissue::build_tissue_mesh(f.inputs.scan.mesh, f.inputs.landmarks, scene.mesh, key));

  f.assembler = std::make_unique<fem::Assembler>(f.mesh->volume.nodes, f.mesh->volume.tets,
                                                 scene.model.element);
  f.regions =
      metrics::regions_of(f.mesh->skin.points.topRows(f.mesh->scan_vertices), f.inputs.landmarks);
  const auto frame = tissue::face_frame(f.inputs.landmarks);
  const double top = frame.local(f.inputs.landmarks.at("ibug68_30")).y() + 0.015;
  if (const auto* r = f.regions.find("face"))
    for (int v : r->vertices)
      if (frame.local(f.mesh->skin.points.row(v)).y() < top) f.below.push_back(v);
  return f;
}

void make_model(Face& f) {
  if (f.model) return;
  const auto& volume = f.mesh->volume;
  auto options = scene::simulation_options(f.scene, f.inputs);
  if (given.count("E")) options.tissue.uniform[tissue::young] = 1e3 * number("E", 0);
  if (given.count("nu")) options.tissue.uniform[tissue::poisson] = number("nu", 0);
  {
    const auto lips = reenact::distances_to_lips(*f.mesh, f.inputs.landmarks);
    const double reach = 1e-3 * number("lip_reach", 8.5);
    for (int p = 0; p < tissue::parameter_count; ++p)
      options.tissue.element[p].assign(volume.tets.rows(), options.tissue.uniform[p]);
    for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
      double d = 0;
      for (int a = 0; a < 4; ++a) d += 0.25 * lips[volume.tets(t, a) % volume.surface_nodes()];
      options.tissue.element[tissue::young][t] *=
          1 + (number("lip_E", 3.2) - 1) * std::exp(-std::pow(d / reach, 2));
    }
  }
  fem::System system;
  f.assembler->assemble(options.tissue.material(volume.tets.rows(), options.model.viscous_form),
                        system);
  f.model = std::make_unique<reenact::MuscleModel>(*f.mesh, f.inputs.landmarks, system.stiffness,
                                                   muscle_rows(), model_options());
}

double mean(const Eigen::VectorXd& d, const std::vector<int>& at) {
  double sum = 0;
  for (int v : at) sum += d[v];
  return at.empty() ? 0 : 1e3 * sum / at.size();
}

/// The modelled displacement of all nodes for points' displacements at one time.
struct Driver {
  Face& f;
  std::vector<std::string> names;
  std::vector<int> rows;
  reenact::CarrierMatrix carrier;                                  // points x outer
  Eigen::MatrixXd points_of(const Eigen::MatrixXd& nodes) const {  // 3P x n
    Eigen::MatrixXd out(3 * carrier.rows(), nodes.cols());
    const Eigen::Index skin = f.mesh->volume.surface_nodes();
    for (Eigen::Index c = 0; c < nodes.cols(); ++c) {
      const Points p = carrier * Eigen::Map<const Points>(nodes.col(c).data(), skin, 3);
      out.col(c) = Eigen::Map<const Eigen::VectorXd>(p.data(), p.size());
    }
    return out;
  }
  std::unique_ptr<reenact::MuscleFit> fit;
  std::unique_ptr<reenact::JawKinematics> jaw;
  std::unique_ptr<fem::PartitionedFactor> patch_factor;
  fem::SparseMatrix patch_coupling;
  reenact::DrivenSkin patches;

  Driver(Face& face, const std::vector<std::string>& driven) : f(face) {
    const auto& motion = f.inputs.motion;
    std::vector<std::string> with;
    for (const auto& n : driven)
      if (motion.motion.index_of(n) >= 0)
        names.push_back(n), rows.push_back(motion.motion.index_of(n));
    Points rest(rows.size(), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) rest.row(i) = motion.rest.row(rows[i]);
    carrier = reenact::carriers(*f.mesh, reenact::skin_places(*f.mesh, names, rest));
    jaw = std::make_unique<reenact::JawKinematics>(f.inputs.landmarks);
    reenact::PointResponse r{points_of(f.model->response()), points_of(f.model->jaw_response()),
                             points_of(f.model->wide_response()), number("half", 0.62)};
    const auto& rows_of = muscle_rows();
    std::vector<char> tone, ring;
    for (const auto& line : f.model->lines())
      ring.push_back(rows_of[line.row].kind == muscles::MuscleKind::ring);
    for (const auto& line : f.model->lines()) tone.push_back(rows_of[line.row].tone);
    const bool few = names.size() < 20;
    const double sigma = 1e-3 * (few ? number("sigma", 0.8) : number("sigma_all", 1.6));
    reenact::FitPriors priors;
    priors.activation = number("prior", 0.34);
    priors.ring = number("ring_prior", 0.14);
    priors.tone = number("tone", 0.075);
    priors.slide_m = 1e-3 * number("slide", 2.8);
    priors.turn_rad = number("turn", 0.03);
    priors.tilt_rad = number("tilt", 0.02);
    fit = std::make_unique<reenact::MuscleFit>(std::move(r), *jaw, priors, sigma, tone, ring);
    make_patches(few);
  }
  void make_patches(bool few) {
    auto drive = f.scene.drive;
    drive.all_points = false;
    drive.points = names;
    drive.patch_radius_m = 1e-3 * (few ? number("patch", 8) : number("patch_all", 15));
    const auto region =
        reenact::measured_region(*f.mesh, f.inputs.landmarks, f.inputs.motion, f.scene.region);
    patches = reenact::driven_skin(*f.mesh, f.inputs.landmarks, f.inputs.motion, region, drive);
    std::map<int, int> fixed;
    for (int u : f.model->boundary().prescribed()) fixed[u] = 1;
    for (int v : patches.nodes)
      for (int a = 0; a < 3; ++a) fixed[3 * v + a] = 1;
    std::vector<int> prescribed;
    for (auto& [u, one] : fixed) prescribed.push_back(u);
    patch_factor =
        std::make_unique<fem::PartitionedFactor>(f.model->stiffness(), prescribed, "patches");
    patch_coupling = fem::coupling(f.model->stiffness(), patch_factor->partition());
  }
  // Points prescribed as in a run by displacement.
  std::unique_ptr<reenact::Boundary> prescribing;
  std::unique_ptr<fem::PartitionedFactor> today_factor;
  fem::SparseMatrix today_coupling;
  Eigen::VectorXd today(const Points& displacement) {
    if (!today_factor) {
      auto drive = f.scene.drive;
      drive.all_points = false;
      drive.points = names;
      if (given.count("patch_today")) drive.patch_radius_m = 1e-3 * number("patch_today", 8);
      auto support = f.scene.support;
      if (given.count("field")) support.muscle_pa_per_m = 1e6 * number("field", 5);
      const auto region =
          reenact::measured_region(*f.mesh, f.inputs.landmarks, f.inputs.motion, f.scene.region);
      prescribing = std::make_unique<reenact::Boundary>(*f.mesh, f.inputs.landmarks,
                                                        f.inputs.motion, region, drive, support);
      fem::System system;
      auto options = scene::simulation_options(f.scene, f.inputs);
      f.assembler->assemble(
          options.tissue.material(f.mesh->volume.tets.rows(), options.model.viscous_form), system);
      prescribing->add_springs(system.stiffness);
      today_factor = std::make_unique<fem::PartitionedFactor>(system.stiffness,
                                                              prescribing->prescribed(), "today");
      today_coupling = fem::coupling(system.stiffness, today_factor->partition());
    }
    Eigen::VectorXd values(prescribing->prescribed().size()),
        force(3 * f.mesh->volume.nodes.rows());
    reenact::Boundary::JawMotion jaw_motion;
    for (int i = 0; i < 30; ++i) jaw_motion = prescribing->follow((i + 1) / 30.0 * displacement);
    prescribing->prescribe(displacement, jaw_motion, values, force);
    Eigen::VectorXd all(force.size());
    Eigen::VectorXd free = force(today_factor->free()) - today_coupling * values;
    today_factor->solve(free);
    all(today_factor->free()) = free;
    all(today_factor->prescribed()) = values;
    return all;
  }

  Eigen::VectorXd activation;
  reenact::JawPose pose;
  double unexplained_mm = 0;
  Eigen::VectorXd at(const Points& displacement) {  // of all motion points
    Eigen::VectorXd d(3 * rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      d.segment<3>(3 * i) = displacement.row(rows[i]).transpose();
    if (given.count("today")) {
      activation = Eigen::VectorXd::Zero(f.model->lines().size());
      return today(displacement);
    }
    const auto result = fit->fit(d);
    activation = result.activation;
    pose = result.jaw;
    unexplained_mm = 1e3 * std::sqrt(result.left_over.squaredNorm() / rows.size());
    const auto turn = jaw->motion(result.jaw);
    Eigen::VectorXd narrow = activation, wide = Eigen::VectorXd::Zero(activation.size());
    if (f.model->wide_force().cols() > 0)
      for (Eigen::Index m = 0; m < activation.size(); ++m) {
        const double share =
            activation[m] > 0 ? activation[m] / (activation[m] + number("half", 0.62)) : 0;
        wide[m] = share * activation[m];
        narrow[m] -= wide[m];
      }
    Eigen::VectorXd u = f.model->response() * narrow + f.model->jaw_response() * turn;
    if (f.model->wide_force().cols() > 0) u += f.model->wide_response() * wide;
    Points left = Points::Zero(f.inputs.motion.rest.rows(), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
      left.row(rows[i]) = result.left_over.segment<3>(3 * i).transpose();
    const Points more = patches.weights * left;
    Eigen::VectorXd force = f.model->force() * narrow + f.model->jaw_force() * turn;
    if (f.model->wide_force().cols() > 0) force += f.model->wide_force() * wide;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(u.size());
    for (std::size_t j = 0; j < patches.nodes.size(); ++j)
      all.segment<3>(3 * patches.nodes[j]) =
          u.segment<3>(3 * patches.nodes[j]) + more.row(j).transpose();
    const Eigen::VectorXd values = all(patch_factor->prescribed());
    Eigen::VectorXd free = force(patch_factor->free()) - patch_coupling * values;
    patch_factor->solve(free);
    all(patch_factor->free()) = free;
    u = all;
    return u;
  }
};

Points skin_of(const Face& f, const Eigen::VectorXd& u) {
  Points out(f.mesh->scan_vertices, 3);
  for (Eigen::Index v = 0; v < out.rows(); ++v) {
    Vec3 d = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      d += f.mesh->anchors[v].weight[k] * u.segment<3>(3 * f.mesh->anchors[v].node[k]);
    out.row(v) = d.transpose();
  }
  return out;
}

struct Score {
  std::string name;
  std::vector<double> share;
};
std::vector<Score> scores;

void print_activations(const Driver& d) {
  std::string line;
  for (std::size_t m = 0; m < d.f.model->lines().size(); ++m)
    if (std::abs(d.activation[m]) > 0.03)
      line += fmt::format(" {} {:.2f}", d.f.model->lines()[m].name, d.activation[m]);
  fmt::print("   jaw {:.1f} deg, slide {:.1f} {:.1f} {:.1f} mm; left over {:.2f} mm;{}\n",
             d.pose[0] * 57.3, 1e3 * d.pose[3], 1e3 * d.pose[4], 1e3 * d.pose[5], d.unexplained_mm,
             line);
}

struct Case {
  std::string name, kind;
  Face* face;
  scene::Scene scene;
  scene::Inputs inputs;
  TriMesh truth;
  Points warp;
};
std::vector<Case> cases;

void read_case(const std::string& name, const std::string& scene, const std::string& truth_file,
               const std::string& kind) {
  Face& f = face_of(scene);
  Case c{name, kind, &f, f.scene, f.inputs, {}, {}};
  c.inputs.scan = {};
  if (kind != "markers") {
    const Points rest = f.mesh->skin.points.topRows(f.mesh->scan_vertices);
    c.truth = io::read_mesh(truth_file, *io::length_unit("mm"));
    for (const auto& b : metrics::baselines({rest, f.inputs.scan.mesh.triangles}, c.truth.points,
                                            f.inputs.landmarks))
      if (b.key == (kind == "all" ? "warp_68" : "warp_7")) c.warp = b.moved;
  }
  cases.push_back(std::move(c));
}

void score_case(const Case& c) {
  Face& f = *c.face;
  const std::string& name = c.name;
  const bool all = c.kind == "all";
  f.scene = c.scene;
  f.inputs = c.inputs;
  make_model(f);
  Driver driver(f, f.inputs.driven);
  const auto& motion = f.inputs.motion;
  const Points moved = motion.motion.positions.back() - motion.rest;
  const Eigen::VectorXd u = driver.at(moved);
  const Points rest = f.mesh->skin.points.topRows(f.mesh->scan_vertices);
  const TriMesh& truth = c.truth;
  const Points* warp = &c.warp;
  const auto off = [&](const Points& at) {
    return metrics::distance_to_corresponding(at, truth.points, rest.rows());
  };
  const Eigen::VectorXd e = off(rest + skin_of(f, u)), w = off(*warp);
  fmt::print("{:14} {:3}", name, all ? "all" : "7");
  Score score{name + (all ? "/all" : "/7"), {}};
  const std::pair<const char*, const std::vector<int>*> parts[] = {
      {"face", &f.regions.find("face")->vertices},
      {"lips", &f.regions.find("lips")->vertices},
      {"cheeks", f.regions.find("cheeks") ? &f.regions.find("cheeks")->vertices : nullptr},
      {"below", &f.below},
      {"chin", f.regions.find("chin") ? &f.regions.find("chin")->vertices : nullptr}};
  for (const auto& [part, at] : parts) {
    const double a = at ? mean(e, *at) : 0, b = at ? mean(w, *at) : 1;
    fmt::print("  {} {:.2f} of {:.2f} ({:.2f})", part, a, b, a / b);
    score.share.push_back(a / b);
  }
  fmt::print("\n");
  if (given.count("show")) print_activations(driver);
  if (given.count("lips")) {
    const auto frame = tissue::face_frame(f.inputs.landmarks);
    std::vector<std::string> names;
    Points rest68(20, 3);
    for (int k = 48; k < 68; ++k) {
      names.push_back(tissue::ibug(k));
      rest68.row(k - 48) = f.inputs.landmarks.at(names.back()).transpose();
    }
    const Points at = reenact::carriers(*f.mesh, reenact::skin_places(*f.mesh, names, rest68)) *
                      Eigen::Map<const Points>(u.data(), f.mesh->volume.surface_nodes(), 3);
    const auto close = [&](const Vec3& p) {
      int best = 0;
      for (int v : f.regions.find("lips")->vertices)
        if ((rest.row(v).transpose() - p).squaredNorm() <
            (rest.row(best).transpose() - p).squaredNorm())
          best = v;
      return best;
    };
    for (int k = 0; k < 20; ++k) {
      const int v = close(rest68.row(k).transpose());
      const Vec3 t = 1e3 * (truth.points.row(v) - rest.row(v)).transpose(),
                 a = 1e3 * at.row(k).transpose(),
                 q = 1e3 * (warp->row(v) - rest.row(v)).transpose();
      fmt::print(
          "   {} truth {:6.2f} {:6.2f} {:6.2f}  ours {:6.2f} {:6.2f} {:6.2f}  warp {:6.2f} {:6.2f} "
          "{:6.2f}\n",
          names[k], frame.x.dot(t), frame.y.dot(t), frame.z.dot(t), frame.x.dot(a), frame.y.dot(a),
          frame.z.dot(a), frame.x.dot(q), frame.y.dot(q), frame.z.dot(q));
    }
  }
  if (given.count("cheek")) {
    const auto frame = tissue::face_frame(f.inputs.landmarks);
    const Points s = skin_of(f, u);
    double forward = 0, real = 0;
    int n = 0;
    for (int v : f.regions.find("cheeks")->vertices) {
      forward += frame.z.dot(s.row(v));
      real += frame.z.dot(truth.points.row(v) - rest.row(v));
      ++n;
    }
    fmt::print("   cheeks forward {:.2f} mm, truth {:.2f}\n", 1e3 * forward / n, 1e3 * real / n);
  }
  scores.push_back(score);
}

void score_markers(const Case& which) {
  Face& f = *which.face;
  const std::string& name = which.name;
  f.scene = which.scene;
  f.inputs = which.inputs;
  make_model(f);
  Driver driver(f, f.inputs.driven);
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
  std::vector<std::string> test;
  for (const auto& g : groups) test.insert(test.end(), g.second.begin(), g.second.end());
  const auto& m = f.inputs.motion;
  Points rest(test.size(), 3);
  std::vector<int> rows;
  for (std::size_t i = 0; i < test.size(); ++i)
    rows.push_back(m.motion.index_of(test[i])), rest.row(i) = m.rest.row(rows[i]);
  const auto carrier = reenact::carriers(*f.mesh, reenact::skin_places(*f.mesh, test, rest));
  std::vector<std::pair<double, std::size_t>> by;
  for (std::size_t k = 0; k < m.motion.positions.size(); ++k) {
    double moved = 0;
    for (int r : rows) moved += (m.motion.positions[k].row(r) - m.rest.row(r)).norm();
    by.push_back({-moved, k});
  }
  std::sort(by.begin(), by.end());
  const std::size_t frames = 100, every = 100 / std::size_t(number("frames", 5));
  std::vector<double> run(test.size(), 0), warp(test.size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < frames; i += every, ++count) {
    const Points moved = m.motion.positions[by[i].second] - m.rest;
    const Eigen::VectorXd u = driver.at(moved);
    const Points at =
        carrier * Eigen::Map<const Points>(u.data(), f.mesh->volume.surface_nodes(), 3);
    Points centres(driver.rows.size() + skull.size(), 3),
        by_points = Points::Zero(centres.rows(), 3);
    Eigen::Index c = 0;
    for (int r : driver.rows) by_points.row(c) = moved.row(r), centres.row(c++) = m.rest.row(r);
    for (const auto& s : skull) centres.row(c++) = m.rest.row(m.motion.index_of(s));
    const Points warped = Rbf(centres, by_points).at_all(rest);
    for (std::size_t t = 0; t < test.size(); ++t) {
      run[t] += (at.row(t) - moved.row(rows[t])).norm();
      warp[t] += (warped.row(t) - moved.row(rows[t])).norm();
    }
  }
  double a = 0, b = 0;
  for (std::size_t t = 0; t < test.size(); ++t) a += run[t], b += warp[t];
  fmt::print("{:14} 7    all 16 {:.2f} of {:.2f} ({:.2f})", name, 1e3 * a / count / test.size(),
             1e3 * b / count / test.size(), a / b);
  Score score{name, {a / b}};
  std::size_t t = 0;
  for (const auto& g : groups) {
    double ga = 0, gb = 0;
    for (std::size_t i = 0; i < g.second.size(); ++i, ++t) ga += run[t], gb += warp[t];
    fmt::print("  {} ({:.2f})", g.first, ga / gb);
    score.share.push_back(ga / gb);
  }
  fmt::print("\n");
  if (given.count("show")) print_activations(driver);
  scores.push_back(score);
}

void score_all() {
  scores.clear();
  for (const Case& c : cases) c.kind == "markers" ? score_markers(c) : score_case(c);
}

}  // namespace
}  // namespace hyperex

int main(int argc, char** argv) {
  using namespace hyperex;
  std::ifstream list(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const std::string s = argv[i];
    given[s.substr(0, s.find('='))] = s.substr(s.find('=') + 1);
  }
  std::string line;
  while (std::getline(list, line)) {
    std::istringstream in(line);
    std::string name, scene, truth, kind;
    in >> name >> scene >> truth >> kind;
    if (name.empty() || name[0] == '#') continue;
    if (given.count("only") &&
        ("," + given["only"] + ",").find("," + name + ",") == std::string::npos)
      continue;
    if (given.count("kind") && kind != given["kind"]) continue;
    read_case(name, scene, truth, kind);
  }
  score_all();
  for (const char* kind : {"/7", "/all"}) {
    double sum[3] = {0, 0, 0}, worst[2] = {0, 0};
    int n = 0;
    for (const auto& s : scores)
      if (s.name.ends_with(kind) && s.share.size() == 5 &&
          s.name.find("real") == std::string::npos) {
        for (int k = 0; k < 3; ++k) sum[k] += std::log(s.share[k]);
        for (int k = 0; k < 2; ++k) worst[k] = std::max(worst[k], s.share[k]);
        ++n;
      }
    if (n)
      fmt::print("rig {}: {:.3f} / {:.3f} / {:.3f}; worst {:.2f} / {:.2f}\n", kind,
                 std::exp(sum[0] / n), std::exp(sum[1] / n), std::exp(sum[2] / n), worst[0],
                 worst[1]);
  }
  std::string summary;
  for (const auto& s : scores)
    if (s.name.starts_with("real") || s.name == "markers")
      summary += fmt::format("  {} {:.2f}/{:.2f}/{:.2f}/{:.2f}", s.name, s.share[0], s.share[1],
                             s.share[2], s.share[3]);
  fmt::print("{}\n", summary);
  return 0;
}
