// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/pose_floor.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::session {

/// Everything a scene names, read, checked and brought into the scan's frame.
struct Inputs {
  io::Scan scan;
  io::Landmarks landmarks;          ///< completed: the 68 iBUG points and the anatomical ones
  std::vector<std::string> placed;  ///< landmarks that were not given
  anatomy::Teeth teeth;             ///< the user's own scans of them; often none
  std::shared_ptr<const anatomy::Bones> bones;  ///< the person's own; null: none are known
  simulate::AlignedMotion motion;  ///< gaps filled, without head pose, in the scan's frame
  /// Greatest over the samples, 95 % bounds (motion::StabilisedMotion).
  double head_shift_uncertainty_mm = 0, head_turn_uncertainty_deg = 0;
  /// False where no noise is seen in the recorded points that hold the head, and none is excluded:
  /// then the bounds above are 0 but not known.
  bool head_uncertainty_known = true;
  /// What errors of the head's pose make, by the recording's pairs of points, without motion.gain.
  std::map<std::string, metrics::PairPoseVariance> pose_variance;
  double jitter_m = 0;  ///< of the points that S(t) takes, without motion.gain; 0: none known
  /// False if the recorded points show no jitter and none is stated: they may be smoothed.
  bool jitter_known = true;
  /// Length of the recording in the run, from time.start_s on; 0: unknown. In a quick reading of a
  /// camera's recording, it is computed from the number of frames.
  double lasts_s = 0;
  /// The part of lasts_s before time.start_s, in which the run leads the face from rest into the
  /// recording; in the recording's own seconds.
  double lead_s = 0;
  /// How the eyes turn, in the run's seconds; nothing where the recording has no gaze.
  std::optional<expression::GazeTrack> gaze;
  std::vector<std::string> driven;  ///< names of the driven points
  /// What was guessed, placed or filled, and probable mistakes with their remedies, in the order in
  /// which they were found.
  std::vector<Note> notes;
};

/// Finds the landmarks of a scan that has none (tracking/scan). Adds a note with `why` and how well
/// the pictures agree. Takes seconds, unless they were found before and `kept`. Throws InputError
/// where no face is found.
io::Landmarks find_landmarks(const io::Scan& scan, const std::string& why, std::vector<Note>& notes,
                             const KeptResults& kept = {});

/// Whether the files of a scene are read completely.
enum class Extent {
  full,
  /// A camera's recording as far as its first frame with a face. Landmarks of a scan that has none
  /// are not searched for, and what depends on them (the alignment, whether the elements are small
  /// enough) is left out. Notes report this.
  quick,
  searched  ///< as quick, but landmarks are searched for
};

/// Throws InputError, as far as possible with all problems at once. `with_variants`: also where
/// check_names_of_variants() does.
Inputs read_inputs(const scene::Scene& scene, Extent extent = Extent::full,
                   bool with_variants = true);

/// Throws InputError where a variant names points or landmarks that this face lacks. `inputs`: with
/// landmarks.
void check_names_of_variants(const scene::Scene& scene, const Inputs& inputs);

/// A scene's inputs with a variant's driven points.
Inputs inputs_of_variant(const scene::Scene& variant, const Inputs& inputs);

}  // namespace hyperex::session
