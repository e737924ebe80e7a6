// SPDX-License-Identifier: GPL-3.0-or-later
#include "access.hpp"

#include <gtest/gtest.h>

#include <set>

#include "token.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {
namespace {

TEST(Access, TakesItsOwnLoopbackNamesAndNothingElse) {
  EXPECT_TRUE(own_host("127.0.0.1:8080", 8080));
  EXPECT_TRUE(own_host("localhost:8080", 8080));
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80800", "127.0.0.1:808", "evil.example:8080",
                           "127.0.0.1.evil.example:8080", "localhost:8080.evil", "0.0.0.0:8080",
                           " 127.0.0.1:8080", "127.0.0.1:8080@evil"})
    EXPECT_FALSE(own_host(host, 8080)) << host;
  EXPECT_TRUE(own_origin("http://127.0.0.1:8080", 8080));
  for (const char* origin : {"", "null", "https://127.0.0.1:8080", "http://127.0.0.1:8081",
                             "http://evil.example:8080", "http://127.0.0.1:8080/", "file://"})
    EXPECT_FALSE(own_origin(origin, 8080)) << origin;
}

TEST(Token, IsLongDifferentEachTimeAndComparedWhole) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) seen.insert(new_token());
  EXPECT_EQ(seen.size(), 100U);
  for (const std::string& token : seen) {
    EXPECT_EQ(token.size(), 32U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
  const std::string token = *seen.begin();
  EXPECT_TRUE(same_token(token, token));
  EXPECT_FALSE(same_token("", token));
  EXPECT_FALSE(same_token(token.substr(0, 31), token));
  EXPECT_FALSE(same_token(token + token, token));
  std::string wrong = token;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  EXPECT_FALSE(same_token(wrong, token));
}

TEST(UploadName, LeadsNowhereElse) {
  for (const char* name : {"me.ply", "a b (1).csv", "Gesicht-ä.glb", "x"})
    EXPECT_TRUE(is_upload_name(name)) << name;
  for (const char* name : {"", ".", "..", "../x", "a/b", "a\\b", ".hidden", "x\n", "x\x01", "a:b",
                           "~root", "$HOME", "a;b", "a|b", "*", " x"})
    EXPECT_FALSE(is_upload_name(name)) << name;
  EXPECT_FALSE(is_upload_name(std::string(101, 'a')));
}

}  // namespace
}  // namespace hyperex::studio
