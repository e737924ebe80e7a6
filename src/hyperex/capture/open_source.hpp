// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

enum class SourceKind { folder, oni, still, video, kinect, openni, webcam, played };

/// The kind of source that a user's text (as for open_source) names; nothing is opened. Throws
/// InputError as open_source does.
SourceKind source_kind(const std::string& spec);

/// A source by what a user writes:
///   a folder             a recording in TUM's layout (tum_folder.hpp)
///   a file *.oni         a recording by OpenNI2 (openni.hpp)
///   *.jpg, *.jpeg, *.png a photograph: one frame (still.hpp)
///   any other file       a video (video.hpp)
///   kinect               the first Kinect (kinect.hpp)
///   openni, openni:URI   a camera through OpenNI2 (openni.hpp)
///   webcam, webcam:N     /dev/videoN, 0 where no number is given (video.hpp)
///   play:RECORDING       a recording played at its own pace, as if it were a camera (played.hpp)
/// What exists on disk goes before a word for a device. Live sources come wrapped in LatestFrame:
/// a slow consumer loses frames, counted by dropped(), and does not fall behind.
/// Throws InputError for anything else, naming these.
std::unique_ptr<FrameSource> open_source(const std::string& spec,
                                         const SourceOptions& options = {});

/// One of the words for devices above, whatever stands on disk. Throws InputError for any other.
std::unique_ptr<FrameSource> open_device(const std::string& spec,
                                         const SourceOptions& options = {});

}  // namespace hyperex::capture
