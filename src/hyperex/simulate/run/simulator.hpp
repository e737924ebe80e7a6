// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/core/stage_graph.hpp"
#include "hyperex/simulate/contact/obstacles.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/performance.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::fem {
struct NodeOrder;
}

namespace hyperex::simulate {

/// A note names the driven points that end farther than this from where they are driven.
inline constexpr double kDrivenWithin_m = 1e-4;

inline constexpr const char* kForcesFoundAnew =
    "tissue or support was changed and no forces were held: this run found forces of its own, "
    "which meet the recording again; to see what the same forces do in other tissue, call "
    "hold_load() before the change";

/// gamma of Newmark's method for a stream. With beta = (gamma + 1/2)^2 / 4 it damps the motions
/// that the steps do not resolve as strongly as it can.
inline constexpr double kStreamGamma = 0.9;

/// Report on a run. Times (s) are those spent in this run: 0 for stages that were kept.
struct SimulationReport {
  int free_dofs = 0, steps = 0, driven_nodes = 0, skull_nodes = 0, mandible_nodes = 0;
  int input_shapes = 0, basis_size = 0;    ///< basis_size 0: full model
  int iterations = 0, factorisations = 0;  ///< at finite strain; `steps` are then those taken
  /// Error of the reduced model or, at finite strain, of the iterations, over the greatest
  /// displacement. Below 0: not known.
  double estimated_error = -1;
  double verified_error = -1;  ///< measured against the full model; below 0: not measured
  double boundary_s = 0, assemble_s = 0, analyse_s = 0, factor_s = 0, basis_s = 0, simulate_s = 0,
         skin_s = 0;
  /// If forces drive: tissue or support was changed after a run without hold_load(), so this run
  /// found other forces that reproduce the recording. The notes then include "forces.found_anew".
  bool forces_found_anew = false;
  int inverted_tets = 0;            ///< greatest number in any frame (det(I + grad u) <= 0)
  int inverted_frame = -1;          ///< that frame; below 0: none
  double greatest_opening_deg = 0;  ///< of the jaw
  double driven_off_mm = 0;    ///< greatest distance of any driven point from where it is driven
  double lip_overlap_mm = 0;   ///< greatest depth of LipSurfaces: the lips in each other, over rest
  int lip_overlap_frame = -1;  ///< where that is; below 0: in none
  double lip_gap_mm = 0;       ///< greatest distance between the lips (ibug68_62, 66), over rest
  /// All 0 where contact is off (ContactOptions). Depths are those of LipSurfaces and of
  /// ObstaclePlaces, beyond the depth of the same vertex at rest.
  struct Contact {
    int frames = 0;         ///< frames that contact changes
    double overlap_mm = 0;  ///< greatest depth of the lips in each other, without contact
    double left_mm = 0;     ///< the same with contact
    double teeth_mm = 0, teeth_left_mm = 0;  ///< tissue in teeth: without and with contact
    double eyes_mm = 0, eyes_left_mm = 0;    ///< lids in eyeballs: without and with contact
    double residual_mm = 0;                  ///< greatest of the complementarity problems
    double seconds = 0;
  } contact;
  /// Ids: forces.found_anew, solver.reduced_not_converged, drive.points_off,
  /// contact.no_equilibrium; notes: solver.reduced_error_small, drive.points_off_by_jitter,
  /// drive.points_off_by_gain.
  std::vector<Note> notes;
};

struct SimulationResult {
  Performance performance;
  std::vector<PointsF> still_displacement_m;  ///< of the skin at the still times
  std::vector<Eigen::Isometry3d>
      still_jaw_now_from_rest;  ///< as Performance has it, at those times
  SimulationReport report;
};

/// Progress and cancellation of a run, both optional, and which measures it computes. Functions are
/// called on the thread that called run().
struct RunCallbacks {
  std::function<void(double share)> progress;  ///< rises from 0 to 1, by steps and by frames
  std::function<bool()> cancelled;             ///< called at each step, frame and stage
  /// Computes only the skin's frames and the landmarks' tracks. In the report inverted_tets,
  /// lip_overlap_mm, lip_gap_mm and driven_off_mm stay 0.
  bool skin_alone = false;
};
/// Thrown by run() after RunCallbacks::cancelled returned true. The simulator stays usable.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// The order in which the free unknowns are eliminated. It depends on the mesh, on model.element
/// and on which unknowns are prescribed, but not on tissue.
struct EliminationOrder {
  std::vector<int> prescribed;  ///< unknowns 3 n + axis, rising
  std::shared_ptr<const fem::NodeOrder> nodes;
};

/// A face that is simulated again and again (section 5 of the method): a measured region follows
/// the tracked triangles, and the rest of the face is a layer of viscoelastic tissue. Patches of
/// skin drive it, border and bones support it.
///
/// A run consists of stages. Each is computed when a run first needs it, and kept until something
/// that it is computed from changes. A test compares this table with the declaration of the stages
/// in simulator_stages.hpp:
///
///   stage                     computed from
///   readout                   -
///   measured region           motion, region
///   driven points             motion, drive (not its gain)
///   driven skin               motion, measured region, drive (not its gain)
///   boundary                  motion, driven skin, drive.by, support, muscles (not their gains)
///   moved bones               boundary, surgery
///   matrix values             boundary, drive.by, tissue (not its volume), model, muscles (not
///                             their gains)
///   pattern                   model.element
///   added volume              pattern, matrix values, tissue.volume_ratio
///   prescribed unknowns       boundary
///   order                     pattern, prescribed unknowns
///   muscle model              pattern, order, drive.by, support, tissue (not its volume), model,
///                             muscles (not their gains)
///   load was found            motion, measured region, drive (not its gain), drive.gain, muscles
///                             (not their gains), steps of reactions, end of muscles
///   load                      motion, measured region, drive (not its gain), drive.gain, muscles
///                             (not their gains), steps of reactions; unless held driven skin,
///                             muscle model, pattern, support, tissue (not its volume), model, end
///                             of muscles
///   input                     motion, boundary, moved bones, load, drive.gain, muscles.gain,
///                             muscles (not their gains), time.step_s, time.end_s,
///                             solver.tolerance
///   obstacle places           obstacles, contact.teeth or eyes
///   factor                    pattern, order, prescribed unknowns; refilled after matrix values
///   full model                pattern, order, prescribed unknowns, solver.newmark, time.step_s;
///                             refilled after matrix values
///   motion as recorded        factor, boundary, moved bones, load, muscles (not their gains),
///                             solver.newmark, time.step_s, time.end_s, solver.tolerance
///   direction of the gains    muscles.gain
///   drive that gains add      boundary, load, muscles (not their gains), direction of the gains,
///                             time.step_s, time.end_s, solver.tolerance
///   motion that gains add     factor, drive that gains add, motion as recorded, solver.newmark,
///                             time.step_s, solver.tolerance
///   reduced motion            factor, input, load, motion as recorded, drive that gains add,
///                             motion that gains add, muscles.gain, solver.newmark, time.step_s,
///                             solver.tolerance
///   places that come near     -
///   compliance in contact     readout, measured region, driven points, pattern, order, matrix
///                             values, contact, obstacle places, places that come near
///   stream                    pattern, order, prescribed unknowns; refilled after matrix values
///   frames                    reduced motion, full model, input, moved bones, added volume,
///                             compliance in contact, solver, contact, time
///
/// A refilled stage keeps its memory and its analysis, and only its numbers are computed anew. What
/// is "unless held" no longer changes the load after hold_load(). Thus a run after set_tissue()
/// factors again, but neither matches, orders nor analyses.
///
/// Equal options give equal numbers, whatever was set and run before. One caller at a time. Copies
/// are independent and may run in other threads.
class Simulator {
 public:
  /// Throws InputError where options are out of range (check()).
  Simulator(std::shared_ptr<const tissue::TissueMesh> mesh, io::Landmarks landmarks,
            AlignedMotion motion, SimulationOptions options = {});
  /// A copy shares all stages but those that change as they are used, such as factors.
  Simulator(const Simulator& other);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator) noexcept;
  ~Simulator();

