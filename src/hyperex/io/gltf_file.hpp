// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tiny_gltf.h>

#include <filesystem>

namespace hyperex::io {

/// Loads a glTF 2.0 file, text or binary, and the files that it refers to. Images stay encoded.
/// Throws InputError if the file is damaged, invalid or nested too deeply, if it refers to a file
/// outside its folder, or if it requires an extension that is not supported.
tinygltf::Model load_gltf(const std::filesystem::path& file);

}  // namespace hyperex::io
