// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetry_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::cli {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> surfaces_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string kind = entry.path().extension().string();
    if (kind == ".ply" || kind == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.size() < 2)
    throw InputError(folder, fmt::format("holds {} surfaces; expected a motion.csv, or two or more "
                                         "PLY or OBJ files, the first at rest",
                                         files.size()));
  return files;
}

void track(SurfaceFrames& frames) {
  const SurfaceTree tree(frames.rest);
  std::vector<ClosestPoint> feet;
  Points rest(static_cast<Eigen::Index>(frames.landmarks.size()), 3);
  for (const auto& [name, p] : frames.landmarks) {
    rest.row(static_cast<Eigen::Index>(feet.size())) = p.transpose();
    frames.tracks.names.push_back(name);
    feet.push_back(tree.query(p));
  }
  for (const Points& frame : frames.positions) {
    Points at = rest;
    for (std::size_t i = 0; i < feet.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const int v = frames.rest.triangles(feet[i].triangle, k);
        at.row(static_cast<Eigen::Index>(i)) +=
            feet[i].weights[k] * (frame.row(v) - frames.rest.points.row(v));
      }
    frames.tracks.positions.push_back(at);
  }
}

}  // namespace

SurfaceFrames read_surface_frames(const fs::path& folder, const fs::path& landmarks,
                                  std::optional<io::LengthUnit> unit, double rate_hz) {
  const std::vector<fs::path> files = surfaces_in(folder);
  if (landmarks.empty())
    throw InputError(InputProblem{"symmetry", 0, "--landmarks", "",
                                  "the landmarks of the first surface of " + folder.string()});
  SurfaceFrames frames;
  frames.landmarks = io::read_landmarks(landmarks);
  frames.tracks.source = folder.string();
  Progress progress("reading surfaces", static_cast<long>(files.size()));
  for (const fs::path& file : files) {
    const io::Scan scan = io::read_scan(file, unit);
    if (frames.positions.empty()) {
      frames.rest = scan.mesh;
      frames.unit = scan.unit;
      unit = scan.unit;
    }
    if (scan.mesh.points.rows() != frames.rest.points.rows())
      throw InputError(
          file, fmt::format("has {} vertices; expected {}, as {} has", scan.mesh.points.rows(),
                            frames.rest.points.rows(), files.front().filename().string()));
    frames.tracks.time_s.push_back(static_cast<double>(frames.positions.size()) / rate_hz);
    frames.positions.push_back(scan.mesh.points);
    progress.update(static_cast<long>(frames.positions.size()));
  }
  track(frames);
  return frames;
}

motion::StabilisedMotion steady(SurfaceFrames& frames,
                                const std::vector<std::string>& rigid_points) {
  motion::StabilisedMotion steadied =
      motion::stabilise(frames.tracks, {.rigid_points = rigid_points});
  frames.tracks = steadied.motion;
  for (std::size_t k = 0; k < frames.positions.size(); ++k) {
    const Eigen::Isometry3d back = frames.tracks.head_pose[k].inverse();
    Points& at = frames.positions[k];
    at = ((at * back.linear().transpose()).rowwise() + back.translation().transpose()).eval();
  }
  return steadied;
}

}  // namespace hyperex::cli
