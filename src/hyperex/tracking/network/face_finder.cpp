// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/face_finder.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "hyperex/tracking/network/model_bytes.hpp"
#include "hyperex/tracking/network/tflite_network.hpp"

namespace hyperex::tracking {
namespace {

constexpr int numbers_a_box = 16;  // x, y, width, height, six points

/// Centres of the detector's 896 boxes in its square, 0 to 1: two per cell of a 16 x 16 grid, then
/// six per cell of an 8 x 8 grid (SSD anchors of fixed size).
std::vector<cv::Point2d> anchors() {
  std::vector<cv::Point2d> centres;
  for (const auto& [cells, boxes] : {std::pair{16, 2}, std::pair{8, 6}})
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        centres.insert(centres.end(), std::size_t(boxes), {(x + 0.5) / cells, (y + 0.5) / cells});
  return centres;
}

double overlap(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double common = (a & b).area();
  return common > 0 ? common / (a.area() + b.area() - common) : 0;
}

/// Merges the boxes of one face to their mean, weighted by score (BlazeFace, section 3.4: less
/// jitter than keeping only the best box).
void join_same_faces(std::vector<FoundFace>& boxes, double least_overlap,
                     std::vector<FoundFace>& faces) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const FoundFace& a, const FoundFace& b) { return a.score > b.score; });
  faces.clear();
  while (!boxes.empty()) {
    const FoundFace best = boxes.front();
    FoundFace mean;
    mean.score = best.score;
    double sum = 0;
    std::erase_if(boxes, [&](const FoundFace& box) {
      if (&box != boxes.data() && overlap(best.box, box.box) <= least_overlap) return false;
      sum += box.score;
      mean.box.x += box.score * box.box.x, mean.box.y += box.score * box.box.y;
      mean.box.width += box.score * box.box.width, mean.box.height += box.score * box.box.height;
      for (std::size_t k = 0; k < mean.points.size(); ++k)
        mean.points[k] += box.score * box.points[k];
      return true;
    });
    mean.box.x /= sum, mean.box.y /= sum, mean.box.width /= sum, mean.box.height /= sum;
    for (auto& p : mean.points) p *= 1 / sum;
    faces.push_back(mean);
  }
}

}  // namespace

FaceRegion FoundFace::region() const {
  const cv::Point2d along = points[1] - points[0];
  return {box.x + box.width / 2, box.y + box.height / 2, 1.5 * std::max(box.width, box.height),
          std::atan2(along.y, along.x)};
}

struct FaceFinder::Impl {
  FaceFinderOptions options;
  Network network = read_tflite(face_detection_bytes(), "face_detection_short_range.tflite");
  std::vector<cv::Point2d> centres = anchors();
  cv::Mat scratch, patch, input;
  std::vector<cv::Mat> outputs;
  std::vector<FoundFace> boxes, faces;

  /// Adds the faces that the network finds in one square of the picture.
  void look_at(const cv::Mat& bgr, const FaceRegion& square) {
    cut_out(bgr, square, network.width_px, true, scratch, patch);
    cv::dnn::blobFromImage(patch, input, 1 / 127.5, {}, cv::Scalar::all(127.5), true);
    network.net.setInput(input);
    network.net.forward(outputs, network.outputs);
    const bool boxes_first = outputs[0].total() > outputs[1].total();
    const float* numbers = outputs[boxes_first ? 0 : 1].ptr<float>();
    const float* scores = outputs[boxes_first ? 1 : 0].ptr<float>();
    for (std::size_t i = 0; i < centres.size(); ++i) {
      FoundFace face;
      face.score = 1 / (1 + std::exp(-double(scores[i])));
      if (face.score < options.least_score) continue;
      const float* n = numbers + i * numbers_a_box;
      const auto place = [&](int k) {  // offsets are in pixels of the network's input
        return square.picture_from_square(centres[i].x + n[k] / network.width_px,
                                          centres[i].y + n[k + 1] / network.height_px);
      };
      const cv::Point2d middle = place(0);
      const double scale = square.side_px / network.width_px;
      face.box = {middle.x - n[2] * scale / 2, middle.y - n[3] * scale / 2, n[2] * scale,
                  n[3] * scale};
      for (int k = 0; k < int(face.points.size()); ++k)
        face.points[std::size_t(k)] = place(4 + 2 * k);
      boxes.push_back(face);
    }
  }

  const std::vector<FoundFace>& joined() {
    join_same_faces(boxes, options.same_face_overlap, faces);
    std::stable_sort(faces.begin(), faces.end(), [](const FoundFace& a, const FoundFace& b) {
      return a.box.area() > b.box.area();
    });
    return faces;
  }

  void look_closer(const cv::Mat& bgr) {
    const double side = 2.0 / 3 * std::min(bgr.cols, bgr.rows);
    const auto steps = [&](int length) {
      return std::max(1, int(std::ceil(2 * (length / side - 1))));
    };
    const int across = steps(bgr.cols), down = steps(bgr.rows);
    for (int j = 0; j <= down; ++j)
      for (int i = 0; i <= across; ++i)
        look_at(bgr, {(side - 1) / 2 + i * (bgr.cols - side) / across,
                      (side - 1) / 2 + j * (bgr.rows - side) / down, side, 0});
  }
};

namespace {
void check_picture(const cv::Mat& bgr) {
  if (bgr.empty() || bgr.type() != CV_8UC3)
    throw std::invalid_argument("FaceFinder: a picture of type CV_8UC3 is wanted");
}
}  // namespace

FaceFinder::FaceFinder(const FaceFinderOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
FaceFinder::~FaceFinder() = default;
FaceFinder::FaceFinder(FaceFinder&&) noexcept = default;
FaceFinder& FaceFinder::operator=(FaceFinder&&) noexcept = default;

const std::vector<FoundFace>& FaceFinder::find(const cv::Mat& bgr) {
  check_picture(bgr);
  Impl& my = *impl_;
  my.boxes.clear();
  my.look_at(bgr,
             {(bgr.cols - 1) / 2.0, (bgr.rows - 1) / 2.0, double(std::max(bgr.cols, bgr.rows)), 0});
  if (my.boxes.empty() && my.options.look_closer) my.look_closer(bgr);
  return my.joined();
}

const std::vector<FoundFace>& FaceFinder::find_in(const cv::Mat& bgr, const FaceRegion& square) {
  check_picture(bgr);
  impl_->boxes.clear();
  impl_->look_at(bgr, square);
  return impl_->joined();
}

}  // namespace hyperex::tracking
