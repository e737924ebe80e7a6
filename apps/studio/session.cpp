// SPDX-License-Identifier: GPL-3.0-or-later
// Requests and their handlers, and the work between requests.
#include "session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::studio {

Session::Session(SessionOptions options, Send send)
    : options_(std::move(options)), send_(std::move(send)) {}

const std::map<std::string_view, Session::Handler>& Session::handlers() {
  static const std::map<std::string_view, Handler> all = {
      {"hello", &Session::hello},
      {"open", &Session::open},
      {"set", &Session::set},
      {"add_variant", &Session::add_variant},
      {"remove_variant", &Session::remove_variant},
      {"rename_variant", &Session::rename_variant},
      {"paint", &Session::paint},
      {"region_shares", &Session::region_shares},
      {"error_budget", &Session::error_budget},
      {"undo", &Session::undo},
      {"redo", &Session::redo},
      {"move_landmark", &Session::move_landmark},
      {"landmarks_done", &Session::landmarks_done},
      {"live_start", &Session::live_start},
      {"live_stop", &Session::live_stop},
      {"live_neutral", &Session::live_neutral},
      {"live_record", &Session::live_record},
      {"live_drawn", &Session::live_drawn},
      {"live_take", &Session::live_take},
      {"free_name", &Session::free_name},
      {"discard_autosave", &Session::discard_autosave},
      {"ct_bones", &Session::ct_bones},
      {"ct_slice", &Session::ct_slice},
      {"compare_visits", &Session::compare_visits},
      {"save", &Session::save},
  };
  return all;
}

void Session::answer(const Request& request) {
  json out;
  try {
    const auto handler = handlers().find(request.name);
    if (handler == handlers().end()) throw InputError(request.name + ": no such request");
    out = (this->*handler->second)(request.fields);
  } catch (const scene::TornToml& torn) {
    report_progress("");
    out = {{"error", fmt::format("line {}: no sound TOML: {}", torn.line, torn.why)}};
  } catch (const std::exception& error) {
    report_progress("");
    out = {{"error", without_folder(error.what())}};
  }
  if (out.contains("error") && request.name == "open" &&
      request.fields.value("what", "") == "started")
    tell_of_started(out["error"]);
  // These requests may have released faces, which use most of the session's memory.
  constexpr std::string_view kShrink[] = {"open", "undo", "redo", "remove_variant"};
  if (std::find(std::begin(kShrink), std::end(kShrink), request.name) != std::end(kShrink))
    give_back_freed_memory();
  out["answer"] = request.id;
  send_(out.dump(-1, ' ', false, json::error_handler_t::replace), false, "");
  if (request.name != "hello") return;
  if (face_) send_scene();
  if (live_) live_->send_status();
}

void Session::tell_of_started(const std::string& error) const {
  if (!options_.tell) return;
  const std::string name = options_.started.filename().string();
  options_.tell(error.find(name) == std::string::npos ? name + ": " + error : error);
}

OpenFace& Session::require_face() {
  if (!face_) throw InputError("no face is open: open one first");
  return *face_;
}

bool Session::has_work() const {
  // A live face needs the processors itself.
  const bool following = live_ && !live_->ended();
  const bool later = variant_due_ || bands_due_ || budget_due_;
  return face_ && (motion_due_ || (later && !following && face_->session().up_to_date()));
}

void Session::work(const std::function<bool()>& cancelled) {
  if (motion_due_) return run_motion(cancelled);
  if (variant_due_) return expect_variant();
  if (bands_due_) return find_bands(cancelled);
  find_budget(cancelled);
}

void Session::run_motion(const std::function<bool()>& cancelled) {
  Stopwatch watch;
  simulate::RunCallbacks callbacks;
  callbacks.cancelled = cancelled;
  callbacks.progress = [&](double share) { report_progress("simulating", share); };
  try {
    face_->run(callbacks);
    motion_due_ = false;
    bands_due_ = options_.bands && !face_->session().certainty_known();
    send_motion(watch);
  } catch (const simulate::Cancelled&) {
    return;
  } catch (const std::exception& error) {
    motion_due_ = false;
    log("error", without_folder(error.what()));
  }
  report_progress("");
}

/// Not cancelled by a request, which most likely needs the result.
void Session::expect_variant() {
  variant_due_ = false;
  try {
    face_->session().prepare_variant();
  } catch (const std::exception&) {
    // The request that adds a variant reports the error.
  }
}

/// Reports no progress, since the user does not wait for it.
void Session::find_bands(const std::function<bool()>& cancelled) {
  Stopwatch watch;
  try {
    face_->session().find_certainty(cancelled);
    bands_due_ = false;
    send_motion(watch);
  } catch (const simulate::Cancelled&) {
  } catch (const std::exception& error) {
    bands_due_ = false;
    log("warning", fmt::format("no error bands: {}", without_folder(error.what())));
  }
}

json Session::error_budget(const json&) {
  require_face();
  budget_due_ = true;
  return json::object();
}

/// Starts anew after a request that did not change the scene.
void Session::find_budget(const std::function<bool()>& cancelled) {
  const auto progress = [&](double share) { report_progress("finding the error budget", share); };
  try {
    progress(0);
    face_->session().find_certainty(cancelled);
    send_budget(
        uncertainty::face_budget(face_->session(), {.progress = progress, .cancelled = cancelled}));
    budget_due_ = false;
  } catch (const simulate::Cancelled&) {
    return;
  } catch (const std::exception& error) {
    budget_due_ = false;
    log("error", fmt::format("no error budget: {}", without_folder(error.what())));
  }
  report_progress("");
}

}  // namespace hyperex::studio
