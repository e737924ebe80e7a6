// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::cli {

/// A surface over time: the same vertices in every frame, the first at rest.
struct SurfaceFrames {
  TriMesh rest;
  io::LengthUnit unit = io::LengthUnit::millimetre;
  std::vector<Points> positions;  ///< a frame each, m
  io::Landmarks landmarks;
  motion::Motion tracks;  ///< the landmarks, carried by the triangles that they lie on at rest
};

/// The PLY and OBJ files of a folder in the order of their names, `rate_hz` a second, and the
/// landmarks of the first. Throws InputError: fewer than two files, other numbers of vertices.
SurfaceFrames read_surface_frames(const std::filesystem::path& folder,
                                  const std::filesystem::path& landmarks,
                                  std::optional<io::LengthUnit> unit, double rate_hz);

/// Takes the head's pose, as the tracks give it, out of everything.
void steady(SurfaceFrames& frames);

}  // namespace hyperex::cli
