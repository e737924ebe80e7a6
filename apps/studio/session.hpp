// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/ct/ct_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/uncertainty/face_budget.hpp"
#include "live.hpp"
#include "open_ct.hpp"
#include "open_face.hpp"
#include "protocol.hpp"

namespace hyperex::studio {

using nlohmann::json;
namespace fs = std::filesystem;

struct SessionOptions {
  std::filesystem::path started;    ///< the scene or scan named on the command line; empty: none
  std::filesystem::path save_into;  ///< the folder that "save" writes to
  std::filesystem::path folder;     ///< the session's own: uploads and the autosaved scene
  std::filesystem::path rescued;    ///< the folder of a session that crashed, with its scene.toml
  std::string program;              ///< "hyperex 1.0.0"
  std::string device;               ///< a camera (capture::open_device); empty: none
  bool mirrored = false;            ///< the camera's pictures are mirrored
  bool bands = true;                ///< error bands are computed while the session is idle
  KeptResults kept;
  std::function<bool()> ending = {};  ///< the studio is ending: abandon a run that is being saved
  /// Says in the terminal why `started` cannot be opened, as the page does; empty: nowhere else.
  std::function<void(const std::string&)> tell = {};
};

/// One user's work: the scene's text, its history and the open face. Requests are answered in order
/// on one thread; messages are sent through `send`.
class Session {
 public:
  using Send = std::function<void(std::string message, bool binary, const std::string& replaces)>;
  /// Handles one request: its fields in, the fields of its answer out. Errors are exceptions.
  using Handler = nlohmann::json (Session::*)(const nlohmann::json& fields);

  Session(SessionOptions options, Send send);

  /// The handler of each request of protocol.json, by name.
  static const std::map<std::string_view, Handler>& handlers();
  /// Sends the answer to a request; an error is sent as an answer too. One of the file that the
  /// command line names goes to SessionOptions::tell, too.
  void answer(const Request& request);
  /// Whether all changes are saved in the user's own files.
  bool saved() const { return saved_; }
  /// Whether the rescued folder contains work that is in no file of the user.
  bool keeps_rescued() const { return keeps_rescued_; }
  /// The page has drawn a frame of the live face. May be called from any thread.
  void drawn(std::int64_t frame);
  /// Whether there is work to do while no request waits: a motion, a variant's forces, bands or the
  /// error budget.
  bool has_work() const;
  /// Does the next piece of it. Stops early where `cancelled` returns true; it then starts anew.
  void work(const std::function<bool()>& cancelled);

 private:
  struct Step {
    std::string text;
    std::filesystem::path file;
  };
  /// The variants of the opened scene that cannot be run. They are in no Step, and in saved scenes.
  struct LeftOut {
    std::string with, without;  ///< the scene's text as it was opened, and without them
    std::string variants;       ///< their texts; empty: none
    std::vector<Note> notes;    ///< a warning for each
  };
  // Handlers, in the order of protocol.json.
  nlohmann::json hello(const nlohmann::json& fields);
  nlohmann::json open(const nlohmann::json& fields);
  nlohmann::json set(const nlohmann::json& fields);
  nlohmann::json add_variant(const nlohmann::json& fields);
  nlohmann::json remove_variant(const nlohmann::json& fields);
  nlohmann::json rename_variant(const nlohmann::json& fields);
  nlohmann::json paint(const nlohmann::json& fields);
  nlohmann::json region_shares(const nlohmann::json& fields);
  nlohmann::json error_budget(const nlohmann::json& fields);
  nlohmann::json undo(const nlohmann::json& fields);
  nlohmann::json redo(const nlohmann::json& fields);
  nlohmann::json move_landmark(const nlohmann::json& fields);
  nlohmann::json landmarks_done(const nlohmann::json& fields);
  nlohmann::json live_start(const nlohmann::json& fields);
  nlohmann::json live_stop(const nlohmann::json& fields);
  nlohmann::json live_neutral(const nlohmann::json& fields);
  nlohmann::json live_record(const nlohmann::json& fields);
  nlohmann::json live_drawn(const nlohmann::json& fields);
  nlohmann::json live_take(const nlohmann::json& fields);
  nlohmann::json free_name(const nlohmann::json& fields);
  nlohmann::json discard_autosave(const nlohmann::json& fields);
  nlohmann::json ct_bones(const nlohmann::json& fields);
  nlohmann::json ct_slice(const nlohmann::json& fields);
  nlohmann::json compare_visits(const nlohmann::json& fields);
  nlohmann::json save(const nlohmann::json& fields);

  /// The open face. Throws InputError where there is none.
  OpenFace& require_face();
  /// The live face. Throws InputError where there is none.
  Live& require_live();

