// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Names of uploaded files.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hyperex::studio {

/// Whether an upload may have this name: letters, digits, spaces, any of -_.() and non-ASCII UTF-8
/// without control characters; no leading dot or space; at most 100 bytes.
bool is_upload_name(std::string_view name);

/// Decodes percent-encoding ("%20" is a space). Empty for malformed text.
std::optional<std::string> percent_decoded(std::string_view text);

/// "me.ply", or "me-2.ply" where the folder has a "me.ply": scenes may name the earlier file.
std::string unused_name(const std::filesystem::path& folder, const std::string& name);

}  // namespace hyperex::studio
