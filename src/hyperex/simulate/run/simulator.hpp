// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "hyperex/simulate/contact/obstacles.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/performance.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::fem {
struct NodeOrder;
}

namespace hyperex::simulate {

/// Driven points that end farther than this from where they are driven are named in a note.
inline constexpr double kDrivenWithin_m = 1e-4;

inline constexpr const char* kForcesFoundAnew =
    "tissue or support was changed and no forces were held: this run found forces of its own, "
    "which meet the recording again; to see what the same forces do in other tissue, call "
    "hold_load() before the change";

/// gamma of Newmark's method for a stream; beta is (gamma + 1/2)^2 / 4, which damps the most of
/// what the steps do not resolve.
inline constexpr double kStreamGamma = 0.9;

/// What happened, for the summary. Seconds are those of the last run: 0 for what it could keep.
struct SimulationReport {
  int free_dofs = 0, steps = 0, driven_nodes = 0, skull_nodes = 0, mandible_nodes = 0;
  int input_shapes = 0, basis_size = 0;                            ///< basis_size 0: full model
  fem::LinearSolver linear_solver = fem::LinearSolver::automatic;  ///< the one picked
  int iterations = 0, factorisations = 0;  ///< of finite strain, whose `steps` are those it took
  /// Of the reduced model or, at finite strain, of the iterations: over the greatest displacement.
  double estimated_error = -1;
  double verified_error = -1;  ///< measured against the full model; below 0: not measured
  double boundary_s = 0, assemble_s = 0, analyse_s = 0, factor_s = 0, basis_s = 0, simulate_s = 0,
         skin_s = 0;
  /// Where forces drive: tissue or support was changed after a run, no load was held, and so this
  /// run met the recording by other forces. kForcesFoundAnew is then among the notes.
  bool forces_found_anew = false;
  int inverted_tets = 0;            ///< greatest number in any frame (det(I + grad u) <= 0)
  double greatest_opening_deg = 0;  ///< of the jaw
  double driven_off_mm = 0;   ///< greatest distance of any driven point from where it is driven
  double lip_overlap_mm = 0;  ///< greatest depth of LipSurfaces: the lips in each other, over rest
  double lip_gap_mm = 0;      ///< greatest distance between the lips (ibug68_62, 66), over rest
  /// Of ContactOptions; all 0 where it is off. Depths are beyond rest, each vertex by itself:
  /// those of LipSurfaces, the lips going on inwards from their rims, and of ObstaclePlaces.
  struct Contact {
    int frames = 0;         ///< in which something touches that would pass without contact
    double overlap_mm = 0;  ///< greatest depth of the lips in each other, without contact
    double left_mm = 0;     ///< and with it
    double teeth_mm = 0, teeth_left_mm = 0;  ///< of tissue in teeth, likewise
    double eyes_mm = 0, eyes_left_mm = 0;    ///< of lids in eyeballs, likewise
    double residual_mm = 0;                  ///< greatest of the complementarity problems
    double seconds = 0;
  } contact;
  std::vector<std::string> notes;
};

struct SimulationResult {
  Performance performance;
  std::vector<PointsF> still_displacement_m;  ///< of the skin at the still times
  std::vector<Eigen::Isometry3d>
      still_jaw_now_from_rest;  ///< as Performance has it, at those times
  SimulationReport report;
};

/// What a long run tells, and how it is ended early; both may be empty. Called on run()'s thread.
/// And how much it measures.
struct RunCallbacks {
  std::function<void(double share)> progress;  ///< rises from 0 to 1, by steps and by frames
  std::function<bool()> cancelled;             ///< asked at each step, frame and stage
  /// Only what is needed of the skin's frames and the landmarks' tracks: of the report neither
  /// inverted_tets nor lip_overlap_mm, lip_gap_mm and driven_off_mm.
  bool skin_alone = false;
};
/// Thrown by run() where RunCallbacks::cancelled said so; the simulator stays usable.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// How the free unknowns are eliminated. It depends on the mesh, on model.element and on which
/// unknowns are prescribed, not on tissue: worth keeping where a face is simulated again.
struct EliminationOrder {
  std::vector<int> prescribed;  ///< unknowns 3 n + axis, rising
  std::shared_ptr<const fem::NodeOrder> nodes;
};

/// A face that is simulated again and again (section 5 of the method): a measured region follows
/// the tracked triangles, the rest of the face is a layer of viscoelastic tissue driven by patches
/// of skin, supported by border and bones. Each stage is computed when a run first needs it and
/// kept until something that it depends on is set:
///
///   stage                    depends on
///   measured region          motion, region
///   driven skin              measured region, drive (not its gain)
///   boundary                 driven skin, support
///   pattern of the matrices  model.element
///   order of elimination     pattern, which unknowns are prescribed, solver.linear
///   factor                   order, tissue, model, stiffness of the support
///   load (drive.by forces)   driven skin, motion, drive.gain, support, tissue, model, muscles but
///                            their gains; with hold_load() nothing
///   input                    boundary or load, motion, drive.gain, muscles, time.step_s, end_s,
///                            solver.tolerance
///   reduced motion           factor, input, solver
///   compliance of what       values of the factor, driven points, contact, obstacles, which of
///     touches                their places come near
///   frames of the skin       reduced motion, time, contact
///   stream                   factor, boundary; begins anew with another order
///
/// A run after set_tissue() factors again, but neither matches, orders nor analyses. Equal options
/// give equal numbers, whatever was set and run before. One caller at a time; copies are
/// independent and may run in other threads.
class Simulator {
 public:
  /// Throws InputError where options are out of range (check()).
  Simulator(std::shared_ptr<const tissue::TissueMesh> mesh, io::Landmarks landmarks,
            AlignedMotion motion, SimulationOptions options = {});
  /// Shares the stages that a factor does not need to itself: what a variant begins with.
  Simulator(const Simulator& other);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator) noexcept;
  ~Simulator();

