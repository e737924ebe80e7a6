// SPDX-License-Identifier: GPL-3.0-or-later
// How the lips of a rig fit together, without and with its correctives: the gap that mouthClose
// leaves at a jaw opened by 0.7, and how deep the lips lie in each other in frames of a recording.
//   rig_lips_bench SCAN WEIGHTS.csv [--landmarks FILE] [--frames 100] [--seed 1]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/rig/correctives.hpp"
#include "hyperex/rig/face_rig.hpp"
#include "hyperex/session/embedded_scan.hpp"

namespace hyperex::bench {
namespace {

using Weights = std::map<std::string, double>;
using Shapes = std::vector<report::RigShape>;

struct Request {
  std::filesystem::path scan, recording, landmarks;
  std::size_t frames = 100;
  unsigned seed = 1;
};

rig::FaceRig made(const Request& request) {
  session::Face face;
  if (request.scan == "embedded") {
    face.scan = session::embedded_scan();
    face.landmarks = anatomy::embedded_face().landmarks;
  } else {
    face.scan = io::read_scan(request.scan, std::nullopt);
    if (!request.landmarks.empty()) face.landmarks = io::read_landmarks(request.landmarks);
  }
  return rig::make_rig(std::move(face), {}, {}, rig::Correctives::of_clashing_pairs);
}

/// The vertex of a lip at a landmark.
int vertex_at(const Vec3& landmark, const Points& places, const std::vector<int>& vertices) {
  Eigen::Index nearest = 0;
  (places.rowwise() - landmark.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return vertices[std::size_t(nearest)];
}

/// Height of the upper lip over the lower one at three places of the inner lips, mm.
std::vector<double> gaps_mm(const rig::FaceRig& rig, const PointsF& moved) {
  const io::Landmarks landmarks = report::landmarks_at_rest(rig.performance);
  const Vec3 up = face::face_frame(landmarks).y;
  const Points now = rig.performance.skin_rest.points + moved.cast<double>();
  std::vector<double> gaps;
  for (const auto& [upper, lower] : {std::pair{61, 67}, {62, 66}, {63, 65}}) {
    const int above =
        vertex_at(landmarks.at(face::ibug(upper)), rig.lips->upper_rest(), rig.lips->upper());
    const int below =
        vertex_at(landmarks.at(face::ibug(lower)), rig.lips->lower_rest(), rig.lips->lower());
    gaps.push_back(1e3 * (now.row(above) - now.row(below)).dot(up));
  }
  return gaps;
}

Weights weights_in(const expression::BlendShapes& recorded, std::size_t frame) {
  Weights weights;
  for (std::size_t c = 0; c < recorded.names.size(); ++c)
    if (const double w = recorded.weights(Eigen::Index(frame), Eigen::Index(c)); w > 0)
      weights[recorded.names[c]] = w;
  return weights;
}

void print_gaps(const rig::FaceRig& rig, const Shapes& shapes, const char* what) {
  const auto row = [&](const Weights& weights) {
    const auto gaps = gaps_mm(rig, rig::skin_at(shapes, weights));
    return fmt::format("{:6.2f} {:6.2f} {:6.2f}", gaps[0], gaps[1], gaps[2]);
  };
  fmt::print("gap of the lips, mm, {}\n  at rest              {}\n  jawOpen 0.7          {}\n",
             what, row({}), row({{"jawOpen", 0.7}}));
  for (const double weight : {0.35, 0.7, 1.0})
    fmt::print(
        "  jawOpen, mouthClose {:4.2f} {}; lips {:.2f} mm in each other\n", weight,
        row({{"jawOpen", weight}, {"mouthClose", weight}}),
        1e3 * rig.lips->depth(rig::skin_at(shapes, {{"jawOpen", weight}, {"mouthClose", weight}})));
}

void print_overlaps(const rig::FaceRig& rig, const Shapes& shapes,
                    const expression::BlendShapes& recorded, const std::vector<std::size_t>& frames,
                    const char* what) {
  constexpr double kAllowed_mm = 0.2;
  std::vector<double> depths_mm;
  for (const std::size_t frame : frames)
    depths_mm.push_back(1e3 * rig.lips->depth(rig::skin_at(shapes, weights_in(recorded, frame))));
  const auto worst = std::ranges::max_element(depths_mm);
  fmt::print(
      "lips in each other in {} frames, {}: greatest {:.2f} mm ({:.2f} s), mean {:.3f} mm, over {} "
      "mm in {}\n",
      frames.size(), what, *worst, recorded.time_s[frames[std::size_t(worst - depths_mm.begin())]],
      std::reduce(depths_mm.begin(), depths_mm.end()) / double(frames.size()), kAllowed_mm,
      std::ranges::count_if(depths_mm, [](double mm) { return mm > kAllowed_mm; }));
}

/// Different frames by chance, the same ones for a seed.
std::vector<std::size_t> chosen_frames(std::size_t of, const Request& request) {
  std::vector<std::size_t> frames(of);
  std::iota(frames.begin(), frames.end(), std::size_t(0));
  std::mt19937 random(request.seed);
  const std::size_t count = std::min(of, request.frames);
  for (std::size_t i = 0; i < count; ++i) std::swap(frames[i], frames[i + random() % (of - i)]);
  frames.resize(count);
  return frames;
}

void measure(const Request& request) {
  const expression::BlendShapes recorded = expression::read_arkit(request.recording);
  const rig::FaceRig rig = made(request);
  Shapes alone = rig.shapes;
  std::erase_if(alone, [](const report::RigShape& shape) { return shape.corrects.has_value(); });
  const auto frames = chosen_frames(recorded.time_s.size(), request);
  for (const auto& [shapes, what] :
       {std::pair<const Shapes*, const char*>{&alone, "without correctives"},
        {&rig.shapes, "with correctives"}}) {
    print_gaps(rig, *shapes, what);
    print_overlaps(rig, *shapes, recorded, frames, what);
  }
}

}  // namespace
}  // namespace hyperex::bench

int main(int count, char** arguments) {
  hyperex::bench::Request request;
  CLI::App app{"The lips of a rig, without and with its correctives"};
  app.add_option("SCAN", request.scan, "A scan, or embedded")->required();
  app.add_option("WEIGHTS", request.recording, "A recording of Live Link Face")->required();
  app.add_option("--landmarks", request.landmarks, "Landmarks on the scan");
  app.add_option("--frames", request.frames, "Frames by chance")->check(CLI::PositiveNumber);
  app.add_option("--seed", request.seed, "Of the choice");
  CLI11_PARSE(app, count, arguments);
  try {
    hyperex::bench::measure(request);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
