// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// Whether `name` is allowed for a variant; names appear in tables, pages and pictures. Letters and
/// digits of ASCII, at least one, spaces and any of -_.,;:+=%&'()[], at most 100 characters.
bool is_variant_name(const std::string& name);

/// The expected text for a value that is not a valid name of a variant; empty for a valid name.
std::string expected_variant_name(const nlohmann::json& name);

/// The name of a [[variant]]: its own, or else its preset's; empty where it has neither.
std::string name_of_block(const nlohmann::json& block);

/// Whether a variant may change this key, and a text that lists which keys it may change.
bool may_vary(const std::string& key);
std::string what_may_vary();

/// The folder of a variant's outputs: `name` with each run of spaces and characters awkward in
/// paths replaced by one '_', and without '_' and '.' at its ends. "left zygomaticus at 30 %" gives
/// "left_zygomaticus_at_30". A number is appended where one of `others` has the same folder.
std::string variant_folder(const std::string& name, const std::vector<Variant>& others);

}  // namespace hyperex::scene