  const SimulationOptions& options() const;
  const tissue::TissueMesh& mesh() const;
  const io::Landmarks& landmarks() const;
  const AlignedMotion& motion() const;

  /// Each throws InputError where a value is out of range, and then changes nothing.
  void set_options(SimulationOptions options);
  void set_tissue(TissueValues tissue);
  void set_support(SupportOptions support);
  void set_drive(DriveOptions drive);
  void set_motion(AlignedMotion motion);
  /// What ContactOptions::teeth and eyes let tissue touch; null: nothing.
  void set_obstacles(std::shared_ptr<const std::vector<Obstacle>> obstacles);

  /// Where forces drive (DriveBy::muscles, reactions): the forces found by the next run, or by the
  /// last, are kept whatever tissue and support are set from now on. Copies keep them too, so that
  /// a variant answers base's forces. A new motion, drive or muscle (not a gain) finds new ones.
  void hold_load();

  /// Takes the factor of a simulator that is not needed any more, to be filled with this one's
  /// values: its memory and analysis are used again. Nothing where orders of elimination differ,
  /// so make it before options are set, on two copies of one simulator. Numbers stay the same.
  void reuse_factor(Simulator&& spent);

  /// The stages up to the factor, which run() would begin with: so that copies made before the
  /// first run share what they can. Throws as run().
  void prepare();

  /// That of the last run or of prepare(); null before.
  std::shared_ptr<const EliminationOrder> elimination_order() const;
  /// Of a simulator of the same mesh and element: found anew only where other unknowns are
  /// prescribed.
  void use_order(std::shared_ptr<const EliminationOrder> order);

  /// Throws InputError for points that do not exist, NumericalError where the model cannot be
  /// solved, Cancelled.
  SimulationResult run(const RunCallbacks& callbacks = {});

  /// The skin's displacement (|skin| x 3, m, scan frame) at `time_s` since the start of the motion,
  /// at rest there: without inertia and viscosity, of small strain, without contact. For a view
  /// that follows a slider: where nothing but gains was set it takes one solution, after other
  /// tissue a factor too. Throws as run().
  PointsF still(double time_s);

  /// For points that come in one sample after the other, `interval_s` apart (> 0), from a tracker
  /// that is running: begins at rest with all unknowns. Throws as run() does, and InputError where
  /// the whole skin is measured.
  void start_stream(double interval_s);
  /// `displacement_m`: of all the motion's points since rest, in its order (P x 3, m, scan frame,
  /// finite; the gain is applied here). Returns the skin's (|skin| x 3, m). A step of Newmark's
  /// method with the numerical damping kStreamGamma, so that noise of single samples does not ring.
  /// Tissue and support set meanwhile take effect with the next step, the motion goes on.
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
