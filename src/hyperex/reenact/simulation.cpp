// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/form/system.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/reenact/boundary.hpp"
#include "hyperex/reenact/input_shapes.hpp"
#include "hyperex/reenact/lip_contact.hpp"
#include "hyperex/reenact/skin_measured.hpp"
#include "hyperex/reenact/skin_places.hpp"
#include "hyperex/reenact/solve.hpp"
#include "hyperex/tissue/lips.hpp"

namespace hyperex::reenact {
namespace {

/// A time at which a shape is wanted, and where it goes.
struct Shot {
  double time_s;
  int frame;  ///< or -1 - index of a still
};

std::vector<Shot> shots_of(const TimeOptions& time, double end_s,
                           std::vector<double>& frame_time_s) {
  std::vector<Shot> shots;
  const int frames = std::max(1, static_cast<int>(std::ceil(end_s * time.frame_rate_hz - 1e-6)));
  for (int f = 0; f < frames; ++f) {
    frame_time_s.push_back(f / time.frame_rate_hz);
    shots.push_back({frame_time_s.back(), f});
  }
  for (std::size_t i = 0; i < time.still_times_s.size(); ++i)
    shots.push_back({std::min(time.still_times_s[i], end_s), -1 - static_cast<int>(i)});
  std::stable_sort(shots.begin(), shots.end(),
                   [](const Shot& a, const Shot& b) { return a.time_s < b.time_s; });
  return shots;
}

/// Displacement of the driven points and of all the motion's points at any time, gain included.
class Input {
 public:
  Input(const AlignedMotion& motion, double gain)
      : rest_(motion.rest),
        gain_(gain),
        curve_(motion.motion),
        start_(curve_.at(motion.motion.time_s.front())),
        start_s_(motion.motion.time_s.front()) {}
  /// `t` from the start of the motion.
  Points at(double t) const { return gain_ * (curve_.at(start_s_ + t) - start_); }

 private:
  Points rest_;
  double gain_;
  motion::MotionCurve curve_;
  Points start_;
  double start_s_;
};

/// Carries displacements of tissue and tracked points to the skin.
class SkinCarrier {
 public:
  SkinCarrier(const tissue::TissueMesh& mesh, const MeasuredRegion& region)
      : mesh_(mesh), region_(region) {}

  PointsF carry(const Points& nodes, const Points& points) const {
    PointsF out(mesh_.skin.points.rows(), 3);
    for (Eigen::Index v = 0; v < out.rows(); ++v) {
      const double share = region_.share[v];
      Vec3 d = Vec3::Zero();
      if (share < 1) {
        const tissue::Anchor& anchor = mesh_.anchors[v];
        for (int k = 0; k < 3; ++k) d += anchor.weight[k] * nodes.row(anchor.node[k]).transpose();
      }
      if (share > 0) d = (1 - share) * d + share * region_.skin[v].displacement(points);
      out.row(v) = d.transpose().cast<float>();
    }
    return out;
  }

 private:
  const tissue::TissueMesh& mesh_;
  const MeasuredRegion& region_;
};

motion::Motion landmark_tracks(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                               const std::vector<double>& time_s,
                               const std::vector<PointsF>& frames) {
  motion::Motion tracks;
  tracks.time_s = time_s;
  Points rest(landmarks.size(), 3);
  Eigen::Index i = 0;
  for (const auto& [name, p] : landmarks) {
    tracks.names.push_back(name);
    rest.row(i++) = p.transpose();
  }
  const auto matches = skin_places(mesh, tracks.names, rest);
  for (const PointsF& frame : frames) {
    Points at = rest;
    for (std::size_t m = 0; m < matches.size(); ++m)
      for (int k = 0; k < 3; ++k)
        at.row(m) += matches[m].weight[k] * frame.row(matches[m].point[k]).cast<double>();
    tracks.positions.push_back(at);
  }
  return tracks;
}

class Run {
 public:
  Run(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, const AlignedMotion& motion,
      const SimulationOptions& options)
      : mesh_(mesh),
        landmarks_(landmarks),
        motion_(motion),
        options_(options),
        region_(measured_region(mesh, landmarks, motion, options.region)),
        input_(motion, options.drive.gain),
        carrier_(mesh, region_) {
    end_s_ = options.time.end_s > 0 ? options.time.end_s
                                    : motion.motion.time_s.back() - motion.motion.time_s.front();
    shots_ = shots_of(options.time, end_s_, result_.performance.frame_time_s);
    result_.performance.skin_displacement_m.resize(result_.performance.frame_time_s.size());
    result_.still_displacement_m.resize(options.time.still_times_s.size());
  }

