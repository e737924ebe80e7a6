// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Messages as apps/studio/protocol.json describes them; the page's types are made of the same file.
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
  nlohmann::json fields;  ///< as protocol() has them: types and ranges are checked
};

/// Throws InputError, one sentence, for what is no request. `id` is set as far as there is one, so
/// that the answer finds its question.
Request read_request(std::string_view text, std::int64_t& id);

/// A binary message: the length of its text, the text, zeros up to a multiple of 8, the block.
std::string binary_message(const nlohmann::json& head, const report::BinaryBlock& block);

}  // namespace hyperex::studio