  const SimulationOptions& options() const;
  const tissue::TissueMesh& mesh() const;
  const io::Landmarks& landmarks() const;
  const AlignedMotion& motion() const;
  /// The stages in the table above, and how often each was computed.
  const StageGraph& stages() const;

  /// Each throws InputError where a value is out of range, and then changes nothing. Equal options
  /// change nothing.
  void set_options(SimulationOptions options);
  void set_tissue(TissueValues tissue);
  void set_support(SupportOptions support);
  void set_drive(DriveOptions drive);
  void set_motion(AlignedMotion motion);
  /// The bodies that ContactOptions::teeth and eyes refer to; null: none.
  void set_obstacles(std::shared_ptr<const std::vector<Obstacle>> obstacles);

  /// Where forces drive (DriveBy::muscles, reactions): keeps the forces of the last run, or of the
  /// next one where there was none, whatever tissue and support are set from now on. Copies keep
  /// them too, so that a variant shows what base's forces do. A new motion, drive or muscle (not a
  /// gain) needs new forces. A run that ends later than the one that found them throws InputError
  /// where muscles drive and the motion goes on.
  void hold_load();

  /// Takes the memory and the analysis of the factor of a simulator that is not needed any more.
  /// Does nothing where the orders of elimination differ. Call it on two copies of one simulator,
  /// before options are set. Numbers stay the same.
  void reuse_factor(Simulator&& spent);

