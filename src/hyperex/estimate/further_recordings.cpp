// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/further_recordings.hpp"

namespace hyperex::estimate {
namespace {

/// The file of the recording.
std::filesystem::path& file_of(scene::MotionOptions& motion) {
  for (auto* file : {&motion.recording, &motion.openface, &motion.arkit})
    if (!file->empty()) return *file;
  return motion.source.file;
}

}  // namespace

std::filesystem::path recording_of(scene::MotionOptions motion) {
  return file_of(motion);
}

FurtherRecordings::FurtherRecordings(const session::FaceSession& session)
    : scene_(session.scene()) {
  scene_.given.scan = std::make_shared<const io::Scan>(session.scan());
  scene_.given.landmarks = session.inputs().landmarks;
  scene_.motion.source.embedded = false;
}

session::Inputs FurtherRecordings::read(const std::filesystem::path& file) const {
  scene::Scene other = scene_;
  file_of(other.motion) = file;
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

std::string name_of(scene::MotionOptions motion) {
  const std::filesystem::path file = recording_of(std::move(motion));
  if (!file.empty()) return file.filename().string();
  return "the embedded recording";
}

}  // namespace hyperex::estimate