  // Opening (session_open.cpp).
  void open_text(const std::string& text, const std::filesystem::path& file);
  /// Reads and meshes a face and reports its warnings. Replaces the open face only if that
  /// succeeds. `left_out`: as OpenFace has it.
  void make_face(const std::string& text, const std::filesystem::path& file,
                 std::vector<scene::LeftOutVariant>* left_out = nullptr);
  /// A scene of a scan, moved by a recording, or by the built-in smile where there is none.
  std::string scan_scene(const std::filesystem::path& scan, const std::filesystem::path& recording);
  /// Writes the built-in smile beside the session's scene.
  void write_smile() const;
  /// Whether to offer the work of a crashed session.
  bool offers_rescued() const;
  std::filesystem::path uploads() const { return options_.folder / "uploads"; }

  // Variants that cannot be run (session_left_out.cpp).
  /// Whether the variants are written as [[variant]], so that their texts can be kept apart.
  static bool has_tables_of_variants(const std::string& text);
  /// Those of the open face, of which `text` is the whole scene.
  LeftOut left_out_of(const std::string& text,
                      const std::vector<scene::LeftOutVariant>& variants) const;
  /// The scene's text as it is saved: with the variants that were left out.
  std::string text_to_save() const;
  /// Says whether what was saved has them: the scene has, a run and its report have not.
  void report_left_out(bool of_scene);

  // A CT (session_ct.cpp).
  /// Whether an upload is opened as a CT.
  static bool is_ct(const std::filesystem::path& file);
  /// Opens the CT's skin on its own bones.
  void open_ct(const std::filesystem::path& file, const std::filesystem::path& recording);
  /// Writes what was found in a CT into a new folder and reports its notes.
  std::filesystem::path write_bones(const ct::CtFace& face);
  /// Throws InputError where the open face is not of a CT that was opened in this session.
  OpenCt& require_ct();
  /// The pictures of the CT of the open face; none where it has no CT.
  void send_ct_pictures();

  // Two recordings (session_visits.cpp).
  /// The name of the recording before the present one; empty where there is none.
  std::string earlier_recording() const;

  // Changes and their history (session_edits.cpp).
  /// Every path that the scene or one of its variants names.
  std::vector<std::string> known_paths() const;
  /// The scene's text with changed keys of a face.
  std::string text_with_changes(const nlohmann::json& changes, int face);
  /// The scene's text with another name of a variant.
  std::string text_with_name(const std::string& text, std::size_t face,
                             const std::string& name) const;
  void apply(const std::string& text);
  /// Makes the text the scene and adds one step to the history.
  void commit(const std::string& text);
  void step_history(std::vector<Step>& from, std::vector<Step>& to);

  // Files (session_files.cpp).
  /// Throws InputError for a name that no file in the user's folder may have.
  static void check_save_name(const std::string& name);
  /// Whether a file is there that this session did not write. Such a file is never replaced.
  bool is_foreign(const std::filesystem::path& path) const;
  std::filesystem::path save_scene_file(const std::string& name);
  /// Runs the scene. All results go into a folder, or only the report into a file.
  std::filesystem::path save_run(const std::filesystem::path& folder);
  std::filesystem::path save_report(const std::filesystem::path& file);
  /// Returns `path`. Throws InputError where it is foreign.
  std::filesystem::path require_own(const std::filesystem::path& path) const;
  void autosave();

  // Live (session_live.cpp).
  void end_live();
  /// Gives the live face the scene's present tissue and drive.
  void refresh_live();

  // Background work (session.cpp).
  void run_motion(const std::function<bool()>& cancelled);
  void tell_of_started(const std::string& error) const;
  void expect_variant();
  void find_bands(const std::function<bool()>& cancelled);
  void find_budget(const std::function<bool()>& cancelled);

  // Events (session_events.cpp).
  void send_scene();
  void send_shape(std::size_t face, double time_s);
  void send_motion(Stopwatch& watch);
  void send_budget(const uncertainty::FaceBudget& budget);
  /// An empty stage means done; a negative share means unknown.
  void report_progress(const std::string& stage, double share = -1);
  void log(const char* level, const std::string& text);
  /// Removes the paths of the session's own folders, which mean nothing to the user.
  std::string without_folder(std::string text) const;

  SessionOptions options_;
  Send send_;
  std::unique_ptr<OpenFace> face_;
  Step now_;  ///< the last commit; face_ may be newer while a slider is dragged
  std::vector<Step> undo_, redo_;
  LeftOut left_out_;
  std::optional<Step> earlier_;  ///< of the same face, with the recording before the present one
  bool face_sent_ = false, motion_due_ = false, variant_due_ = false, bands_due_ = false,
       budget_due_ = false, saved_ = true, keeps_rescued_ = true;
  std::vector<std::filesystem::path> written_;
  std::unique_ptr<OpenCt> ct_;       ///< of the open face, if it was opened from its CT
  std::optional<SurfaceTree> scan_;  ///< of the open face; built when a landmark is first moved
  io::Landmarks moved_;              ///< since the last landmarks_done()
  int landmark_files_ = 0, takes_ = 0;
  mutable std::mutex live_mutex_;  ///< guards the pointer: drawn() runs on another thread
  std::unique_ptr<Live> live_;
  std::size_t live_face_ = 0;
};

}  // namespace hyperex::studio
