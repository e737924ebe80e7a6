// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A scene file as text that is edited key by key: what is not touched, comments among it, stays as
// it was written.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hyperex::scene {

/// `text`, sound TOML, with the key ("tissue.young_kpa") at another value, in the units of scene
/// files; null: without the key. Where the key stands its value is replaced; where its section
/// stands it is put at that section's end; else the section is put before the first [[variant]].
/// Where a file is written in a way that this cannot edit, the whole is written anew, without its
/// comments. Throws TornToml where `text` is no TOML, InputError for a value that TOML cannot hold.
std::string with_value(const std::string& text, const std::string& key,
                       const nlohmann::json& value);

/// The tables [[variant]] of a scene file, in its order.
std::vector<nlohmann::json> variant_blocks(const std::string& text);

/// `text` with another list of variants: blocks that are equal to one that stands there keep its
/// text, others are written anew.
std::string with_variants(const std::string& text, const std::vector<nlohmann::json>& blocks);

/// A whole scene file of these values: {"tissue": {"young_kpa": 150}, "variant": [...]}.
std::string toml_document(const nlohmann::json& root);

}  // namespace hyperex::scene
