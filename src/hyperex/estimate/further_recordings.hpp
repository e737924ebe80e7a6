// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::estimate {

/// Reads further recordings of a session's face, whose scan and landmarks are known.
class FurtherRecordings {
 public:
  explicit FurtherRecordings(const session::FaceSession& session);
  /// Reads a recording of the same kind as the scene's, with the scene's options. Throws
  /// InputError.
  session::Inputs read(const std::filesystem::path& file) const;
  /// Reads named points (CSV, TRC), of which the first sample is at rest. From [motion], only the
  /// options on points apply. Throws InputError.
  session::Inputs read_points(const std::filesystem::path& file) const;

 private:
  scene::Scene scene_;
};

/// The name of the recording that moves a scene's face.
std::string name_of(const scene::MotionOptions& motion);

}  // namespace hyperex::estimate
