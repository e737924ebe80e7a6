// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/face_mesh_network.hpp"

#include <flatbuffers/flexbuffers.h>

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "hyperex/tracking/network/model_bytes.hpp"
#include "hyperex/tracking/network/tflite_constants.hpp"
#include "hyperex/tracking/network/tflite_network.hpp"

namespace hyperex::tracking {
namespace {

constexpr const char* file_name = "face_landmark_with_attention.tflite";

/// A region refined by the second stage: the lips, one eye, the other eye.
struct Region {
  std::vector<int> points;  // numbers among the 468, in the order of the second stage's output
  int left = 0, right = 0;  // the two points that define the rotation of the region
  double scale_x = 1, scale_y = 1;  // scale of the box around the points
  Network network;                  // from the region's features to its points
  cv::Mat features;                 // 1 x C x h x w, sampled
  int output = -1, crop = -1;       // tensor indices
};

/// A rotated box in cells of the feature map.
struct Box {
  double x, y, cos, sin, width, height;
  /// Maps (0, 0) to (1, 1) to cells.
  cv::Point2d at(double u, double v) const {
    const double right = (u - 0.5) * width, down = (v - 0.5) * height;
    return {x + cos * right - sin * down, y + sin * right + cos * down};
  }
};

Box box_about(const Region& region, const FacePoints& points, double cells_per_px) {
  const Eigen::RowVector2d along =
      (points.row(region.right) - points.row(region.left)).head<2>().normalized();
  Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
  for (const int k : region.points) {
    const Eigen::Array2d turned(along.x() * points(k, 0) + along.y() * points(k, 1),
                                along.x() * points(k, 1) - along.y() * points(k, 0));
    low = low.min(turned), high = high.max(turned);
  }
  const Eigen::Array2d middle = cells_per_px * (low + high) / 2;
  const Eigen::Array2d size = cells_per_px * (high - low);
  return {along.x() * middle.x() - along.y() * middle.y(),
          along.y() * middle.x() + along.x() * middle.y(),
          along.x(),
          along.y(),
          size.x() * region.scale_x,
          size.y() * region.scale_y};
}

/// Cell centres are at half integers. Positions beyond the centres of the outermost cells give 0.
void sample(const cv::Mat& map, const Box& box, cv::Mat& samples) {
  const int channels = map.size[1], rows = map.size[2], columns = map.size[3];
  const int height = samples.size[2], width = samples.size[3];
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const cv::Point2d p = box.at((i + 0.5) / width, (j + 0.5) / height);
      const double x = p.x - 0.5, y = p.y - 0.5;
      const bool outside = !(x >= 0 && y >= 0 && x <= columns - 1 && y <= rows - 1);
      const int x0 = outside ? 0 : int(x), y0 = outside ? 0 : int(y);
      const int x1 = std::min(x0 + 1, columns - 1), y1 = std::min(y0 + 1, rows - 1);
      const float right = float(x - x0), down = float(y - y0);
      for (int c = 0; c < channels; ++c) {
        const float* m = map.ptr<float>(0, c);
        const float upper = (1 - right) * m[y0 * columns + x0] + right * m[y0 * columns + x1];
        const float lower = (1 - right) * m[y1 * columns + x0] + right * m[y1 * columns + x1];
        samples.ptr<float>(0, c)[j * width + i] = outside ? 0 : (1 - down) * upper + down * lower;
      }
    }
}

Region read_region(const TfliteConstants& file, const tflite::Operator& op) {
  if (!op.custom_options()) file.fail("has a region without options");
  const auto options =
      flexbuffers::GetRoot(op.custom_options()->data(), op.custom_options()->size()).AsMap();
  Region region;
  const auto points = options["subset_idxs"].AsTypedVector();
  for (std::size_t k = 0; k < points.size(); ++k) region.points.push_back(points[k].AsInt32());
  region.left = options["left_rotation_idx"].AsInt32();
  region.right = options["right_rotation_idx"].AsInt32();
  region.scale_x = options["scale_x"].AsDouble();
  region.scale_y = options["scale_y"].AsDouble();
  auto all = region.points;
  all.insert(all.end(), {region.left, region.right});
  if (region.points.empty() || *std::min_element(all.begin(), all.end()) < 0 ||
      *std::max_element(all.begin(), all.end()) >= face_point_count)
    file.fail("has a region whose points are not of the 468");
  return region;
}

}  // namespace

struct FaceMeshNetwork::Impl {
  Network whole;  // gives the feature map, the 468 points and the score
  std::vector<Region> regions;
  std::vector<cv::Mat> outputs;

