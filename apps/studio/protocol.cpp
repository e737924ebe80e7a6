// SPDX-License-Identifier: GPL-3.0-or-later
#include "protocol.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hyperex/core/carried_file.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/io/nesting.hpp"

namespace hyperex::studio {

HX_CARRIED_FILE(protocol_json, HYPEREX_STUDIO_PROTOCOL)

namespace {

using nlohmann::json;

constexpr std::size_t kLongestText = 4096;

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(what);
}

/// What was expected instead of an invalid value; empty for a valid one.
std::string expectation_missed(const json& value, const json& field) {
  const std::string type = field.at("type");
  if (type == "json") return "";
  if (type == "boolean") return value.is_boolean() ? "" : "true or false";
  if (type == "string") {
    const std::size_t longest = field.value("longest", kLongestText);
    if (!value.is_string() || value.get_ref<const std::string&>().size() > longest)
      return fmt::format("a text of at most {} characters", longest);
    if (field.contains("choices")) {
      for (const json& choice : field.at("choices"))
        if (choice == value) return "";
      return "one of " + field.at("choices").dump();
    }
    return "";
  }
  const double least = field.value("least", -1e300), most = field.value("most", 1e300);
  const bool whole = type == "integer";
  const bool right = whole ? value.is_number_integer() : value.is_number();
  if (right && std::isfinite(value.get<double>()) && value.get<double>() >= least &&
      value.get<double>() <= most)
    return "";
  return fmt::format("{} from {:g} to {:g}", whole ? "a whole number" : "a number", least, most);
}

}  // namespace

const json& protocol() {
  static const json parsed = json::parse(protocol_json());
  return parsed;
}

Request read_request(std::string_view text, std::int64_t& id) {
  if (io::line_nested_too_deep_json(text) > 0) refuse("malformed request: nested too deeply");
  json message = json::parse(text, nullptr, false);
  if (!message.is_object()) refuse("malformed request: expected a JSON object");
  const auto given = message.find("id");
  if (given == message.end() || !given->is_number_integer())
    refuse("malformed request: expected \"id\", a whole number");
  id = given->get<std::int64_t>();
  const auto name = message.find("do");
  const json& requests = protocol().at("requests");
  if (name == message.end() || !name->is_string() || !requests.contains(name->get<std::string>()))
    refuse("unknown request: expected one of protocol.json as \"do\"");
  Request request{id, name->get<std::string>(), json::object()};
  const json& fields = requests.at(request.name).at("fields");
  for (const auto& [key, field] : fields.items()) {
    const auto value = message.find(key);
    if (value == message.end() || value->is_null()) {
      if (field.value("optional", false)) continue;
      refuse(fmt::format("{}: {} is missing", request.name, key));
    }
    if (const std::string expected = expectation_missed(*value, field); !expected.empty())
      refuse(fmt::format("{}: {}: expected {}", request.name, key, expected));
    request.fields[key] = *value;
  }
  for (const auto& [key, value] : message.items())
    if (key != "id" && key != "do" && !fields.contains(key))
      refuse(fmt::format("{}: unknown field", request.name));
  return request;
}

std::string binary_message(const json& head, const report::BinaryBlock& block) {
  std::string text = head.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string out(4, '\0');
  const auto length = static_cast<std::uint32_t>(text.size());
  for (unsigned i = 0; i < 4; ++i) out[i] = static_cast<char>(length >> (8 * i) & 255U);
  out += text;
  out.resize((out.size() + 7) / 8 * 8, '\0');
  out.append(reinterpret_cast<const char*>(block.bytes().data()), block.bytes().size());
  return out;
}

}  // namespace hyperex::studio
