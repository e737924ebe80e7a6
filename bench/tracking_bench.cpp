// SPDX-License-Identifier: GPL-3.0-or-later
// The time of tracking a face, by stage, and of the measured deformation of a scan after it:
//   tracking_bench OUT.json RECORDING... [--scan SCAN --landmarks FILE]
// Measured on one core: the networks' library uses one thread. Comparing the processor time of the
// process with the elapsed time shows whether another program used the core.
#include <CLI/CLI.hpp>
#include <ctime>
#include <opencv2/core.hpp>

#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tracking/fit/face_tracker.hpp"
#include "support/machine.hpp"

namespace hyperex::bench {
namespace {

using Json = nlohmann::ordered_json;
using tracking::TrackedFrame;

double process_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// A scan's skin that follows a tracked mesh, as a measured region of it does.
class Follower {
 public:
  Follower(const std::filesystem::path& scan, const std::filesystem::path& landmarks) {
    skin_ = io::read_scan(scan, std::nullopt).mesh.points;
    const io::Landmarks at = io::read_landmarks(landmarks, std::nullopt);
    const expression::FaceModel& model = expression::canonical_model();
    std::vector<Vec3> from, to;
    for (const auto& [name, vertices] : model.landmarks)
      if (at.contains(name)) {
        from.push_back(expression::landmark_at(vertices, model.mesh.points));
        to.push_back(at.at(name));
      }
    Points a(Eigen::Index(from.size()), 3), b(a.rows(), 3);
    for (std::size_t i = 0; i < from.size(); ++i) {
      a.row(Eigen::Index(i)) = from[i].transpose();
      b.row(Eigen::Index(i)) = to[i].transpose();
    }
    scan_from_model_ = fit_similarity(a, b);
    const TriMesh tracked{scan_from_model_.apply(model.mesh.points), model.mesh.triangles};
    matches_ = simulate::match(skin_, tracked);
    moved_ = skin_;
  }

  Eigen::Index vertices() const { return skin_.rows(); }
  /// Moves the skin with a frame whose vertices were at `rest` in the first frame.
  void follow(const Points& rest, const Points& now) {
    const Points displacement =
        scan_from_model_.scale * (now - rest) * scan_from_model_.rotation.transpose();
    for (std::size_t v = 0; v < matches_.size(); ++v)
      moved_.row(Eigen::Index(v)) =
          skin_.row(Eigen::Index(v)) + matches_[v].displacement(displacement).transpose();
  }

 private:
  Points skin_, moved_;
  Similarity scan_from_model_;
  std::vector<simulate::Match> matches_;
};

/// One pass over a source. If there is a follower, the skin follows the tracked frames.
struct Pass {
  double wall_s = 0, process_s = 0, follow_s = 0;
  tracking::TrackerTimes times;
  std::size_t frames = 0, valid = 0;
};

template <class Next>
Pass run(const capture::Intrinsics& camera, Next next, Follower* follower) {
  tracking::FaceTracker tracker(expression::canonical_model(), camera);
  Pass pass;
  Points rest;
  const auto take = [&](const std::vector<TrackedFrame>& given) {
    Stopwatch watch;
    for (const TrackedFrame& frame : given) {
      ++pass.frames;
      if (!frame.valid) continue;
      ++pass.valid;
      if (!follower) continue;
      if (rest.rows() == 0) rest = frame.vertices_m;
      follower->follow(rest, frame.vertices_m);
    }
    pass.follow_s += watch.lap();
  };
  const double process = process_seconds();
  Stopwatch watch;
  while (const auto frame = next()) take(tracker.feed(*frame));
  take(tracker.finish());
  pass.wall_s = watch.lap();
  pass.process_s = process_seconds() - process;
  pass.times = tracker.times();
  return pass;
}

Json describe(const Pass& pass) {
  const double frames = double(pass.frames);
  return {{"frames", pass.frames},
          {"valid", pass.valid},
          {"frames_per_s", frames / pass.wall_s},
          {"cores_busy", pass.process_s / pass.wall_s},
          {"network_s", pass.times.network_s / frames},
          {"pictures_s", pass.times.picture_s / frames},
          {"fit_s", pass.times.fit_s / frames},
          {"neutral_once_s", pass.times.neutral_s},
          {"follow_s", pass.follow_s / frames}};
}

Json measure(const std::string& recording, Follower* follower) {
  Json out;
  out["name"] = std::filesystem::path(recording).parent_path().filename().string();
  std::vector<capture::Frame> decoded;
  auto source = capture::open_source(recording, {});
  const capture::Intrinsics camera = source->intrinsics();
  Stopwatch watch;
  while (auto frame = source->next()) decoded.push_back(std::move(*frame));
  out["decode_s"] = watch.lap() / double(decoded.size());
  constexpr int kRepeats = 3;  // the fastest counts, since other programs can only add time
  const auto quickest = [&](auto pass_of) {
    Pass best = pass_of();
    for (int i = 1; i < kRepeats; ++i)
      if (const Pass pass = pass_of(); pass.wall_s < best.wall_s) best = pass;
    return describe(best);
  };
  const auto from_memory = [&](Follower* skin) {
    std::size_t at = 0;
    return run(
        camera,
        [&]() -> std::optional<capture::Frame> {
          return at < decoded.size() ? std::optional(decoded[at++]) : std::nullopt;
        },
        skin);
  };
  out["decoded"] = quickest([&] { return from_memory(nullptr); });
  out["with_decoding"] = quickest([&] {
    const auto again = capture::open_source(recording, {});
    return run(
        camera, [&] { return again->next(); }, nullptr);
  });
  if (follower) {
    out["with_scan"] = quickest([&] {
      const auto again = capture::open_source(recording, {});
      return run(
          camera, [&] { return again->next(); }, follower);
    });
    out["scan_vertices"] = follower->vertices();
  }
  return out;
}

}  // namespace
}  // namespace hyperex::bench

int main(int argc, char** argv) {
  CLI::App program("What tracking a face costs");
  std::string out, scan, landmarks;
  std::vector<std::string> recordings;
  program.add_option("OUT", out)->required();
  program.add_option("RECORDING", recordings)->required();
  program.add_option("--scan", scan);
  program.add_option("--landmarks", landmarks);
  CLI11_PARSE(program, argc, argv);
  cv::setNumThreads(1);
  using namespace hyperex::bench;
  std::optional<Follower> follower;
  if (!scan.empty()) follower.emplace(scan, landmarks);
  nlohmann::ordered_json result;
  result["recordings"] = nlohmann::ordered_json::array();
  for (const auto& recording : recordings)
    result["recordings"].push_back(measure(recording, follower ? &*follower : nullptr));
  write_json(result, out);
}