  SimulationResult finish() {
    if (options_.region.measured == Measured::all)
      replay();
    else
      integrate();
    describe();
    return std::move(result_);
  }

 private:
  void replay() {
    const Points none = Points::Zero(mesh_.volume.nodes.rows(), 3);
    for (const Shot& shot : shots_) store(shot, none);
  }

  void integrate() {
    Boundary boundary(mesh_, landmarks_, motion_, region_, options_.drive, options_.support);
    Stopwatch watch;
    const auto tets = static_cast<std::size_t>(mesh_.volume.tets.rows());
    const fem::Material material = options_.tissue.material(tets, options_.model.viscous_form);
    fem::System system =
        fem::assemble(mesh_.volume.nodes, mesh_.volume.tets, material, options_.model.element);
    boundary.add_springs(system.stiffness);
    SimulationReport& report = result_.report;
    report.assemble_s = watch.lap();

    const double dt_s = options_.time.step_s;
    const double steps = std::ceil(end_s_ / dt_s - 1e-9);
    if (steps > kMostSteps)
      throw InputError(motion_.motion.source,
                       fmt::format("{:g} s in steps of {:g} s are {:.0f} steps; "
                                   "expected at most {:.0f}",
                                   end_s_, dt_s, steps, kMostSteps));
    report.steps = static_cast<int>(steps);
    // What the shapes leave out must not show beside the error that the solver may make.
    const InputShapes input = input_shapes(
        boundary, [&](double t) { return input_.at(t); }, dt_s, report.steps,
        1e-3 * options_.solver.tolerance);
    std::vector<double> times;
    for (const Shot& shot : shots_)
      times.push_back(std::clamp(shot.time_s / dt_s, 0.0, static_cast<double>(report.steps)));
    const Solution solution =
        solve(std::move(system), boundary.prescribed(), input.drive, times, options_.solver, dt_s);
    result_.performance.node_displacement_m.resize(result_.performance.frame_time_s.size());
    for (std::size_t i = 0; i < shots_.size(); ++i)
      store(shots_[i], Eigen::Map<const Points>(solution.displacement.col(i).data(),
                                                mesh_.volume.nodes.rows(), 3));
    report.greatest_opening_deg = input.greatest_opening_deg;
    report.input_shapes = static_cast<int>(input.drive.shapes());
    report.free_dofs = solution.free_dofs;
    report.basis_size = solution.basis_size;
    report.linear_solver = solution.linear_solver;
    report.estimated_error = solution.estimated_error;
    report.verified_error = solution.verified_error;
    report.analyse_s = solution.analyse_s;
    report.factor_s = solution.factor_s;
    report.basis_s = solution.basis_s;
    report.simulate_s = watch.lap() - solution.analyse_s - solution.factor_s - solution.basis_s;
    report.driven_nodes = static_cast<int>(boundary.driven_nodes().size());
    report.skull_nodes = boundary.skull_count();
    report.mandible_nodes = boundary.mandible_count();
    if (!solution.converged)
      report.notes.push_back(
          fmt::format("The reduced model stopped growing at {} vectors with an estimated error of "
                      "{:.1e}, above the wanted {:g}: solving for all unknowns at every step (the "
                      "direct method) has no such error.",
                      solution.basis_size, solution.estimated_error, options_.solver.tolerance));

    Performance& p = result_.performance;
    p.nodes = mesh_.volume.nodes;
    p.tets = mesh_.volume.tets;
    const auto floats = [](const std::vector<double>& values) {
      return std::vector<float>(values.begin(), values.end());
    };
    p.tet_young_pa = floats(material.young_pa);
    p.tet_poisson = floats(material.poisson);
    p.tet_viscosity_pa_s = floats(material.viscosity_pa_s);
    const std::vector<int> held = boundary.held_nodes();
    p.held_points_rest.resize(held.size(), 3);
    for (std::size_t i = 0; i < held.size(); ++i)
      p.held_points_rest.row(i) = mesh_.volume.nodes.row(held[i]);
    for (const PointsF& d : p.node_displacement_m) {
      const auto inverted = fem::inverted_tets(p.nodes, p.tets, d.cast<double>());
      report.inverted_tets = std::max(
          report.inverted_tets, static_cast<int>(std::count(inverted.begin(), inverted.end(), 1)));
    }
  }

