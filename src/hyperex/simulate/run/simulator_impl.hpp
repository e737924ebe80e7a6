// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a Simulator holds and does: its stages in the order of simulator.hpp's table. Parted into
// files by what they are for: simulator_changes, _stages, _run, _stream.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/simulate/contact/mouth_contact.hpp"
#include "hyperex/simulate/drive/boundary.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"
#include "hyperex/simulate/load/held_load.hpp"
#include "hyperex/simulate/run/finite_run.hpp"
#include "hyperex/simulate/run/readout.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/simulate/run/solve.hpp"
#include "hyperex/simulate/run/stream.hpp"

namespace hyperex::simulate {

/// Share of a run's progress at which the motion of the tissue is known.
constexpr double kReducedDone = 0.2, kDirectDone = 0.9;

/// A time at which a shape is wanted, and where it goes.
struct Shot {
  double time_s;
  int frame;  ///< or -1 - index of a still
};

class MuscleModel;

struct Simulator::Impl {
  // Given.
  std::shared_ptr<const tissue::TissueMesh> mesh;
  std::shared_ptr<const io::Landmarks> landmarks;
  std::shared_ptr<const AlignedMotion> motion;
  SimulationOptions options;

  // Stages in the order of the header's table; null where they are still to be computed. What
  // copies may share is const.
  std::shared_ptr<const Readout> readout;  // of the face alone
  std::shared_ptr<const MeasuredRegion> region;
  std::shared_ptr<const DrivenPoints> driven_points;
  std::shared_ptr<const DrivenSkin> driven;
  std::shared_ptr<const Boundary> boundary;
  std::shared_ptr<const fem::Assembler> assembler;
  std::shared_ptr<const EliminationOrder> order;
  /// Of the last load that was found; used again where the motion alone is another, as a mirrored
  /// twin's is.
  struct KnownMuscles;
  std::shared_ptr<const KnownMuscles> known_muscles;
  std::shared_ptr<const HeldLoad> load;
  bool load_held = false;
  bool load_lost = false;  // there was one, for the tissue or support before
  std::shared_ptr<const InputShapes> input;
  std::shared_ptr<const std::vector<Obstacle>> obstacles;  // given
  std::shared_ptr<const std::vector<std::shared_ptr<const ObstaclePlaces>>> touchable;
  // Of this simulator alone.
  std::optional<fem::ReducedModel> reduced;
  std::optional<fem::Newmark> full;
  bool reduced_current = false, full_current = false;  // with the tissue that is set
  /// All that the values of the matrices rest on, once their patterns are there.
  struct Values {
    TissueValues tissue;
    ModelOptions model;
    DriveBy by;
    MuscleOptions muscles;
    std::shared_ptr<const Boundary> boundary;
    bool operator==(const Values& other) const;
  };
  std::optional<Values> reduced_values;  // that the factor was made of
  std::optional<fem::Response> response;
  std::optional<fem::Response> recorded_response;  // to the load as it was recorded
  /// What the last change of gains adds to it, per muscle over the greatest change.
  struct AddedResponse {
    Eigen::VectorXd direction;
    std::optional<fem::Response> response;  // none: not simpler than the whole
  };
  std::optional<AddedResponse> added;
  // Of the values, the driven points, the options and which places come near.
  std::optional<MouthContact> contact;
  std::optional<fem::PartitionedFactor> contact_factor;
  std::vector<std::vector<char>> contact_near;

  std::optional<Stream> stream;
  bool stream_current = false, stream_fits = false;  // with the values; with the pattern and order

  SimulationReport report;
  SimulationReport prepared;  // what prepare() took, for the next run's report
  RunCallbacks callbacks;
  double told = 0;  // of the progress

  // ----- what is left when something is set

  void drop_contact();
  void drop_values();
  void drop_factors();
  void drop_input();
  /// Of what it was found in: tissue and support; held, it stays.
  void drop_load();
  void drop_boundary();
  void drop_driven();
  void drop_region();
  void set(SimulationOptions next);
  template <class Part>
  void set_part(Part SimulationOptions::*part, Part value) {
    SimulationOptions next = options;
    next.*part = std::move(value);
    set(std::move(next));
  }
  void set(AlignedMotion next);

