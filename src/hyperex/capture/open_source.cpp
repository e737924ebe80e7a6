// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/open_source.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "hyperex/capture/buffered.hpp"
#include "hyperex/capture/kinect.hpp"
#include "hyperex/capture/openni.hpp"
#include "hyperex/capture/played.hpp"
#include "hyperex/capture/still.hpp"
#include "hyperex/capture/tum_folder.hpp"
#include "hyperex/capture/video.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

std::unique_ptr<FrameSource> latest(std::unique_ptr<FrameSource> source) {
  return std::make_unique<LatestFrame>(std::move(source));
}

bool is_mesh(const fs::path& file) {
  static constexpr std::array meshes{".ply", ".obj", ".stl", ".glb", ".gltf"};
  return std::ranges::find(meshes, ending_of(file)) != meshes.end();
}

int webcam_number(const std::string& spec) {
  if (spec == "webcam") return 0;
  const auto number = io::parse_integer(std::string_view(spec).substr(7));
  if (!number || *number < 0 || *number > 255)
    throw InputError(io::quotable(spec) + ": expected webcam:N with N from 0 to 255");
  return static_cast<int>(*number);
}

/// The kind of device that `spec` names; nothing if it names none.
std::optional<SourceKind> device_kind(const std::string& spec) {
  if (spec == "kinect") return SourceKind::kinect;
  if (spec == "openni" || spec.starts_with("openni:")) return SourceKind::openni;
  if (spec == "webcam" || spec.starts_with("webcam:")) return SourceKind::webcam;
  if (spec.starts_with("play:")) return SourceKind::played;
  return std::nullopt;
}

std::unique_ptr<FrameSource> open(SourceKind kind, const std::string& spec,
                                  const SourceOptions& options);

std::unique_ptr<FrameSource> open_played(const std::string& recording,
                                         const SourceOptions& options) {
  const SourceKind kind = source_kind(recording);
  if (kind != SourceKind::folder && kind != SourceKind::oni && kind != SourceKind::video)
    throw InputError("play:" + io::quotable(recording) +
                     ": expected a recording (folder, video file, .oni)");
  return play(open(kind, recording, options));
}

std::unique_ptr<FrameSource> open(SourceKind kind, const std::string& spec,
                                  const SourceOptions& options) {
  switch (kind) {
    case SourceKind::folder:
      return open_tum_folder(spec, options);
    case SourceKind::oni:
      return open_oni(spec, options);
    case SourceKind::still:
      return open_still(spec, options);
    case SourceKind::video:
      return open_video(spec, options);
    case SourceKind::kinect:
      return latest(open_kinect(options));
    case SourceKind::openni:
      return latest(open_openni(spec == "openni" ? "" : spec.substr(7), options));
    case SourceKind::webcam:
      return latest(open_webcam(webcam_number(spec), options));
    case SourceKind::played:
      break;
  }
  return latest(open_played(spec.substr(5), options));
}

}  // namespace

SourceKind source_kind(const std::string& spec) {
  std::error_code ignored;
  if (spec.empty())
    throw InputError(
        "no recording is named: expected a recording (folder, video file, .oni, photograph) or a "
        "camera (kinect, openni, webcam:N)");
  if (fs::is_directory(spec, ignored)) return SourceKind::folder;
  if (fs::exists(spec, ignored)) {
    if (fs::is_character_file(spec, ignored) || fs::is_block_file(spec, ignored))
      throw InputError(spec,
                       "is a device; expected a recording, or a camera by its word, as webcam:0");
    if (is_mesh(spec))
      throw InputError(spec, "is a mesh, not a recording: hyperex landmarks finds landmarks on it");
    return ending_of(spec) == ".oni" ? SourceKind::oni
           : is_picture(spec)        ? SourceKind::still
                                     : SourceKind::video;
  }
  if (const auto kind = device_kind(spec)) return *kind;
  throw InputError(
      io::quotable(spec) +
      ": no such folder or file; expected a recording (folder, video file, .oni, photograph) or a "
      "camera (kinect, openni, webcam:N)");
}

std::unique_ptr<FrameSource> open_source(const std::string& spec, const SourceOptions& options) {
  return open(source_kind(spec), spec, options);
}

std::unique_ptr<FrameSource> open_device(const std::string& spec, const SourceOptions& options) {
  if (const auto kind = device_kind(spec)) return open(*kind, spec, options);
  throw InputError(io::quotable(spec) +
                   ": no such device; expected kinect, openni, openni:URI, webcam:N or "
                   "play:RECORDING");
}

}  // namespace hyperex::capture
