// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/muscle_twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/simulate/load/held_load.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::test {
namespace {

constexpr int kSamples = 20, kComing = 10;
constexpr double kRate_hz = 30;
/// Number of last samples that are evaluated. The expression is held for longer, since the tissue
/// has to settle first.
constexpr int kHeld = 6;

constexpr int kRightCorner = 48, kLeftCorner = 54;

std::string group_of(const std::string& muscle) {
  const std::string bare = muscle.substr(0, muscle.size() - 2);
  return muscles::find_muscle(bare)->group + muscle.substr(muscle.size() - 2);
}

simulate::TissueValues with_factor(const simulate::TissueValues& values,
                                   const std::vector<double>& young_factor, std::size_t tets) {
  simulate::TissueValues out = values;
  for (int p = 0; p < tissue::parameter_count; ++p)
    if (out.element[p].empty()) out.element[p].assign(tets, out.uniform[p]);
  for (std::size_t t = 0; t < young_factor.size(); ++t)
    out.element[tissue::young][t] *= young_factor[t];
  return out;
}

}  // namespace

Corners held_corners(const motion::Motion& tracks) {
  const auto way = [&](int point) {
    const int row = tracks.index_of(face::ibug(point));
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = tracks.positions.size() - kHeld; k < tracks.positions.size(); ++k)
      sum += (tracks.positions[k].row(row) - tracks.positions.front().row(row)).transpose();
    return 1e3 * sum.norm() / kHeld;
  };
  return {way(kLeftCorner), way(kRightCorner)};
}

TwinTruth::TwinTruth(const TwinFace& face, const muscles::MuscleTable& muscles, double young_factor,
                     const std::vector<TwinChange>& changes, std::vector<std::string> points)
    : changes_(changes),
      half_(face.options.muscles.half),
      young_factor_(young_factor),
      jaw_(face.landmarks, nullptr),
      points_(std::move(points)) {
  rest_.resize(Eigen::Index(points_.size()), 3);
  for (Eigen::Index p = 0; p < rest_.rows(); ++p)
    rest_.row(p) = face.landmarks.at(points_[std::size_t(p)]).transpose();
  carrier_ = simulate::carriers(*face.mesh, simulate::skin_places(*face.mesh, points_, rest_));
  tissues_.push_back(tissue(face, {}));
  for (const TwinChange& change : changes) tissues_.push_back(tissue(face, change.young_factor));
  // At activation 1 a muscle moves its own tissue by 10 mm, whatever the stiffness.
  fem::System system;
  fem::Material material = face.options.tissue.material(std::size_t(face.mesh->volume.tets.rows()),
                                                        face.options.model.viscous_form);
  stiffen_lips(*face.mesh, face.landmarks, face.options.muscles, material);
  for (double& young : material.young_pa) young *= young_factor;
  fem::Assembler(face.mesh->volume.nodes, face.mesh->volume.tets, face.options.model.element)
      .assemble(material, system);
  muscles_ = std::make_unique<simulate::MuscleModel>(
      *face.mesh, face.landmarks, system.stiffness, muscles,
      simulate::MuscleModelOptions{muscle_support(face.options.support, face.options.muscles),
                                   face.options.muscles.shape, face.options.muscles.widening});
}

TwinTruth::Tissue TwinTruth::tissue(const TwinFace& face,
                                    const std::vector<double>& young_factor) const {
  const auto tets = std::size_t(face.mesh->volume.tets.rows());
  fem::Material material = with_factor(face.options.tissue, young_factor, tets)
                               .material(tets, face.options.model.viscous_form);
  stiffen_lips(*face.mesh, face.landmarks, face.options.muscles, material);
  for (double& young : material.young_pa) young *= young_factor_;
  fem::System system;
  fem::Assembler(face.mesh->volume.nodes, face.mesh->volume.tets, face.options.model.element)
      .assemble(material, system);
  const simulate::Boundary boundary(*face.mesh, face.landmarks,
                                    muscle_support(face.options.support, face.options.muscles));
  boundary.add_springs(system.stiffness);
  return {std::make_unique<fem::PartitionedFactor>(system.stiffness, boundary.prescribed(),
                                                   "the truth of a twin"),
          system.stiffness.rows()};
}

Eigen::VectorXd TwinTruth::force(const Activations& activations,
                                 const std::vector<simulate::MuscleGain>& gains) const {
  std::vector<std::string> names;
  for (const muscles::MuscleLine& line : lines()) names.push_back(line.name);
  const Eigen::VectorXd gain = simulate::muscle_gains(names, gains);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(muscles_->force().rows());
  for (std::size_t m = 0; m < names.size(); ++m) {
    const auto active = activations.find(names[m]);
    if (active == activations.end()) continue;
    const double a = active->second, wide = a / (a + half_);
    const auto column = Eigen::Index(m);
    out += gain[column] * a *
           ((1 - wide) * muscles_->force().col(column) + wide * muscles_->wide_force().col(column));
  }
  return out;
}

Points TwinTruth::moved(const Tissue& tissue, const Eigen::VectorXd& force) const {
  Eigen::VectorXd free = force(tissue.factor->free());
  tissue.factor->solve(free);
  Eigen::VectorXd nodes = Eigen::VectorXd::Zero(tissue.unknowns);
  nodes(tissue.factor->free()) = free;
  return carrier_ * Eigen::Map<const Points>(nodes.data(), carrier_.cols(), 3);
}