  // ----- stages

  void ask() const;
  /// The share of the run that is done; asks too.
  void tell(double share);
  /// Frames side by side: half of what the progress still has to go.
  void for_frames(std::size_t count, const std::function<void(std::size_t)>& body);
  double end_s() const;
  int steps() const;
  void need_region();
  bool by_forces() const;
  void need_boundary();
  void keep_or_drop_order();
  void take_factor(Impl& spent);
  fem::Material material() const;
  void need_assembler();
  Values values() const;
  /// The matrices with the tissue and the support that are set, over patterns that are there.
  void fill(fem::System& system);
  /// Makes a factor or refills it: `Model` is fem::ReducedModel or fem::Newmark.
  template <class Model, class Make>
  void need_factor(std::optional<Model>& model, bool& current, Make make);
  fem::NewmarkOptions newmark() const;
  std::shared_ptr<const fem::NodeOrder> known_order() const;
  void keep_order(const std::shared_ptr<const fem::NodeOrder>& nodes);
  void need_reduced();
  void need_full();
  const MuscleModel& need_muscles();
  /// The forces that make the motion in the tissue that is set.
  void need_load(const PointCurve& points);
  void note_found_anew();
  fem::Drive drive_by(const HeldLoad& forces, const MuscleOptions& muscles) const;
  void need_input(const PointCurve& points);
  void prepare();

  // ----- a run

  void make_contact_factor(const std::vector<int>& nodes);
  /// Per obstacle and place: whether it ever comes near.
  void need_contact(std::vector<std::vector<char>> coming_near);
  void need_places();
  /// Corrections of frames that were found at small strain, or at finite strain: there the forces
  /// are found in the compliance at rest, some rounds, and what they do in the tissue as it stands.
  /// Both change `solution` and return the greatest residual of the complementarity problems (m).
  struct Touching;
  double correct_linear(const Touching& frames, Solution& solution);
  double correct_finite(const Touching& frames, Solution& solution);
  /// What contact changes in the frames that were stored.
  void touch(const std::vector<Shot>& shots, const PointCurve& points, Solution& solution,
             SimulationResult& result);
  /// The response to the load with other gains as that to the load as recorded and that to what the
  /// gains add, where the latter is simpler than the whole; nothing where it is not, or where both
  /// errors together are more than is wanted. Numbers do not depend on what was run before.
  std::optional<fem::Response> response_by_gains(const fem::ReducedOptions& how);
  Solution solved(const std::vector<double>& times);
  /// From 0 to the end, s: of the steps at finite strain.
  std::vector<double> finite_times_s() const;
  NodalCourse patch_places(const std::vector<double>& times_s);
  /// `holds`: the load's patches are prescribed and what holds them is found.
  FiniteSolution run_at_finite_strain(const MuscleOptions& muscles, bool holds,
                                      const std::vector<double>& times);
  Solution solved_finite(const std::vector<double>& times);
  void integrate(const std::vector<Shot>& shots, const PointCurve& points,
                 SimulationResult& result);
  /// The jaw in each frame and still.
  void place_jaw(const PointCurve& points, SimulationResult& result) const;
  void store(const Shot& shot, const Points& nodes, const PointCurve& points,
             SimulationResult& result) const;
  void describe_tissue(Performance& p);
  /// The jaw's places (Performance::jaw_now_from_rest) at times from the start of the motion, once
  /// the input is there: where the chin's points lead it or, where muscles drive, as their load has
  /// it; where the mandible is held, at rest.
  std::vector<Eigen::Isometry3d> jaw_now_from_rest(const std::vector<double>& times_s,
                                                   const PointCurve& points) const;
  /// Everything but the frames themselves.
  void describe(const PointCurve& points, Performance& p);
  void note_driven_off(const std::vector<double>& off_m, const std::vector<std::string>& points);
  SimulationResult run();
  PointsF still(double time_s);

  // ----- a stream

  void start_stream(double interval_s);
  /// With what is set now: the motion goes on where the pattern and the driven nodes are the same.
  void renew_stream(double interval_s);
  PointsF step(const Points& displacement_m);
};

}  // namespace hyperex::simulate
