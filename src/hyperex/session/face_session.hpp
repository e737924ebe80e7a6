// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One face from its inputs to its results: the program, the studio, Python and C++ programs all use
// this class to set up runs.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/session/changes.hpp"
#include "hyperex/session/face.hpp"
#include "hyperex/session/face_result.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::scene {
struct LeftOutVariant;
struct Scene;
}  // namespace hyperex::scene
namespace hyperex::metrics {
struct PeakTissue;
struct SkinUncertainty;
}  // namespace hyperex::metrics
namespace hyperex::report {
struct FaceBacking;
}

namespace hyperex::session {

struct Inputs;
struct SkinOff;
struct VariantRun;

/// When a session computes how certain its results are: the mirrored twins that give error bands,
/// and the search for landmarks that checks the given ones.
enum class Certainty {
  with_runs,  ///< beside the runs, on the other cores
  on_request  ///< by find_certainty(), so that a run answers sooner
};

struct SessionOptions {
  Certainty certainty = Certainty::with_runs;
  std::function<void(const std::string&)> stage = {};  ///< called as each stage begins
  std::function<void(const Note&)> note = {};          ///< called with each note as it is found
  /// Called with the inputs before anything is meshed. If it throws, so does the constructor.
  std::function<void(const Inputs&)> inputs = {};
  /// The constructor leaves out variants that it would refuse: left_out().
  bool leave_out_variants = false;
  /// Words for a frame in notes, such as "in the shape jawOpen". Empty: its time.
  std::function<std::string(int frame)> frame_words = {};
};

/// Wall time of the stages, s; 0 for those that were kept.
struct StageSeconds {
  double read = 0;      ///< scan and recording
  double mesh = 0;      ///< the tissue's mesh
  double tissue = 0;    ///< values that differ from place to place
  double variants = 0;  ///< all variants of the last run
};

/// A face, its motion and the options of a scene, with every stage between them and the results.
/// A stage is computed when it is first needed and kept until something that it depends on changes:
///
///   stage                  depends on
///   inputs                 [scan], [motion] but its gain, [anatomy], [alignment], [teeth],
///                          time.start_s
///   mesh, rest asymmetry   inputs, [mesh]
///   teeth                  inputs, mesh
///   tissue fields          mesh, [tissue], each face's own
///   obstacles              teeth, whether any face has contact.teeth or contact.eyes
///   simulator of base      mesh, inputs, base's options (its stages: simulator.hpp)
///   result of base         simulator of base
///   twin of base           result of base
///   simulators of variants simulator of base with its forces held, the variant's options
///   results of variants    their simulators
///   notes                  all of these
///
/// Faces are numbered: 0 is base, the scene without its variants; 1, 2, ... are its variants, in
/// the scene's order. One thread at a time. A session that was moved from cannot be used.
class FaceSession {
 public:
  /// Reads a scene file, changes keys of it, reads the files that it names, and meshes the tissue;
  /// simulates nothing yet. Relative paths in `changes` are taken from the current folder. Throws
  /// InputError.
  explicit FaceSession(const std::filesystem::path& scene_file, const Changes& changes = {},
                       SessionOptions options = {});
  /// The same for a face and a recorded motion (its own frame, metres, the head's pose included) in
  /// memory; all keys are at their defaults but `changes`. Throws InputError.
  FaceSession(Face face, motion::Motion motion, const Changes& changes = {},
              SessionOptions options = {});
  /// The same for a scene that was read (scene/scene.hpp).
  explicit FaceSession(scene::Scene scene, SessionOptions options = {});
  FaceSession(FaceSession&&) noexcept;
  FaceSession& operator=(FaceSession&&) noexcept;
  ~FaceSession();

  // ----- changes and their results

  /// Runs what is not up to date and returns the face with all changes of set(): base as long as
  /// nothing was set. Throws NumericalError, simulate::Cancelled.
  FaceResult run(const simulate::RunCallbacks& callbacks = {});

  /// Another value for a key, which the next run() takes. Keys of [tissue], [support], [drive],
  /// [muscles], [region] and motion.gain act as in a variant: where forces drive, base's forces are
  /// kept. Parts of lists are named as in "tissue.region[0].young_factor". After any other key the
  /// face is read and meshed again. Throws InputError, and then changes nothing.
  void set(const std::string& key, const Value& value);

  /// Adds a variant of this name, or replaces the changes of the one that has it, runs what is not
  /// up to date and returns the variant. Throws as set() and run().
  FaceResult variant(const std::string& name, const Changes& changes,
                     const simulate::RunCallbacks& callbacks = {});

  /// Results of the face that run() returns; calls run() first if needed.
  const simulate::Performance& performance();
  const metrics::SymmetryMeasures& measures();

  /// What was assumed, repaired and found so far, including warnings; docs/notes.md lists the ids.
  std::vector<Note> notes() const;
  /// The notes of severity warning.
  std::vector<Note> warnings() const;

  // ----- stage by stage

