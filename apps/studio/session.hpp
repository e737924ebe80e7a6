// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/landmarks.hpp"
#include "live.hpp"
#include "open_face.hpp"
#include "protocol.hpp"

namespace hyperex::studio {

struct SessionOptions {
  std::filesystem::path started;    ///< the scene or scan that the command named; empty: none
  std::filesystem::path save_into;  ///< the folder that "save" writes to
  std::filesystem::path folder;     ///< the session's own: uploads, what is kept against a crash
  std::filesystem::path rescued;    ///< the folder of a session that died, its scene.toml in it
  std::string program;              ///< "hyperex 1.0.0"
  std::string device;               ///< a camera (capture::open_device); empty: none
  bool mirrored = false;            ///< its pictures are a mirror's
  bool bands = true;                ///< error bands are found when nothing else is to do
  KeptResults kept;
};

/// What one user does: a scene's text, its history, and the face that is open. Answers requests in
/// the order they come, on one thread; messages go out through `send`.
class Session {
 public:
  using Send = std::function<void(std::string message, bool binary, const std::string& replaces)>;
  Session(SessionOptions options, Send send);

  /// Answers; errors are answers too.
  void answer(const Request& request);
  /// Whether files of the user hold all that was done.
  bool saved() const { return saved_; }
  /// Whether the folder that was rescued holds what no file of the user holds.
  bool keeps_rescued() const { return keeps_rescued_; }
  /// A shape of the live face was drawn: from any thread.
  void drawn(std::int64_t frame);
  /// Something to do when no request waits: a motion that is not up to date.
  bool has_work() const;
  /// Does it; ended early where `cancelled` says so, to be begun again.
  void work(const std::function<bool()>& cancelled);

 private:
  struct Step {
    std::string text;
    std::filesystem::path file;
  };
  nlohmann::json hello();
  nlohmann::json open(const nlohmann::json& fields);
  nlohmann::json set(const nlohmann::json& fields);
  nlohmann::json add_variant(const nlohmann::json& fields);
  nlohmann::json remove_variant(const nlohmann::json& fields);
  nlohmann::json rename_variant(const nlohmann::json& fields);
  nlohmann::json paint(const nlohmann::json& fields);
  nlohmann::json region_shares(const nlohmann::json& fields);
  nlohmann::json undo_or_redo(std::vector<Step>& from, std::vector<Step>& to);
  nlohmann::json move_landmark(const nlohmann::json& fields);
  nlohmann::json landmarks_done();
  nlohmann::json free_name(const nlohmann::json& fields);
  nlohmann::json discard_autosave();
  nlohmann::json save(const nlohmann::json& fields);
  /// A name for a file or folder in the folder that the studio writes to; throws InputError.
  static void check_save_name(const std::string& name);
  /// Something of the user's, which is never replaced.
  bool is_anothers(const std::filesystem::path& path) const;
  nlohmann::json live_start(const nlohmann::json& fields);
  nlohmann::json live_take(const nlohmann::json& fields);
  Live& need_live();
  void end_live();
  /// What the live face is made of follows the scene.
  void refresh_live();

  OpenFace& need_face();
  /// Every path that the scene or a variant of it names.
  std::vector<std::string> known_paths() const;
  /// Reads and meshes, and says what is probably wrong; the face that is open goes only then.
  void make_face(const std::string& text, const std::filesystem::path& file);
  std::filesystem::path uploads() const { return options_.folder / "uploads"; }
  /// The smile that the program carries, beside the session's scene.
  void write_smile() const;
  void open_text(const std::string& text, const std::filesystem::path& file);
  /// The text becomes the scene; one step of the history.
  void commit(const std::string& text);
  void apply(const std::string& text);
  /// The scene's text with the changes of a face.
  std::string changed(const nlohmann::json& wanted, int face);
  std::string scan_scene(const std::filesystem::path& scan, const std::filesystem::path& recording);
  void send_scene();
  void send_shape(std::size_t face, double time_s);
  void expect_variant();
  void find_bands(const std::function<bool()>& cancelled);
  void send_motion(Stopwatch& watch);
  void tell(const std::string& stage, double share = -1);
  void say(const char* level, const std::string& text);
  void keep();

  SessionOptions options_;
  Send send_;
  std::unique_ptr<OpenFace> face_;
  Step now_;  // what was committed last; the face may be ahead of it while a slider is dragged
  std::vector<Step> undo_, redo_;
  bool face_sent_ = false, motion_due_ = false, variant_due_ = false, bands_due_ = false,
       saved_ = true, keeps_rescued_ = true;
  std::vector<std::filesystem::path> written_;
  std::optional<SurfaceTree> scan_;  ///< of the face that is open, once a landmark was moved
  io::Landmarks moved_;              ///< since the last landmarks_done()
  int landmark_files_ = 0, takes_ = 0;
  mutable std::mutex live_mutex_;  // of the pointer: drawn() comes from another thread
  std::unique_ptr<Live> live_;
  std::size_t live_face_ = 0;
};

}  // namespace hyperex::studio
