// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "hyperex/capture/source.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::capture::test {

inline constexpr int width_px = 64, height_px = 48;

using Folder = TestFolder;
using hyperex::test::refusal;

void write_text(const std::filesystem::path& file, const std::string& text);
/// Cuts the file to the first `share` of its bytes.
void tear(const std::filesystem::path& file, double share);

/// Blue = column, green = row, red = 10 frame. The picture is smooth, so that JPEG changes it only
/// by a few grey levels.
cv::Mat colour_picture(int frame, int width = width_px, int height = height_px);
/// 1000 mm + 10 frame + column, with no reading in the first row.
cv::Mat depth_picture_mm(int frame, int width = width_px, int height = height_px);

/// Writes a valid recording of `frames` frames at 10 Hz in TUM's layout, JPEG and 16-bit PNG at
/// 1000 per metre, with all three lists. Names are rgb/0.jpg, depth/0.png, rgb/1.jpg and so on.
void write_recording(const std::filesystem::path& folder, int frames);

/// Reads all frames to the end.
std::vector<Frame> read_all(FrameSource& source);

}  // namespace hyperex::capture::test
