// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

enum class SourceKind { folder, oni, still, video, kinect, openni, webcam, played };

/// The kind of source that `spec` names (as in open_source). Nothing is opened. Throws InputError
/// as open_source does.
SourceKind source_kind(const std::string& spec);

/// Opens the source that `spec`, a text given by the user, names:
///   a folder             a recording in TUM's layout (tum_folder.hpp)
///   a file *.oni         a recording by OpenNI2 (openni.hpp)
///   *.jpg, *.jpeg, *.png a photograph: one frame (still.hpp)
///   any other file       a video (video.hpp)
///   kinect               the first Kinect (kinect.hpp)
///   openni, openni:URI   a camera through OpenNI2 (openni.hpp)
///   webcam, webcam:N     /dev/videoN, 0 where no number is given (video.hpp)
///   play:RECORDING       a recording played at its own pace, as if it were a camera (played.hpp)
/// An existing file or folder takes precedence over a device of the same name. Live sources are
/// wrapped in LatestFrame: a slow consumer loses frames, counted by dropped(), but does not fall
/// behind. For any other text, throws InputError with this list.
std::unique_ptr<FrameSource> open_source(const std::string& spec,
                                         const SourceOptions& options = {});

/// Opens a device by one of the device names above, even if a file of that name exists. Throws
/// InputError for any other text.
std::unique_ptr<FrameSource> open_device(const std::string& spec,
                                         const SourceOptions& options = {});

}  // namespace hyperex::capture
