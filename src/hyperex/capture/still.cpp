// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/still.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/decode.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

class Still : public FrameSource {
 public:
  Still(const fs::path& file, const SourceOptions& options) {
    const std::string bytes = read_file(file);
    Decoded decoded =
        decode_colour(std::span(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()),
                      file.string());
    if (!decoded.fault.empty()) throw InputError(decoded.fault);
    picture_ = std::move(decoded.picture);
    intrinsics_ = intrinsics_of(file.string(), picture_.cols, picture_.rows, options, notes_);
  }

  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return false; }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return 1; }
  std::vector<std::string> notes() const override { return notes_; }

  std::optional<Frame> next() override {
    if (picture_.empty()) return std::nullopt;
    Frame frame;
    frame.colour = std::exchange(picture_, cv::Mat());
    return frame;
  }

 private:
  cv::Mat picture_;
  Intrinsics intrinsics_;
  std::vector<std::string> notes_;
};

}  // namespace

bool is_picture(const fs::path& file) {
  const std::string extension = ending_of(file);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

std::unique_ptr<FrameSource> open_still(const fs::path& file, const SourceOptions& options) {
  return std::make_unique<Still>(file, options);
}

}  // namespace hyperex::capture
