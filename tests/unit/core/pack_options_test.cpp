// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/pack_options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "support/test_file.hpp"

namespace hyperex {
namespace {

enum class Kind { one, other };

struct Part {
  std::string name;
  std::optional<double> depth_m;
  static constexpr const char* about = "A part.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(name), "Its name.");
    v.option(HX_MEMBER(depth_m), "Its depth.");
  }
};

struct Whole {
  double size_m = 1;
  int layers = 2;
  bool mirror = false;
  Kind kind = Kind::one;
  std::filesystem::path painted;
  std::vector<Part> parts{{"a", 1.0}, {"b", {}}};
  std::vector<std::string> points;
  bool all = false;
  static constexpr const char* about = "A whole.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(size_m), "Its size.");
    v.option(HX_MEMBER(layers), "Its layers.");
    v.option(HX_MEMBER(mirror), "Whether it is mirrored.");
    v.option(HX_MEMBER(kind), "Its kind.");
    v.option(HX_MEMBER(painted), "A file.");
    v.option(HX_MEMBER(parts), "Its parts.");
    v.one_or_all(HX_MEMBER(points), HX_MEMBER(all), "Its points.");
  }
};

std::string packed(const Whole& whole) {
  Packer bytes;
  pack_options(whole, bytes);
  return bytes.bytes();
}

TEST(PackOptions, EveryOptionCounts) {
  const std::vector<std::function<void(Whole&)>> changes = {
      [](Whole& w) { w.size_m = 2; },           [](Whole& w) { w.layers = 3; },
      [](Whole& w) { w.mirror = true; },        [](Whole& w) { w.kind = Kind::other; },
      [](Whole& w) { w.parts[1].name = "c"; },  [](Whole& w) { w.parts[0].depth_m = 2; },
      [](Whole& w) { w.parts[1].depth_m = 0; }, [](Whole& w) { w.parts.pop_back(); },
      [](Whole& w) { w.points = {"chin"}; },    [](Whole& w) { w.all = true; },
  };
  EXPECT_EQ(packed({}), packed({}));
  std::vector<std::string> all = {packed({})};
  for (const auto& change : changes) {
    Whole whole;
    change(whole);
    all.push_back(packed(whole));
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

TEST(PackOptions, AFileCountsByItsContent) {
  const TestFolder folder;
  const auto with = [&](const char* name, const char* content) {
    Whole whole;
    whole.painted = std::filesystem::path(folder) / name;
    std::ofstream(whole.painted) << content;
    return packed(whole);
  };
  EXPECT_EQ(with("a.csv", "1\n"), with("b.csv", "1\n"));
  EXPECT_NE(with("a.csv", "1\n"), with("a.csv", "2\n"));
}

}  // namespace
}  // namespace hyperex