  /// Sets another scene of the same face. Returns false and changes nothing where it names another
  /// scan, recording or mesh, which needs a new session. Throws InputError and changes nothing
  /// where it is invalid.
  bool set_scene(scene::Scene next);

  /// Runs base where it is not up to date.
  void run_base(const simulate::RunCallbacks& callbacks = {});
  /// Runs the variants that are not up to date. After run_base(); results of base may be read
  /// meanwhile in another thread.
  void run_variants(const simulate::RunCallbacks& callbacks = {});
  bool base_up_to_date() const;
  bool up_to_date() const;  ///< base and all variants

  /// Whether all error bands are known and given landmarks are checked.
  bool certainty_known() const;
  /// Computes the missing error bands and checks given landmarks. Call it once all is up to date.
  /// Throws NumericalError, and simulate::Cancelled after `cancelled` returned true; parts computed
  /// before are kept.
  void find_certainty(const std::function<bool()>& cancelled = {});

  /// The skin's displacement (|skin| x 3, m) in static equilibrium at `time_s`: a view that follows
  /// a slider. Throws as Simulator::still().
  PointsF still(std::size_t face, double time_s);
  /// Whether still() needs to compute only what the change itself requires.
  bool ready(std::size_t face) const;
  /// Computes in advance what the first change of a first variant will need. Call it once all is up
  /// to date; does nothing where there are variants already.
  void prepare_variant();

  // ----- what it holds

  const scene::Scene& scene() const;  ///< with the drive that was chosen
  /// The variants that SessionOptions::leave_out_variants kept out of scene(), in the file's order.
  const std::vector<scene::LeftOutVariant>& left_out() const;
  const Inputs& inputs() const;
  const io::Scan& scan() const;  ///< as read; that of inputs() is thinned where it is large
  const tissue::TissueMesh& mesh() const;
  std::shared_ptr<const tissue::TissueMesh> shared_mesh() const;
  const SkinOff& skin_off() const;  ///< where the simulated skin is farthest from the scan
  std::shared_ptr<const anatomy::Teeth> teeth() const;  ///< null: none
  /// The bodies of contact that some face uses (contact.teeth, contact.eyes); null: none.
  std::shared_ptr<const std::vector<simulate::Obstacle>> obstacles() const;
  /// Why this drive was chosen, a sentence.
  const std::string& drive_reason() const;

  std::size_t faces() const;
  simulate::SimulationOptions options(std::size_t face) const;
  /// A copy of the simulator of base, which shares its stages.
  simulate::Simulator simulator() const;
  /// Where base's tissue differs from place to place; else null.
  const tissue::TissueField* field() const;
  /// Results of base, once it was run.
  const simulate::SimulationResult& simulation() const;
  const metrics::SymmetryMeasures& symmetry() const;
  const metrics::PeakTissue& tissue_at_peak() const;  ///< strain and stress of base
  /// How uncertain the skin of base is between the driven points; null where shapes of real faces
  /// do not take part (drive.by, muscles.shape_prior).
  const metrics::SkinUncertainty* skin_uncertainty() const;
  /// What lies behind the holes of base's skin, with teeth(): report::face_backing(). Null where
  /// base was not run yet, or the recording has no gaze: only the notes on a gaze need it here.
  const report::FaceBacking* backing() const;
  const std::vector<VariantRun>& variants() const;
  FaceResult result(std::size_t face) const;

  /// The tissue of another scene of this face. Throws InputError.
  simulate::TissueValues tissue_of(const scene::Scene& scene);
  /// The share (0 to 1) of the change by a region ([[tissue.region]]) of `scene`, another scene of
  /// this face, that applies at each vertex of the skin. Throws InputError.
  Eigen::VectorXd region_shares(const scene::Scene& scene, std::size_t region);
  /// The mirrored motion: each point moves as the mirror image of its counterpart. Throws
  /// InputError where points have no counterpart.
  simulate::AlignedMotion mirrored_motion() const;

  StageSeconds seconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How far check() goes.
enum class CheckDepth {
  inputs,  ///< files, names, units, given landmarks, the cost: a fraction of a second
  /// Besides, all that a run does before it assembles matrices (try_face.hpp): about 1 s. Landmarks
  /// of a scan that has none are found first, which takes 2 s unless an earlier run or check kept
  /// them (Scene::kept).
  face
};

/// Reads the files of a scene, those that take long only in part, and simulates nothing. Returns
/// notes on what is assumed, is doubtful or was not checked. Throws InputError with every problem
/// of the inputs, or with the first one that a run finds after it has read them. `cost`: set to the
/// expected cost of a run, a sentence; empty where it is unknown.
std::vector<Note> check(const scene::Scene& scene, std::string* cost = nullptr,
                        CheckDepth depth = CheckDepth::face);

}  // namespace hyperex::session

namespace hyperex {
using motion::read_motion;
using session::Face;
using session::FaceResult;
using session::FaceSession;
using session::read_face;
using session::Value;
using session::write_glb;
using session::write_motion_csv;
using session::write_skin_ply;
}  // namespace hyperex
