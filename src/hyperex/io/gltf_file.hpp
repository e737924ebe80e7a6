// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tiny_gltf.h>

#include <filesystem>

namespace hyperex::io {

/// The model of a glTF 2.0 file, text or binary, with the files beside it that it names; pictures
/// stay encoded. Throws InputError: torn, unsound, nested too deep, a file outside its folder, or
/// an extension that is required and not supported.
tinygltf::Model load_gltf(const std::filesystem::path& file);

}  // namespace hyperex::io