  Impl(bool lips, bool eyes) {
    const auto bytes = face_landmark_bytes();
    const TfliteConstants file(bytes, file_name);
    int features = -1, points = -1, score = -1;
    for (const auto* op : *file.graph().operators())
      if (file.custom_name(*op) == "TransformTensorBilinear" && op->inputs()->size() == 2) {
        const tflite::Operator& matrix = file.maker(op->inputs()->Get(1));
        regions.push_back(read_region(file, matrix));
        features = op->inputs()->Get(0);
        regions.back().crop = op->outputs()->Get(0);
        // points -> RESHAPE -> MUL (pixels to cells) -> the matrix
        points = file.maker(file.maker(matrix.inputs()->Get(0)).inputs()->Get(0)).inputs()->Get(0);
        regions.back().output = output_of(file, matrix.outputs()->Get(0), regions.back());
      }
    for (const int output : *file.graph().outputs())
      if (total(file.shape(output)) == 1) score = output;
    if (regions.empty() || total(file.shape(points)) != 3 * face_point_count)
      file.fail("is not the network of 468 points with regions looked at again");
    std::erase_if(regions, [&](const Region& r) {
      constexpr int upper_lip = 13;
      return std::ranges::find(r.points, upper_lip) != r.points.end() ? !lips : !eyes;
    });
    whole = read_tflite(bytes, file_name, {-1, {features, points, score}});
    for (Region& region : regions) {
      region.network = read_tflite(bytes, file_name, {region.crop, {region.output}});
      const int sizes[] = {1, region.network.channels, region.network.height_px,
                           region.network.width_px};
      region.features.create(4, sizes, CV_32F);
    }
  }

  static int total(const std::vector<int>& shape) {
    int count = 1;
    for (const int size : shape) count *= size;
    return count;
  }

  /// The output tensor of the TransformLandmarks that uses (a multiple of) this region's matrix.
  static int output_of(const TfliteConstants& file, int matrix, const Region& region) {
    for (const auto* op : *file.graph().operators()) {
      if (file.custom_name(*op) != "TransformLandmarks" || op->inputs()->size() != 2) continue;
      const int points = file.maker(op->inputs()->Get(0)).inputs()->Get(0);
      if (file.maker(op->inputs()->Get(1)).inputs()->Get(0) == matrix &&
          total(file.shape(points)) == 2 * int(region.points.size()))
        return points;
    }
    file.fail("has a region without points");
  }

  void look_again(Region& region, const cv::Mat& map, FacePoints& points) {
    const double px_per_cell = double(whole.width_px) / map.size[3];
    const Box box = box_about(region, points, 1 / px_per_cell);
    sample(map, box, region.features);
    region.network.net.setInput(region.features);
    const cv::Mat found = region.network.net.forward(region.network.outputs.front());
    const float* p = found.ptr<float>();
    for (std::size_t k = 0; k < region.points.size(); ++k) {
      const cv::Point2d at = box.at(p[2 * k] / (px_per_cell * region.network.width_px),
                                    p[2 * k + 1] / (px_per_cell * region.network.height_px));
      points.row(region.points[k]).head<2>() << px_per_cell * at.x, px_per_cell * at.y;
    }
  }
};

FaceMeshNetwork::FaceMeshNetwork(bool lips, bool eyes)
    : impl_(std::make_unique<Impl>(lips, eyes)) {}
FaceMeshNetwork::~FaceMeshNetwork() = default;
FaceMeshNetwork::FaceMeshNetwork(FaceMeshNetwork&&) noexcept = default;
FaceMeshNetwork& FaceMeshNetwork::operator=(FaceMeshNetwork&&) noexcept = default;

int FaceMeshNetwork::size_px() const {
  return impl_->whole.width_px;
}

double FaceMeshNetwork::look(const cv::Mat& picture, double least_score, FacePoints& points) {
  Impl& my = *impl_;
  my.whole.net.setInput(picture);
  my.whole.net.forward(my.outputs, my.whole.outputs);
  points = Eigen::Map<const Eigen::Matrix<float, face_point_count, 3, Eigen::RowMajor>>(
               my.outputs[1].ptr<float>())
               .cast<double>();
  const double score = 1 / (1 + std::exp(-double(my.outputs[2].ptr<float>()[0])));
  if (score >= least_score) {
    // All regions are located by the output of the first stage, not by refined points.
    const FacePoints first = points;
    for (Region& region : my.regions) {
      FacePoints again = first;
      my.look_again(region, my.outputs[0], again);
      for (const int k : region.points) points.row(k) = again.row(k);
    }
  }
  return score;
}

}  // namespace hyperex::tracking
