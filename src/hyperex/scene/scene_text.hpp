// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Edits the text of a scene file key by key. All other text, including comments, stays as it was
// written.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hyperex::scene {

/// `text` (valid TOML) with the key ("tissue.young_kpa") set to another value, in the units of
/// scene files; null removes the key. An existing key gets the new value in its place. A new key is
/// put at the end of its section; a new section is put before the first [[variant]]. Where the
/// file's layout does not allow this, the whole file is written again without its comments. Throws
/// TornToml where `text` is not TOML, InputError for a value that TOML cannot represent.
std::string with_value(const std::string& text, const std::string& key,
                       const nlohmann::json& value);

/// The tables [[variant]] of a scene file, in its order.
std::vector<nlohmann::json> variant_blocks(const std::string& text);

/// The text of each of them, comments inside included; empty where they are not all written as
/// [[variant]].
std::vector<std::string> variant_texts(const std::string& text);

/// `text` with another list of variants. A block that is equal to an existing one keeps the text of
/// that one; the others are written anew.
std::string with_variants(const std::string& text, const std::vector<nlohmann::json>& blocks);

/// The text of a scene file with these values: {"tissue": {"young_kpa": 150}, "variant": [...]}.
std::string toml_document(const nlohmann::json& root);

}  // namespace hyperex::scene
