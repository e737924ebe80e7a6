// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/zip.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "support/test_file.hpp"
#include "support/zip_writer.hpp"

namespace hyperex::io {
namespace {

namespace fs = std::filesystem;
using test::Zipped;
using ::testing::HasSubstr;

class Unzip : public ::testing::Test {
 protected:
  Unzip() { fs::create_directories(root_ / "in"); }
  /// "" or the message.
  std::string unpacked(const std::string& bytes, const UnzipLimits& limits = {}) {
    fs::remove_all(into_);
    std::ofstream(root_ / "a.zip", std::ios::binary) << bytes;
    try {
      unzip(root_ / "a.zip", into_, limits);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(into_)) << "whole or not at all";
      EXPECT_TRUE(fs::is_empty(root_ / "in")) << "nothing is left of it";
      return error.what();
    }
    return "";
  }

  const TestFolder root_;
  const fs::path into_ = root_ / "in" / "a";
};

TEST_F(Unzip, GivesBackWhatWasPacked) {
  std::string numbers;
  for (int i = 0; i < 100000; ++i) numbers += std::to_string(i * 7919 % 1000) + ",";
  EXPECT_EQ(unpacked(test::zip_of({{"rec/", "", false, 040755},
                                   {"rec/rgb.txt", "0.0 rgb/0.png\n"},
                                   {"rec/rgb/0.png", std::string("\x89PNG\0\0", 6), false},
                                   {"rec/numbers.csv", numbers},
                                   {"rec/empty", ""},
                                   {"__MACOSX/rec/._rgb.txt", "x"},
                                   {"rec/.DS_Store", "x"}})),
            "");
  EXPECT_EQ(read_file(into_ / "rec" / "rgb.txt"), "0.0 rgb/0.png\n");
  EXPECT_EQ(read_file(into_ / "rec" / "rgb" / "0.png"), std::string("\x89PNG\0\0", 6));
  EXPECT_EQ(read_file(into_ / "rec" / "numbers.csv"), numbers);
  EXPECT_EQ(read_file(into_ / "rec" / "empty"), "");
  EXPECT_FALSE(fs::exists(into_ / "__MACOSX"));
  EXPECT_FALSE(fs::exists(into_ / "rec" / ".DS_Store"));
  constexpr int kUtf8 = 1 << 11;
  for (const int flags : {0, kUtf8}) {
    Zipped umlaut{"Gesicht \xc3\xa4/1.txt", "1"};
    umlaut.flags = flags;
    EXPECT_EQ(unpacked(test::zip_of({umlaut})), "");
    EXPECT_EQ(read_file(into_ / "Gesicht \xc3\xa4" / "1.txt"), "1") << flags;
  }
}

TEST_F(Unzip, WritesNothingElsewhere) {
  for (const std::string name : {"../x", "a/../../x", "/tmp/x", "a//x", "./x", "..", "a/..", "C:/x",
                                 "a\\..\\x", "\\x", "a\nb", ""})
    EXPECT_THAT(unpacked(test::zip_of({{"rgb.txt", "1"}, {name, "x"}})),
                HasSubstr("leads elsewhere"))
        << name;
  EXPECT_EQ(unpacked(test::zip_of({{std::string("a\0/../../b", 10), "x"}})), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(into_), {}), 1) << "a name ends at its null byte";
  EXPECT_EQ(read_file(into_ / "a"), "x");
  EXPECT_THAT(unpacked(test::zip_of({{std::string(300, 'n'), "x"}})), HasSubstr("elsewhere"));
  std::string deep;
  for (int i = 0; i < 40; ++i) deep += "d/";
  EXPECT_THAT(unpacked(test::zip_of({{deep + "x", "x"}})), HasSubstr("elsewhere"));
  EXPECT_THAT(unpacked(test::zip_of({{"link", "/etc", false, 0120777}, {"link/x", "x"}})),
              HasSubstr("is a link"));
  EXPECT_THAT(unpacked(test::zip_of({{"x", "1"}, {"x", "2"}})), HasSubstr("twice"));
  EXPECT_THAT(unpacked(test::zip_of({{"x", "1"}, {"x/y", "2"}})), HasSubstr("twice"));
  EXPECT_THAT(unpacked(test::zip_of({{"x/y", "1"}, {"x", "2"}})), HasSubstr("twice"));
  EXPECT_FALSE(fs::exists(root_ / "x"));
  EXPECT_FALSE(fs::exists(root_ / "in" / "x"));
  fs::create_directory(into_);
  EXPECT_THROW(unzip(root_ / "a.zip", into_), InputError) << "nothing is written over";
}