  void store(const Shot& shot, const Points& nodes) {
    const PointsF skin = carrier_.carry(nodes, input_.at(shot.time_s));
    Performance& p = result_.performance;
    if (shot.frame < 0) {
      result_.still_displacement_m[-1 - shot.frame] = skin;
    } else {
      p.skin_displacement_m[shot.frame] = skin;
      if (!p.node_displacement_m.empty()) p.node_displacement_m[shot.frame] = nodes.cast<float>();
    }
  }

  /// Everything but the frames themselves.
  void describe() {
    Performance& p = result_.performance;
    p.skin_rest = mesh_.skin;
    p.scan_vertices = mesh_.scan_vertices;
    p.appended = mesh_.appended;
    p.source_triangle = mesh_.source_triangle;
    p.lip_cut_rest = mesh_.lip_cut;
    p.landmarks = landmark_tracks(mesh_, landmarks_, p.frame_time_s, p.skin_displacement_m);
    std::vector<int> rows;
    for (const std::string& name : options_.drive.names_in(motion_.motion))
      if (const int row = motion_.motion.index_of(name); row >= 0) {
        rows.push_back(row);
        p.driven_names.push_back(name);
      }
    p.driven_points_rest.resize(rows.size(), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
      p.driven_points_rest.row(i) = motion_.rest.row(rows[i]);
    p.peak_frame = peak_frame(rows);
    measure_lips();
    measure_driven(rows);
  }

  /// How far the driven points end from where they are driven.
  void measure_driven(const std::vector<int>& rows) {
    const Performance& p = result_.performance;
    const auto places = skin_places(mesh_, p.driven_names, p.driven_points_rest);
    std::vector<double> off_m(rows.size(), 0);
    for (std::size_t f = 0; f < p.frame_time_s.size(); ++f) {
      const Points wanted = input_.at(p.frame_time_s[f]);
      const Points skin = p.skin_displacement_m[f].cast<double>();
      for (std::size_t i = 0; i < rows.size(); ++i)
        off_m[i] = std::max(
            off_m[i], (places[i].displacement(skin) - wanted.row(rows[i]).transpose()).norm());
    }
    std::string names;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      result_.report.driven_off_mm = std::max(result_.report.driven_off_mm, 1e3 * off_m[i]);
      if (off_m[i] > kDrivenWithin_m) names += (names.empty() ? "" : ", ") + p.driven_names[i];
    }
    if (!names.empty())
      result_.report.notes.push_back(
          fmt::format("driven points end up to {:.2f} mm from where they are driven: {}; points "
                      "that lie closer "
                      "together than the elements and move differently are met in the mean",
                      result_.report.driven_off_mm, names));
  }

  int peak_frame(const std::vector<int>& rows) const {
    const auto& times = result_.performance.frame_time_s;
    int best = 0;
    double most = -1;
    for (std::size_t f = 0; f < times.size(); ++f) {
      double score = 0;
      if (options_.time.peak_time_s >= 0) {
        score = 1 / (1 + std::abs(times[f] - options_.time.peak_time_s));
      } else {
        const Points d = input_.at(times[f]);
        for (int row : rows) score += d.row(row).norm();
      }
      if (score > most + 1e-12) {
        most = score;
        best = static_cast<int>(f);
      }
    }
    return best;
  }

  void measure_lips() {
    const LipContact contact(mesh_, landmarks_);
    const Performance& p = result_.performance;
    const int upper = p.landmarks.index_of(tissue::ibug(62)),
              lower = p.landmarks.index_of(tissue::ibug(66));
    for (std::size_t f = 0; f < p.frame_time_s.size(); ++f) {
      const Points skin = mesh_.skin.points + p.skin_displacement_m[f].cast<double>();
      result_.report.lip_overlap_mm =
          std::max(result_.report.lip_overlap_mm, 1e3 * contact.depth(skin));
      const auto gap = [&](const Points& at) {
        return 1e3 * (at.row(upper) - at.row(lower)).norm();
      };
      result_.report.lip_gap_mm =
          std::max(result_.report.lip_gap_mm,
                   gap(p.landmarks.positions[f]) - gap(p.landmarks.positions.front()));
    }
  }

  const tissue::TissueMesh& mesh_;
  const io::Landmarks& landmarks_;
  const AlignedMotion& motion_;
  const SimulationOptions& options_;
  MeasuredRegion region_;
  Input input_;
  SkinCarrier carrier_;
  double end_s_ = 0;
  std::vector<Shot> shots_;
  SimulationResult result_;
};

}  // namespace

SimulationResult simulate(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          const AlignedMotion& motion, const SimulationOptions& options) {
  return Run(mesh, landmarks, motion, options).finish();
}

}  // namespace hyperex::reenact
