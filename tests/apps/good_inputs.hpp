// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A scan, its landmarks, a recording and a scene that the program accepts, made of the embedded
// face. Tests then introduce one error.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex {

/// Writes face.ply (mm, binary), face_landmarks.json (mm), motion.csv (mm, 30 Hz, 0.5 s) and
/// scene.toml (coarse and short: a run takes a second) into `folder`.
void write_good_inputs(const std::filesystem::path& folder);

/// Writes motion.csv again: at most `count` samples of the mouth opening from `first` on, changed
/// by a function.
void write_opening(
    const std::filesystem::path& folder, std::size_t first, std::size_t count,
    const std::function<void(motion::Motion&)>& change = [](motion::Motion&) {});

/// Keeps seven points of the mouth and chin, and six of a headband, called head_1 to head_6. A
/// change for write_opening().
void keep_mouth_and_headband(motion::Motion& m);

/// Takes points away, which must be there. A change for write_opening().
void leave_out(motion::Motion& m, const std::vector<std::string>& names);

/// Adds six points of a headband, head_1 to head_6, to the landmarks. A change for write_opening().
void add_headband(motion::Motion& m);

TriMesh good_face();             ///< metres
io::Landmarks good_landmarks();  ///< metres

void write_mm(const std::filesystem::path& file, const TriMesh& mesh);
void write_ascii_ply_mm(const std::filesystem::path& file, const TriMesh& mesh);

/// Replaces the first `from` in a text file; it must occur.
void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to);
/// Keeps the first `share` (0 to 1) of a file's bytes.
void tear(const std::filesystem::path& file, double share);
void put(const std::filesystem::path& file, const std::string& text);

}  // namespace hyperex
