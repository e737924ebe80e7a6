// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording.hpp"

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "hyperex/core/error.hpp"

namespace hyperex::capture::test {
namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void tear(const fs::path& file, double share) {
  fs::resize_file(file,
                  static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(file))));
}

cv::Mat colour_picture(int frame, int width, int height) {
  cv::Mat picture(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(255 * x / width),
                                              cv::saturate_cast<uchar>(255 * y / height),
                                              cv::saturate_cast<uchar>(10 * frame));
  return picture;
}

cv::Mat depth_picture_mm(int frame, int width, int height) {
  cv::Mat picture(height, width, CV_16UC1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at<ushort>(y, x) = static_cast<ushort>(y == 0 ? 0 : 1000 + 10 * frame + x);
  return picture;
}

void write_recording(const fs::path& folder, int frames) {
  fs::create_directories(folder / "rgb");
  fs::create_directories(folder / "depth");
  std::ostringstream rgb, depth, pairs;
  rgb << "# time file\n";
  for (int i = 0; i < frames; ++i) {
    const std::string name = std::to_string(i), colour_file = "rgb/" + name + ".jpg",
                      depth_file = "depth/" + name + ".png";
    cv::imwrite((folder / colour_file).string(), colour_picture(i), {cv::IMWRITE_JPEG_QUALITY, 95});
    cv::imwrite((folder / depth_file).string(), depth_picture_mm(i));
    const double time_s = 0.1 * i;
    rgb << time_s << " " << colour_file << "\n";
    depth << time_s << " " << depth_file << "\n";
    pairs << time_s << " " << colour_file << " " << time_s << " " << depth_file << "\n";
  }
  write_text(folder / "rgb.txt", rgb.str());
  write_text(folder / "depth.txt", depth.str());
  write_text(folder / "associations.txt", pairs.str());
  write_text(folder / "camera.toml",
             "width = 64\nheight = 48\nfx = 60.0\nfy = 61\ncx = 31.5\ncy = 23.5\n"
             "depth_scale = 1000.0\nfps = 10\n");
}

std::vector<Frame> read_all(FrameSource& source) {
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(std::move(*frame));
  return frames;
}

}  // namespace hyperex::capture::test
