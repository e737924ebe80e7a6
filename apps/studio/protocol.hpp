// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Messages as described by apps/studio/protocol.json, from which the page's types are generated.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "hyperex/report/page_data.hpp"

namespace hyperex::studio {

/// protocol.json.
const nlohmann::json& protocol();

struct Request {
  std::int64_t id = 0;
  std::string name;
  nlohmann::json fields;  ///< types and ranges checked against protocol()
};

/// Parses and checks a request. Throws InputError (one sentence) where it is malformed. Sets `id`
/// even then, if the text contains one, so that the error can be sent as the answer.
Request read_request(std::string_view text, std::int64_t& id);

/// A binary message: the length of its text, the text, zeros up to a multiple of 8, then the block.
std::string binary_message(const nlohmann::json& head, const report::BinaryBlock& block);

}  // namespace hyperex::studio
