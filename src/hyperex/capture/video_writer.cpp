// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video_writer.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "hyperex/capture/video_library.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/temporary.hpp"

namespace hyperex::capture {
namespace fs = std::filesystem;

namespace {

/// Extension of the temporary file. The encoder derives the container from it.
const char* const kExtension = "tmp.mp4";

}  // namespace

struct VideoWriter::Impl {
  Impl(const fs::path& target, int width, int height)
      : file(followed_links(target)),
        temporary(temporary_beside(file, kExtension)),
        width_px(width),
        height_px(height) {}
  ~Impl() {
    encoder.reset();
    std::error_code ignored;
    fs::remove(temporary.path(), ignored);
  }

  fs::path file;
  TemporaryPath temporary;
  std::optional<InUse> in_use;
  std::unique_ptr<VideoEncoder> encoder;
  int width_px, height_px;
  std::size_t pictures = 0;
};

void VideoWriter::check_name(const fs::path& file) {
  if (file.extension() != ".mp4")
    throw InputError(file, "expected the name of a video that ends in .mp4");
  std::error_code ignored;
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
    throw InputError(file, "is no regular file, which a video needs");
  video_library();
}

VideoWriter::VideoWriter(const fs::path& file, int width_px, int height_px,
                         double frames_a_second) {
  check_name(file);
  if (width_px <= 0 || height_px <= 0 || width_px % 2 || height_px % 2)
    throw std::invalid_argument("VideoWriter: width and height must be even");
  if (!(frames_a_second > 0) || !std::isfinite(frames_a_second))
    throw std::invalid_argument("VideoWriter: the rate must be above 0");
  impl_ = std::make_unique<Impl>(file, width_px, height_px);
  // The encoder reports an unwritable file in the same way as a missing codec. This distinguishes
  // them.
  errno = 0;
  if (!std::ofstream(impl_->temporary.path(), std::ios::binary))
    throw InputError(file, std::string("cannot be written (") + std::strerror(errno) + ")");
  impl_->in_use.emplace(impl_->temporary.path());
  impl_->encoder = video_library().create_file(impl_->temporary.path().string(), width_px,
                                               height_px, frames_a_second);
  if (!impl_->encoder)
    throw InputError(file, "no video: FFmpeg has no H.264 encoder (libx264) on this system");
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(const cv::Mat& bgr) {
  if (bgr.type() != CV_8UC3 || bgr.cols != impl_->width_px || bgr.rows != impl_->height_px)
    throw std::invalid_argument("VideoWriter: a picture of another size or kind");
  impl_->encoder->write(bgr);
  ++impl_->pictures;
}

void VideoWriter::finish() {
  impl_->encoder.reset();
  wait_if_interrupted();
  // The encoder does not report a full disk.
  const auto written = video_library().open_file(impl_->temporary.path().string());
  if (!written || std::size_t(written->frame_count()) != impl_->pictures)
    throw InputError(impl_->file, "cannot be written whole (the disk may be full)");
  std::error_code error;
  fs::rename(impl_->temporary.path(), impl_->file, error);
  if (error) throw InputError(impl_->file, "cannot be written (" + error.message() + ")");
}

}  // namespace hyperex::capture
