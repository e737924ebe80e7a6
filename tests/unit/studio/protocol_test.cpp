// SPDX-License-Identifier: GPL-3.0-or-later
#include "protocol.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"

namespace hyperex::studio {
namespace {

using nlohmann::json;

std::string wrong_with(const std::string& text) {
  std::int64_t id = -1;
  return hyperex::test::refusal([&] { read_request(text, id); });
}

TEST(Protocol, TakesARequestAsItIsDescribed) {
  std::int64_t id = -1;
  const Request request = read_request(
      R"({"id": 7, "do": "set", "changes": {"a.b": 1}, "face": 2, "live": true, "time_s": 0.5})",
      id);
  EXPECT_EQ(id, 7);
  EXPECT_EQ(request.id, 7);
  EXPECT_EQ(request.name, "set");
  EXPECT_EQ(request.fields.at("changes"), json({{"a.b", 1}}));
  EXPECT_EQ(request.fields.at("face"), 2);
}

TEST(Protocol, RefusesEachWrongRequestInOneSentence) {
  const std::string all =
      R"({"id": 1, "do": "set", "changes": {}, "face": 0, "live": false, "time_s": 0})";
  EXPECT_EQ(wrong_with(all), "");
  const auto with = [&](const char* field, const json& value) {
    json message = json::parse(all);
    message[field] = value;
    return wrong_with(message.dump());
  };
  EXPECT_EQ(with("face", -1), "set: face: expected a whole number from 0 to 100");
  EXPECT_EQ(with("face", 1.5), "set: face: expected a whole number from 0 to 100");
  EXPECT_EQ(with("live", 1), "set: live: expected true or false");
  EXPECT_EQ(with("time_s", "x"), "set: time_s: expected a number from 0 to 3600");
  EXPECT_EQ(with("time_s", nullptr), "set: time_s is missing");
  EXPECT_EQ(with("more", 1), "set: unknown field");
  EXPECT_EQ(with("do", "format_disk"), "unknown request: expected one of protocol.json as \"do\"");
  EXPECT_EQ(with("id", "x"), "malformed request: expected \"id\", a whole number");
  EXPECT_EQ(wrong_with("{"), "malformed request: expected a JSON object");
  EXPECT_EQ(wrong_with("[1]"), "malformed request: expected a JSON object");
  EXPECT_EQ(wrong_with(std::string(5000, '[')), "malformed request: nested too deeply");
  EXPECT_NE(wrong_with("\xff\xfe"), "");
  EXPECT_EQ(wrong_with(R"({"id": 1, "do": "save", "what": "disk", "name": "x"})").substr(0, 25),
            "save: what: expected one ");
}

TEST(Protocol, EveryRequestAndEventIsDescribed) {
  for (const char* group : {"requests", "events"})
    for (const auto& [name, one] : protocol().at(group).items()) {
      EXPECT_TRUE(one.at("about").is_string()) << name;
      for (const auto& [field, about] : one.at("fields").items()) {
        EXPECT_TRUE(about.at("about").is_string()) << name << "." << field;
        const std::string type = about.at("type");
        EXPECT_TRUE(type == "string" || type == "integer" || type == "number" ||
                    type == "boolean" || type == "json" || type == "array")
            << name << "." << field;
      }
    }
}

TEST(Protocol, ABinaryMessageHoldsItsTextAndItsBlock) {
  report::BinaryBlock block;
  const json head = {{"event", "x"}, {"values", block.add(std::vector<float>{1, 2, 3})}};
  const std::string message = binary_message(head, block);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(message[i]); };
  const std::size_t length = byte(0) | byte(1) << 8U | byte(2) << 16U | byte(3) << 24U;
  EXPECT_EQ(json::parse(message.substr(4, length)), head);
  const std::size_t at = (4 + length + 7) / 8 * 8;
  ASSERT_EQ(message.size(), at + 12);
  float second = 0;
  std::memcpy(&second, message.data() + at + 4, 4);
  EXPECT_EQ(second, 2);
}

}  // namespace
}  // namespace hyperex::studio
