// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/mutate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <random>

namespace hyperex::fuzz {
namespace {

/// Numbers that readers trip over, and what may stand in the place of one.
constexpr std::array kWords{"nan",
                            "inf",
                            "-inf",
                            "1e308",
                            "1e-310",
                            "1e400",
                            "-1",
                            "0",
                            "-0",
                            "2147483648",
                            "4294967295",
                            "9223372036854775808",
                            "99999999999999999999999",
                            "1.5",
                            "0x10",
                            "",
                            "\"",
                            "true",
                            "1,5",
                            "[]",
                            "{}",
                            "null",
                            "\\u0000",
                            "\x1b[31m",
                            "\xff\xfe",
                            "\xef\xbb\xbf",
                            "%s%n",
                            "../../x",
                            "/dev/zero",
                            "\r",
                            "\n",
                            "\t",
                            "#",
                            "=",
                            ",",
                            ";"};
constexpr std::array<unsigned, 8> kIntegers{0,          1,          0x7f,       0xff,
                                            0x7fffffff, 0x80000000, 0xffffffff, 3};

class Mutator {
 public:
  Mutator(std::string text, std::uint64_t seed) : text_(std::move(text)), random_(seed) {}

  /// 0 to count - 1, alike with every standard library.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : std::size_t(random_() % count); }

  std::string mutate(const std::vector<std::string>& seeds) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t k = 0; k < changes; ++k) change(seeds);
    return std::move(text_);
  }

 private:
  void change(const std::vector<std::string>& seeds) {
    const std::size_t at = below(text_.size() + 1);
    const std::size_t some = std::min(text_.size() - at, 1 + below(40));
    switch (below(11)) {
      case 0:
        if (at < text_.size()) text_[at] = char(text_[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < text_.size()) text_[at] = char(below(256));
        break;
      case 2:
        text_.resize(at);
        break;
      case 3:
        text_.erase(at, some);
        break;
      case 4:
        text_.insert(at, text_.substr(at, some));
        break;
      case 5:
        text_.insert(at, kWords[below(kWords.size())]);
        break;
      case 6:
      case 7:
        replace_number(at);
        break;
      case 8:
        put_integer(at);
        break;
      case 9: {
        const std::string part = text_.substr(at, some);
        const std::size_t times = std::size_t(1) << below(13);
        std::string much;
        for (std::size_t k = 0; k < times; ++k) much += part;
        text_.insert(at, much);
        break;
      }
      default: {
        const std::string& other = seeds[below(seeds.size())];
        text_ = text_.substr(0, at) + other.substr(below(other.size() + 1));
      }
    }
  }

  /// The first number from `at` on.
  void replace_number(std::size_t at) {
    const auto is_part = [&](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-';
    };
    const auto begin = std::find_if(text_.begin() + long(at), text_.end(), is_part);
    const auto end = std::find_if_not(begin, text_.end(), is_part);
    const std::string word = kWords[below(kWords.size())];
    text_.replace(begin, end, word);
  }

  void put_integer(std::size_t at) {
    unsigned value = kIntegers[below(kIntegers.size())];
    for (std::size_t k = 0; k < 4 && at + k < text_.size(); ++k, value >>= 8)
      text_[at + k] = char(value & 0xff);
  }

  std::string text_;
  std::mt19937_64 random_;
};

}  // namespace

std::string mutated(const std::vector<std::string>& seeds, std::uint64_t number) {
  return Mutator(seeds[number % seeds.size()], number + 1).mutate(seeds);
}

}  // namespace hyperex::fuzz
