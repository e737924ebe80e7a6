// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/core/kept_results.hpp"
#include "hyperex/expression/face_model.hpp"

namespace hyperex::session {

/// The rig of blend shapes in a glTF file as a face model that weights move
/// (expression::rig_model). Its landmarks are those that the file lists, as `hyperex rig` writes
/// them, else they are found on its skin. Points of a lip move with that lip. Throws InputError
/// naming the file.
expression::FaceModel rig_face(const std::filesystem::path& file, const KeptResults& kept);

}  // namespace hyperex::session
