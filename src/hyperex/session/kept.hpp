// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

// Results that take seconds and depend on the inputs alone are computed once and cached
// (KeptResults), under a hash of the inputs' bytes, of the options that matter and of the program.
// The log names each cached result that is used.

struct FoundLandmarks {
  io::Landmarks landmarks;  ///< as tracking::ScanLandmarks has them, bit for bit
  int views = 0;
  double spread_m = 0;
  bool without_colours = false;
};

/// tracking::find_scan_landmarks of a scan; `scan_from_canonical`: where its face is roughly known.
FoundLandmarks landmarks_on(const io::Scan& scan,
                            const std::optional<Similarity>& scan_from_canonical,
                            const KeptResults& kept);

/// anatomy::complete_landmarks() of a scan.
anatomy::CompletedLandmarks completed_landmarks(const io::Landmarks& given, const io::Scan& scan,
                                                const std::string& source, const KeptResults& kept);

/// A camera's recording, tracked, and the notes on it.
struct RecordedFace {
  motion::Motion motion;  ///< `source` and `unit_note` empty
  std::vector<Note> notes;
};

/// The scene's motion.recording as `track` returns it, from the cache where it is there.
RecordedFace recorded_face(const scene::Scene& scene, const std::function<RecordedFace()>& track);

/// The key of a result that depends on `bytes` (all inputs and options that matter) and on the
/// program.
std::string kept_key(const std::string& what, const std::string& bytes);

/// To bytes and back; nothing where the bytes hold no such result.
std::string bytes_of(const FoundLandmarks& found);
std::string bytes_of(const anatomy::CompletedLandmarks& completed);
std::string bytes_of(const RecordedFace& recorded);
std::optional<FoundLandmarks> landmarks_from(const std::string& bytes);
std::optional<anatomy::CompletedLandmarks> completed_from(const std::string& bytes);
std::optional<RecordedFace> recorded_from(const std::string& bytes);

}  // namespace hyperex::session
