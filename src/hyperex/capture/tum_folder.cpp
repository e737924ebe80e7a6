// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/tum_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hyperex/capture/buffered.hpp"
#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/decode.hpp"
#include "hyperex/capture/faults.hpp"
#include "hyperex/capture/tum_lists.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/named_file.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

/// For a folder that is not a recording itself: which of its subfolders are recordings, as "; it
/// holds one: PATH", or "; it holds 3 recordings, name one of them: NAME, NAME or NAME". Empty if
/// there are none.
std::string recordings_inside(const fs::path& folder) {
  constexpr std::size_t most = 5;
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (fs::exists(entry.path() / "rgb.txt", ignored)) found.push_back(entry.path());
  if (found.empty()) return "";
  std::sort(found.begin(), found.end());
  if (found.size() == 1) return "; it holds one: " + found.front().string();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    names.push_back(found[i].filename().string());
  std::string last = "...";
  if (found.size() <= most) {
    last = "or " + names.back();
    names.pop_back();
  }
  return fmt::format("; it holds {} recordings, name one of them: {} {}", found.size(),
                     fmt::join(names, ", "), last);
}

class TumFolder : public FrameSource {
 public:
  TumFolder(fs::path folder, const SourceOptions& options)
      : folder_(std::move(folder)), faults_(folder_.string()) {
    if (!fs::is_directory(folder_)) throw InputError(folder_, "no such folder");
    read_camera(options);
    read_lists(options);
    if (frames_.empty()) throw InputError(folder_, "its lists name no picture");
    mark_times_going_back(frames_);
  }

  const Intrinsics& intrinsics() const override { return camera_.intrinsics; }
  bool has_depth() const override { return has_depth_; }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return frames_.size(); }
  std::vector<std::string> notes() const override { return notes_; }

  std::optional<Frame> next() override {
    if (next_ == frames_.size()) {
      faults_.check_at_end();
      return std::nullopt;
    }
    Frame frame = read(frames_[next_], next_);
    ++next_;
    faults_.add(frame);
    return frame;
  }

 private:
  void read_camera(const SourceOptions& options) {
    const fs::path file =
        options.camera_file.empty() ? folder_ / "camera.toml" : options.camera_file;
    if (!fs::exists(file) && !fs::exists(folder_ / "rgb.txt") &&
        !fs::exists(folder_ / "associations.txt")) {
      throw InputError(folder_,
                       "is no recording: expected rgb/, depth/, rgb.txt, depth.txt and camera.toml "
                       "(docs/tracking.md)" +
                           recordings_inside(folder_));
    }
    if (!fs::exists(file))
      throw InputError(file,
                       "missing: expected the camera's width, height, fx, fy, cx, cy (pixels) and "
                       "depth_scale (stored value per metre)");
    std::error_code ignored;
    if (fs::is_fifo(file, ignored)) throw InputError(file, "is a pipe; expected the camera's file");
    camera_ = read_camera_file(file);
    notes_ = camera_.notes;
  }

  void read_lists(const SourceOptions& options) {
    const fs::path pairs = folder_ / "associations.txt", colour = folder_ / "rgb.txt",
                   depth = folder_ / "depth.txt";
    const bool has_pairs = fs::exists(pairs), has_colour = fs::exists(colour);
    if (!has_pairs && !has_colour)
      throw InputError(folder_,
                       "holds neither rgb.txt nor associations.txt: expected the TUM "
                       "layout (rgb/, depth/, rgb.txt, depth.txt)");
    has_depth_ = !options.colour_only && (has_pairs || fs::exists(depth));
    if (has_pairs && (has_depth_ || !has_colour)) {
      frames_ = read_associations(pairs);
      if (has_colour && has_depth_) add_unpaired(read_picture_list(colour), frames_);
    } else if (has_depth_) {
      frames_ = associate(read_picture_list(colour), read_picture_list(depth));
      notes_.push_back(folder_.string() +
                       ": no associations.txt, so colour and depth are paired by nearest time");
    } else {
      for (ListedPicture& picture : read_picture_list(colour))
        frames_.push_back({picture.time_s, std::move(picture.file), {}, {}});
      if (!options.colour_only)
        notes_.push_back(folder_.string() + ": no depth.txt, so colour only");
    }
  }

  Frame read(const ListedFrame& listed, std::size_t index) const {
    Frame frame;
    frame.index = index;
    frame.time_s = listed.time_s;
    frame.fault = listed.fault;
    const auto take = [&](const std::string& name, const auto& decode, cv::Mat& into) {
      Decoded decoded;
      try {
        decoded = decode(named_file(folder_, name));
      } catch (const InputError& error) {
        decoded.fault = error.what();
      }
      into = std::move(decoded.picture);
      if (frame.fault.empty()) frame.fault = std::move(decoded.fault);
    };
    take(
        listed.colour,
        [&](const fs::path& file) { return decode_colour(file, camera_.intrinsics); },
        frame.colour);
    if (has_depth_ && !listed.depth.empty())
      take(
          listed.depth,
          [&](const fs::path& file) {
            return decode_depth(file, camera_.intrinsics, camera_.depth_per_metre);
          },
          frame.depth_m);
    frame.valid = frame.fault.empty();
    return frame;
  }

  fs::path folder_;
  Camera camera_;
  std::vector<ListedFrame> frames_;
  std::vector<std::string> notes_;
  FaultCount faults_;
  std::size_t next_ = 0;
  bool has_depth_ = false;
};

}  // namespace

std::unique_ptr<FrameSource> open_tum_folder(const fs::path& folder, const SourceOptions& options) {
  auto source = std::make_unique<TumFolder>(folder, options);
  if (options.read_ahead_frames == 0) return source;
  return read_ahead(std::move(source), options.read_ahead_frames);
}

}  // namespace hyperex::capture