TEST_F(Unzip, KeepsToItsLimitsWhateverTheHeadersSay) {
  const std::string zeros(std::size_t(8) << 20U, '\0');  // packs to 8 kB
  const UnzipLimits small{std::uint64_t(1) << 20U, 3};
  EXPECT_THAT(unpacked(test::zip_of({{"bomb", zeros}}), small), HasSubstr("more than 1 MB"));
  Zipped lies{"bomb", zeros};
  lies.size = 10;
  EXPECT_THAT(unpacked(test::zip_of({lies}), small), HasSubstr("damaged (longer than"));
  EXPECT_THAT(unpacked(test::zip_of({lies})), HasSubstr("damaged (longer than"));
  const std::string half(std::size_t(600) << 10U, '\0');
  EXPECT_THAT(unpacked(test::zip_of({{"a", half}, {"b", half}}), small),
              HasSubstr("more than 1 MB"))
      << "together";
  EXPECT_THAT(unpacked(test::zip_of({{"a", ""}, {"b", ""}, {"c", ""}, {"d", ""}}), small),
              HasSubstr("holds more than 3 files"));
}

/// What a zip states of itself is enough to refuse it: not a byte of these can be unpacked.
TEST_F(Unzip, LooksAtTheDirectoryBeforeItUnpacks) {
  constexpr int kNoSuchMethod = 77;
  Zipped first{"d/first", "1"}, second{"second", "2"};
  first.method = second.method = kNoSuchMethod;
  const auto listed = [&](const std::vector<Zipped>& files, const UnzipLimits& limits = {}) {
    std::ofstream(root_ / "a.zip", std::ios::binary) << test::zip_of(files);
    return files_in_zip(root_ / "a.zip", limits);
  };
  EXPECT_EQ(listed({{"d/", "", false, 040755}, first, {"__MACOSX/x", "x"}, second}),
            (std::vector<fs::path>{"d/first", "second"}));
  EXPECT_TRUE(fs::is_empty(root_ / "in"));
  second.size = std::int64_t(900) << 20U;
  const UnzipLimits small{std::uint64_t(1) << 20U, 3};
  EXPECT_THAT(unpacked(test::zip_of({first, second}), small), HasSubstr("more than 1 MB"));
  EXPECT_THAT(unpacked(test::zip_of({first, {"../x", "x"}})), HasSubstr("leads elsewhere"));
  EXPECT_THAT(unpacked(test::zip_of({first, {"link", "/etc", false, 0120777}})),
              HasSubstr("is a link"));
  EXPECT_THAT(unpacked(test::zip_of({first, {"b", ""}, {"c", ""}, {"d", ""}}), small),
              HasSubstr("holds more than 3 files"));
}

TEST_F(Unzip, SaysWhatIsWrong) {
  EXPECT_THAT(unpacked("no zip at all"), HasSubstr("no sound zip"));
  EXPECT_THAT(unpacked(test::zip_of({})), HasSubstr("holds files"));
  Zipped one{"x", "some text, some text"};
  one.flags = 1;
  EXPECT_THAT(unpacked(test::zip_of({one})), HasSubstr("encrypted"));
  one.flags = 0;
  one.method = 77;
  EXPECT_THAT(unpacked(test::zip_of({one})), HasSubstr("Unsupported ZIP compression method"));
  one.method = -1;
  one.crc_off = 1;
  EXPECT_THAT(unpacked(test::zip_of({one})), HasSubstr("x in it is damaged"));
  one.crc_off = 0;
  one.size = 100;
  EXPECT_THAT(unpacked(test::zip_of({one})), HasSubstr("x in it is damaged"));
  one.size = 0xffffffff;
  EXPECT_THAT(unpacked(test::zip_of({one})), HasSubstr("x in it is damaged"));
  EXPECT_THROW(unzip(root_ / "none.zip", into_), InputError);
}

TEST_F(Unzip, DamageIsFoundWhereverItIs) {
  const std::string whole =
      test::zip_of({{"d/x", "some text, some text"}, {"y", "0123456789", false}});
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(unpacked(whole.substr(0, length)), "") << length << " bytes";
  std::ofstream(root_ / "beside") << "mine";
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string torn = whole;
      torn[at] = static_cast<char>(torn[at] ^ flip);
      unpacked(torn);  // refused, or of no consequence: a date, a permission, a letter of a name
      EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 3) << at;
    }
  EXPECT_EQ(read_file(root_ / "beside"), "mine");
}

}  // namespace
}  // namespace hyperex::io
