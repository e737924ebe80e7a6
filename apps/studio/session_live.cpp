// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/capture/mirrored.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "session.hpp"

namespace hyperex::studio {

Live& Session::require_live() {
  if (!live_) throw InputError("no live face: start one first");
  return *live_;
}

void Session::end_live() {
  std::unique_ptr<Live> gone;
  {
    const std::lock_guard lock(live_mutex_);
    gone = std::move(live_);
  }
  if (!gone) return;
  gone->stop();
  gone->wait();
  gone->send_status();
}

void Session::drawn(std::int64_t frame) {
  const std::lock_guard lock(live_mutex_);
  if (live_) live_->drawn(frame);
}

void Session::refresh_live() {
  if (!live_ || live_->ended()) return;
  live_face_ = std::min(live_face_, face_->session().faces() - 1);
  live_->set_options(face_->options_live(live_face_, live_points()), live_face_);
}

json Session::live_start(const json& fields) {
  const scene::MotionOptions& motion = require_face().scene().motion;
  const std::string what = fields.at("what");
  const bool device = what == "device";
  const std::string recording = motion.recording.string();
  if (device && options_.device.empty())
    throw InputError("no camera: start hyperex studio with --device");
  if (!device && recording.empty())
    throw InputError("motion.recording", "the scene has none to play");
  end_live();
  const std::size_t face = fields.at("face");
  LiveSetup setup;
  setup.mesh = face_->session().shared_mesh();
  setup.landmarks = face_->inputs().landmarks;
  setup.method = face_->scene().alignment.method;
  setup.options = face_->options_live(face, live_points());
  setup.face = face;
  setup.source = capture::open_device(device ? options_.device : "play:" + recording);
  if (device ? options_.mirrored : motion.mirrored)
    setup.source = std::make_unique<capture::Mirrored>(std::move(setup.source));
  for (const std::string& note : setup.source->notes()) log("note", note);
  auto live = std::make_unique<Live>(std::move(setup), send_);
  live_face_ = face;
  const std::lock_guard lock(live_mutex_);
  live_ = std::move(live);
  return json::object();
}

json Session::live_stop(const json&) {
  end_live();
  return json::object();
}

json Session::live_neutral(const json&) {
  require_live().set_neutral();
  return json::object();
}

json Session::live_record(const json& fields) {
  require_live().record(fields.at("on"));
  return json::object();
}

json Session::live_drawn(const json& fields) {
  drawn(fields.at("frame"));
  return json::object();
}

json Session::live_take(const json& fields) {
  const motion::Motion take = require_live().take(fields.at("from_s"), fields.at("to_s"));
  // A new name each time, so that undo finds the previous file.
  const fs::path file = options_.folder / fmt::format("take-{}.csv", ++takes_);
  motion::write_motion_csv(file, take);
  std::string text = scene::with_value(now_.text, "motion.file", file.string());
  // These keys belong to the previous motion.
  for (const char* key : {"recording", "arkit", "openface", "candide", "rig", "unit", "mirrored",
                          "rigid_points", "rest_s", "time_scale"})
    text = scene::with_value(text, fmt::format("motion.{}", key), nullptr);
  text = scene::with_value(text, "time.end_s", nullptr);
  // A gap, where the tracker fell behind, is a warning and no reason to lose the take.
  double gap_s = 0;
  for (std::size_t k = 1; k < take.time_s.size(); ++k)
    gap_s = std::max(gap_s, take.time_s[k] - take.time_s[k - 1]);
  if (gap_s >= face_->scene().motion.max_gap_s) {
    text = scene::with_value(text, "motion.max_gap_s", std::ceil(10 * gap_s + 1) / 10);
    log("warning",
        fmt::format(
            "frames of the take were dropped for up to {:.1f} s: the motion between them is "
            "a straight line",
            gap_s));
  }
  commit(text);
  return json::object();
}

}  // namespace hyperex::studio
