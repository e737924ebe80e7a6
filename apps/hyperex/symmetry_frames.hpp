// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::cli {

/// A surface over time. All frames have the same vertices; the first frame is at rest.
struct SurfaceFrames {
  TriMesh rest;
  io::LengthUnit unit = io::LengthUnit::millimetre;
  std::vector<Points> positions;  ///< one entry per frame, m
  io::Landmarks landmarks;
  /// The landmarks over time. Each moves with the triangle on which it lies at rest.
  motion::Motion tracks;
};

/// Reads the PLY and OBJ files of a folder in the order of their names, as frames at `rate_hz` per
/// second, and the landmarks of the first frame. Throws InputError if there are fewer than two
/// files or if their numbers of vertices differ.
SurfaceFrames read_surface_frames(const std::filesystem::path& folder,
                                  const std::filesystem::path& landmarks,
                                  std::optional<io::LengthUnit> unit, double rate_hz);

/// Removes the head's rigid motion, estimated from the tracks as that of a recording
/// (motion::stabilise), from positions and tracks. Returns the tracks with the errors of the pose.
/// `rigid_points`: the landmarks that hold it; empty: all. Throws InputError where the landmarks do
/// not determine it, or for a name that is none of them.
motion::StabilisedMotion steady(SurfaceFrames& frames,
                                const std::vector<std::string>& rigid_points);

}  // namespace hyperex::cli