  /// Throws what prepare() and run() would throw because of points, muscles, the jaw or the number
  /// of steps, and assembles nothing: milliseconds.
  void check_before_run();

  /// Computes the stages up to the factor. Copies made afterwards share what they can. Throws as
  /// run().
  void prepare();

  /// Null before the first run() or prepare().
  std::shared_ptr<const EliminationOrder> elimination_order() const;
  /// Uses the order of a simulator of the same mesh and element. A run that prescribes other
  /// unknowns finds its own.
  void use_order(std::shared_ptr<const EliminationOrder> order);

  /// Throws InputError for points that do not exist, NumericalError where the model cannot be
  /// solved, Cancelled.
  SimulationResult run(const RunCallbacks& callbacks = {});

  /// The skin's displacement (|skin| x 3, m, scan frame) in static equilibrium at `time_s` since
  /// the start of the motion: without inertia and viscosity, at small strain, without contact. For
  /// a view that follows a slider. After a change of gains it takes one solution, after a change of
  /// tissue one factorisation too. Throws as run().
  PointsF still(double time_s);

  /// Begins a stream, at rest and with all unknowns: points come in one sample after the other,
  /// `interval_s` apart (> 0), from a tracker that is running. Throws as run(), and InputError
  /// where forces drive, at finite strain, with contact at teeth or eyes, or where the whole skin
  /// is measured.
  void start_stream(double interval_s);
  /// One step of Newmark's method, damped by kStreamGamma so that noise of single samples does not
  /// ring. With contact.lips the lips are kept apart in what is returned; the first sample in which
  /// they meet takes longer. `displacement_m`: of all the motion's points since rest, in its order
  /// (P x 3, m, scan frame, finite; the gain is applied here). Returns the displacement of the skin
  /// (|skin| x 3, m). Tissue and support that were set meanwhile take effect, and the motion goes
  /// on.
  PointsF step(const Points& displacement_m);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One run of a face that is not simulated again. `mesh` must outlive the call.
SimulationResult simulate(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          const AlignedMotion& motion, const SimulationOptions& options,
                          const RunCallbacks& callbacks = {});

}  // namespace hyperex::simulate