simulate::AlignedMotion TwinTruth::recorded(const Activations& activations, double noise_m,
                                            unsigned seed, std::size_t change,
                                            const simulate::JawPose& jaw) const {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  simulate::AlignedMotion out;
  out.motion.names = out.common = points_;
  out.rest = rest_;
  const auto gains = change == 0 ? std::vector<simulate::MuscleGain>{} : changes_[change - 1].gains;
  for (int k = 0; k < kSamples; ++k) {
    const double course = k < kComing ? 0.5 - 0.5 * std::cos(std::numbers::pi * k / kComing) : 1;
    Activations now = activations;
    for (auto& [muscle, a] : now) a *= course;
    const Eigen::VectorXd by =
        force(now, gains) + muscles_->jaw_force() * jaw_.motion(course * jaw);
    Points at = rest_ + moved(tissues_[change], by);
    if (k > 0) at += noise_m * Points::NullaryExpr(rest_.rows(), 3, [&] { return normal(random); });
    out.motion.time_s.push_back(k / kRate_hz);
    out.motion.positions.push_back(at);
  }
  return out;
}

std::vector<Corners> TwinTruth::corners(const Activations& activations) const {
  std::vector<Corners> out;
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const auto& gains = t == 0 ? std::vector<simulate::MuscleGain>{} : changes_[t - 1].gains;
    const Points by = moved(tissues_[t], force(activations, gains));
    const auto way_mm = [&](int corner) {
      const auto at = std::find(points_.begin(), points_.end(), face::ibug(corner));
      return 1e3 * by.row(at - points_.begin()).norm();
    };
    out.push_back({way_mm(kLeftCorner), way_mm(kRightCorner)});
  }
  return out;
}

TwinAnswer twin_answer(const TwinFace& face, const TwinTruth& truth, const Activations& activations,
                       const std::vector<TwinChange>& changes,
                       const std::vector<std::string>& points, double noise_m, unsigned seed) {
  simulate::SimulationOptions options = face.options;
  options.drive.by = simulate::DriveBy::muscles;
  options.drive.points = points;
  TwinAnswer out;
  out.truth = truth.corners(activations);
  simulate::Simulator simulator(face.mesh, face.landmarks,
                                truth.recorded(activations, noise_m, seed), options);
  const simulate::SimulationResult base = simulator.run();
  out.found.push_back(held_corners(base.performance.landmarks));
  const simulate::MuscleCourse& muscles = base.performance.muscles;
  out.true_groups = Eigen::VectorXd::Zero(Eigen::Index(muscles.groups.size()));
  for (const auto& [muscle, a] : activations) {
    const auto at = std::find(muscles.groups.begin(), muscles.groups.end(), group_of(muscle));
    out.true_groups[at - muscles.groups.begin()] += a;
  }
  out.found_groups = muscles.group_activation.rightCols(kHeld).rowwise().mean();
  for (const motion::Motion& tracks : tracks_after(simulator, face, changes))
    out.found.push_back(held_corners(tracks));
  return out;
}

std::vector<motion::Motion> tracks_after(simulate::Simulator& simulator, const TwinFace& face,
                                         const std::vector<TwinChange>& changes) {
  const simulate::SimulationOptions options = simulator.options();
  simulator.hold_load();
  std::vector<motion::Motion> out;
  for (const TwinChange& change : changes) {
    simulate::SimulationOptions changed = options;
    changed.tissue = with_factor(options.tissue, change.young_factor,
                                 std::size_t(face.mesh->volume.tets.rows()));
    changed.muscles.gains = change.gains;
    simulator.set_options(changed);
    out.push_back(simulator.run().performance.landmarks);
  }
  return out;
}

muscles::MuscleTable displaced_lines(muscles::MuscleTable table, double off_mm, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (muscles::TemplateMuscle& muscle : table) {
    const double way = angle(random);
    for (muscles::TemplatePlace& place : muscle.path) {
      place.out_mm += off_mm * std::cos(way);
      place.up_mm += off_mm * std::sin(way);
    }
  }
  return table;
}

const Activations& left_smile() {
  static const Activations smile = {{"zyg_major_L", 0.7},  {"zyg_minor_L", 0.25},
                                    {"lev_anguli_L", 0.2}, {"malaris_L", 0.2},
                                    {"risorius_L", 0.15},  {"zyg_major_R", 0.05}};
  return smile;
}

const Activations& other_smile() {
  static const Activations smile = {{"zyg_major_L", 0.25}, {"zyg_minor_L", 0.3},
                                    {"lev_anguli_L", 0.4}, {"malaris_L", 0.5},
                                    {"risorius_L", 0.1},   {"zyg_major_R", 0.05}};
  return smile;
}

Activations drawn_expression(const std::vector<muscles::MuscleLine>& lines, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Activations out;
  for (const muscles::MuscleLine& line : lines)
    if (share(random) < 1.0 / 3 || line.name == "zyg_major_L") out[line.name] = 0.7 * share(random);
  return out;
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

}  // namespace hyperex::test
