// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/nesting.hpp"

#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;

constexpr int kDeep = 100000;

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int k = 0; k < times; ++k) text += part;
  return text;
}
std::string list(int depth) {
  return repeated("[", depth) + repeated("]", depth);
}

TEST(Nesting, CountsOpenBracketsOutsideOfStrings) {
  EXPECT_EQ(line_nested_too_deep_json(list(most_nested)), 0);
  EXPECT_EQ(line_nested_too_deep_json("\n\n" + list(most_nested + 1)), 3);
  EXPECT_EQ(line_nested_too_deep_json("[\"" + list(kDeep) + "\\\"" + list(kDeep) + "\"]"), 0);
  EXPECT_EQ(line_nested_too_deep_json("[" + repeated("[1],", kDeep) + "2]"), 0);
  EXPECT_EQ(line_nested_too_deep_toml("a = " + list(most_nested)), 0);
  EXPECT_EQ(line_nested_too_deep_toml("b = 1\na = " + list(most_nested + 1)), 2);
  EXPECT_EQ(line_nested_too_deep_toml("# " + list(kDeep) + "\na = '" + list(kDeep) + "'"), 0);
  EXPECT_EQ(line_nested_too_deep_toml("a = \"\"\"\n\"" + list(kDeep) + "\"\"\"\n"), 0);
}

TEST(Nesting, CountsThePartsOfDottedKeys) {
  EXPECT_EQ(line_nested_too_deep_toml("a" + repeated(".a", most_nested - 1) + " = 1"), 0);
  EXPECT_EQ(line_nested_too_deep_toml("a" + repeated(".a", most_nested) + " = 1"), 1);
  EXPECT_EQ(line_nested_too_deep_toml("[a" + repeated(" . \"a\"", most_nested) + "]"), 1);
  EXPECT_EQ(line_nested_too_deep_toml("a = [" + repeated("1.5, ", 1000) + "1.5]"), 0);
  EXPECT_EQ(line_nested_too_deep_toml(repeated("a.b = 1.5\n", 1000)), 0);
}

class DeepFiles : public testing::FileTest {};

TEST_F(DeepFiles, LandmarksAreRefused) {
  for (const std::string& text :
       {list(kDeep), R"({"units":"mm","points":{"a":)" + list(kDeep) + "}}",
        R"({"points":{"a":[1,2,3]},"units":)" + list(kDeep) + "}",
        R"({"units":"mm","points":)" + repeated("{\"a\":", kDeep) + "1" + repeated("}", kDeep) +
            "}",
        R"({"markups":[{"coordinateSystem":)" + list(kDeep) + "}]}"}) {
    const auto file = write("deep.json", text);
    expect_refused(file, "nested deeper than", [&] { read_landmarks(file); });
  }
}

/// Three vertices; `more` stands behind the last key, `nodes` is the list of them.
std::string gltf(const std::string& more, const std::string& nodes = R"([{"mesh":0}])") {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         std::string(48, 'A') + "\"}]" + more + "}";
}

TEST_F(DeepFiles, GltfIsRefusedAsTextAndBinary) {
  const std::string extras = gltf(",\"extras\":" + list(kDeep));
  const auto text = write("deep.gltf", extras);
  expect_refused(text, "nested deeper than", [&] { read_scan(text); });

  const auto word = [](std::size_t n) {
    std::string bytes(4, '\0');
    for (int k = 0; k < 4; ++k) bytes[k] = char(n >> 8 * k);
    return bytes;
  };
  const auto binary = write("deep.glb", "glTF" + word(2) + word(20 + extras.size()) +
                                            word(extras.size()) + "JSON" + extras);
  expect_refused(binary, "nested deeper than", [&] { read_scan(binary); });
}

TEST_F(DeepFiles, AChainOfNodesIsRefused) {
  std::string nodes = "[";
  for (int n = 1; n < kDeep; ++n) nodes += "{\"children\":[" + std::to_string(n) + "]},";
  const auto file = write("chain.gltf", gltf("", nodes + "{\"mesh\":0}]"));
  expect_refused(file, "nodes are nested deeper than", [&] { read_scan(file); });
}

}  // namespace
}  // namespace hyperex::io
