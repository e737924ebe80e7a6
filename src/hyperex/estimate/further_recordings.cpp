// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/further_recordings.hpp"

#include "hyperex/scene/recording_file.hpp"

namespace hyperex::estimate {

FurtherRecordings::FurtherRecordings(const session::FaceSession& session)
    : scene_(session.scene()) {
  scene_.given.scan = std::make_shared<const io::Scan>(session.scan());
  scene_.given.landmarks = session.inputs().landmarks;
  scene_.motion.source.embedded = false;
}

session::Inputs FurtherRecordings::read(const std::filesystem::path& file) const {
  scene::Scene other = scene_;
  scene::recording_file(other.motion) = file;
  return session::read_inputs(other);
}

session::Inputs FurtherRecordings::read_points(const std::filesystem::path& file) const {
  scene::Scene other = scene_;
  other.motion = {};
  other.motion.source.file = file;
  const bool points = scene_.motion.recording.empty() && scene_.motion.openface.empty() &&
                      scene_.motion.arkit.empty();
  if (points) {
    other.motion.unit = scene_.motion.unit;
    other.motion.rigid_points = scene_.motion.rigid_points;
  }
  other.time.end_s = 0;
  other.drive.points.clear();
  other.drive.all_points = true;  // the points that all recordings have are observed
  return session::read_inputs(other);
}

std::string name_of(const scene::MotionOptions& motion) {
  const std::filesystem::path& file = scene::recording_file(motion);
  return file.empty() ? "the embedded recording" : file.filename().string();
}

}  // namespace hyperex::estimate
