// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a Simulator holds and does. Its methods are in simulator_*.cpp: _changes what is set,
// _stages how each stage is computed, _run and _finite a run, _frames what is read off it,
// _contact and _stream.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/run/contact_frames.hpp"
#include "hyperex/simulate/run/finite_run.hpp"
#include "hyperex/simulate/run/frame_time.hpp"
#include "hyperex/simulate/run/run_progress.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/simulate/run/simulator_stages.hpp"
#include "hyperex/simulate/run/solve.hpp"

namespace hyperex::simulate {

/// Share of a run's progress at which the motion of the tissue is known.
constexpr double kLoadDone = 0.3, kReducedDone = 0.6, kDirectDone = 0.9;
/// Share of it at which contact at finite strain begins, which often takes longer than the motion.
constexpr double kBeforeFiniteContact = 0.4;

struct Simulator::Impl {
  Impl() = default;
  /// Shares the stages that copies have in common.
  Impl(const Impl& other);

  std::shared_ptr<const tissue::TissueMesh> mesh;
  std::shared_ptr<const io::Landmarks> landmarks;
  std::shared_ptr<const AlignedMotion> motion;
  std::shared_ptr<const std::vector<Obstacle>> obstacles;
  SimulationOptions options;
  SimulatorStages stages;
  std::optional<double> stream_interval_s;  // none: start_stream() was not called
  SimulationReport report;
  SimulationReport prepared;  // what prepare() took, for the next run's report
  RunProgress progress;

  // ----- what is set

  void set(SimulationOptions next);
  template <class Part>
  void set_part(Part SimulationOptions::*part, Part value) {
    SimulationOptions next = options;
    next.*part = std::move(value);
    set(std::move(next));
  }
  void set(AlignedMotion next);
  void set(std::shared_ptr<const std::vector<Obstacle>> next);
  void use_order(std::shared_ptr<const EliminationOrder> order);
  void take_factor(Impl& spent);

  // ----- stages: each ensure_x() computes x where there is none or where it is out of date

  double end_s() const;
  int steps() const;
  bool by_forces() const;
  /// Readout, measured region and driven points.
  void ensure_skin();
  /// The boundary, which unknowns it prescribes, and the values of the matrices.
  void ensure_boundary();
  /// Where segments of bone go (options.surgery).
  void ensure_moved_bones();
  /// Forces of tissue that grows.
  void ensure_added_volume();
  /// The tissue's assembler; at finite strain, that of the tissue grown by the added volume.
  const fem::Assembler& grown_pattern();
  /// Whether moved bones or added volume change the face at rest. Needs the stage `moved_bones`.
  bool changes_rest() const;
  void ensure_pattern();
  void ensure_factor();
  void ensure_full_model();
  void ensure_muscle_model();
  /// Throws InputError where forces are to drive a face of which a region is measured.
  void check_no_region_is_measured() const;
  /// Throws InputError where the run ends after the load.
  void check_load_lasts() const;
  void ensure_load(const PointCurve& points);
  void ensure_input(const PointCurve& points);
  void ensure_obstacle_places();
  void ensure_contact_model();
  void check_before_run();
  void prepare();

  fem::Material material() const;
  fem::NewmarkOptions newmark() const;
  /// The matrices of the tissue and the support that are set.
  void fill(fem::System& system);
  /// Reports the time that a new factor took, and keeps its order.
  template <class Model>
  void report_factor(const Model& model);
  std::shared_ptr<const fem::NodeOrder> known_order() const;
  void keep_order(const std::shared_ptr<const fem::NodeOrder>& nodes);
  HeldLoad reaction_load(const PointCurve& points);
  /// The load with the jaw's springs where moved bones have them.
  HeldLoad on_moved_bones(HeldLoad load) const;
  fem::Drive drive_by(const HeldLoad& forces, const MuscleOptions& muscles) const;
  /// The displacement (all unknowns, m) of the face at rest by moved bones, in static equilibrium
  /// at small strain; empty where none are moved.
  Eigen::VectorXd neutral_at_small_strain();
  std::unique_ptr<fem::PartitionedFactor> contact_factor(const std::vector<int>& nodes) const;

