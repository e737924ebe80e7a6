// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// Whether a variant may be called so: a name stands in tables, pages and pictures. Letters and
/// digits of ASCII, at least one, spaces and any of -_.,;:+=%&'()[], at most 100 characters.
bool is_variant_name(const std::string& name);

/// What is expected in the place of a value that is no name for a variant; empty where it is one.
std::string expected_variant_name(const nlohmann::json& name);

/// What a [[variant]] is called: by its name, else by its preset; empty where it has neither.
std::string name_of_block(const nlohmann::json& block);

/// Whether a variant may change this key; and in words which keys it may.
bool may_vary(const std::string& key);
std::string what_may_vary();

/// The folder of a variant's outputs. It is `name` with each run of spaces and of characters that
/// are awkward in paths replaced by one '_', and none at its ends: "left zygomaticus at 30 %" gives
/// "left_zygomaticus_at_30". A number is appended where one of `others` has the same folder.
std::string variant_folder(const std::string& name, const std::vector<Variant>& others);

}  // namespace hyperex::scene