  // ----- a run

  SimulationResult run();
  PointsF still(double time_s);
  /// Moves the tissue and stores the frames.
  void simulate_tissue(const std::vector<FrameTime>& frame_times, const PointCurve& points,
                       SimulationResult& result);
  /// Displacements at `times`, in steps.
  Solution solve_linear(const std::vector<double>& times);
  void ensure_response(const fem::ReducedOptions& how);
  /// The response with changed gains, as the sum of the response to the load as recorded and that
  /// to the load that the gains add. Empty where this would save little, or where the estimated
  /// error of the sum exceeds the tolerance. Its numbers do not depend on earlier runs.
  std::optional<fem::Response> response_by_gains(const fem::ReducedOptions& how);
  void report_solution(const Solution& solution);
  /// Where bones are moved: adds the face at rest to displacements at small strain (at finite
  /// strain they have it), and notes the skin at rest.
  void place_neutral(bool finite, const PointCurve& points, Solution& solution,
                     Performance& performance);

  // ----- a run at finite strain

  Solution solve_finite(const std::vector<double>& times);
  /// The ends of the steps, from 0 to the end of the run, s.
  std::vector<double> finite_times_s() const;
  /// Where the load's patches go at small strain.
  NodalCourse patch_places(const std::vector<double>& times_s);
  FiniteDrive finite_drive(const MuscleOptions& muscles, const NodalCourse* places) const;
  /// `hold_patches`: the load's patches are prescribed, and the forces that hold them are found.
  FiniteSolution run_at_finite_strain(const MuscleOptions& muscles, bool hold_patches,
                                      const std::vector<double>& times);

  // ----- frames

  /// Times in steps, from 0 to the last step.
  std::vector<double> in_steps(const std::vector<FrameTime>& frame_times) const;
  void store(const FrameTime& at, const Points& nodes, const PointCurve& points,
             SimulationResult& result) const;
  /// The jaw in each frame and still.
  void place_jaw(const PointCurve& points, SimulationResult& result) const;
  /// The jaw's places (Performance::jaw_now_from_rest) at times from the start of the motion, once
  /// the input is there. The jaw follows the chin's points or, where muscles drive, it moves as in
  /// their load. A mandible that is held stays at rest.
  std::vector<Eigen::Isometry3d> jaw_now_from_rest(const std::vector<double>& times_s,
                                                   const PointCurve& points) const;
  void describe_tissue(Performance& p);
  void describe_skin(const PointCurve& points, Performance& p);
  void note_driven_off(const std::vector<double>& off_m, const PointCurve& points,
                       const std::vector<double>& frame_time_s);
  void warn(const char* id, const char* key, std::string text);

  // ----- contact

  /// Corrects the frames in which something would pass through something else.
  void resolve_contact(const std::vector<FrameTime>& frame_times, const PointCurve& points,
                       Solution& solution, SimulationResult& result);
  /// Correct `touching` frames of `solution`. Both return the greatest residual of the
  /// complementarity problems, m.
  double correct_linear(const ContactFrames& frames, const std::vector<std::size_t>& touching,
                        Solution& solution);
  /// The nodes of one frame in which the lips pass through each other, corrected.
  Points with_lips_apart(const Eigen::Map<const Points>& nodes, const PointsF& skin);
  double correct_finite(const ContactFrames& frames, const std::vector<std::size_t>& touching,
                        const PointCurve& points, Solution& solution);

  // ----- a stream

  void start_stream(double interval_s);
  void ensure_stream();
  PointsF step(const Points& displacement_m);
};

/// Adds springs that hold driven nodes. Contact uses them instead of prescribed displacements.
void add_patch_springs(const tissue::TissueMesh& mesh, const std::vector<int>& nodes,
                       double stiffness_pa_per_m, fem::SparseMatrix& stiffness);

}  // namespace hyperex::simulate
