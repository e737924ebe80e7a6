// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/scan.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using nlohmann::json;
using testing::expect_refused;
using testing::sheet;
using Gltf = testing::FileTest;

/// A document with its one buffer.
struct Document {
  json root;
  std::string buffer;

  int view(const std::string& bytes) {
    while (buffer.size() % 4) buffer += '\0';
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  template <class T>
  int accessor(const std::vector<T>& values, int component, const char* type, int columns) {
    const int v = view({reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()});
    root["accessors"].push_back({{"bufferView", v},
                                 {"componentType", component},
                                 {"count", values.size() / columns},
                                 {"type", type}});
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  std::string glb() const {
    json with_length = root;
    with_length["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string text = with_length.dump(), bytes = buffer;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    const auto put = [&](std::size_t value) {
      const auto number = static_cast<std::uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&number), 4);
    };
    put(2);
    put(28 + text.size() + bytes.size());
    put(text.size());
    file += "JSON" + text;
    put(bytes.size());
    return file + std::string("BIN\0", 4) + bytes;
  }
};

/// The sheet, moved and turned by a node, in two primitives that share their vertices.
Document document(const TriMesh& mesh) {
  Document d;
  std::vector<float> xyz, uv;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    for (int k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(mesh.points(i, k)));
    uv.insert(uv.end(), {0.25f, i / 100.f});
  }
  std::vector<std::uint16_t> half[2];
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      half[2 * t >= mesh.triangles.rows()].push_back(
          static_cast<std::uint16_t>(mesh.triangles(t, k)));
  const int position = d.accessor(xyz, 5126, "VEC3", 3), st = d.accessor(uv, 5126, "VEC2", 2);
  json primitives;
  for (const auto& indices : half)
    primitives.push_back({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", st}}},
                          {"indices", d.accessor(indices, 5123, "SCALAR", 1)},
                          {"material", 0}});
  d.root["asset"] = {{"version", "2.0"}};
  d.root["meshes"] = {{{"primitives", primitives}}};
  d.root["images"] = {{{"bufferView", d.view(testing::png_bytes())}, {"mimeType", "image/png"}}};
  d.root["textures"] = {{{"source", 0}}};
  d.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  d.root["nodes"] = {{{"children", {1}}, {"translation", {1, 2, 3}}},
                     {{"mesh", 0}, {"rotation", {0, 0, 0.70710678118654752, 0.70710678118654752}}}};
  d.root["scenes"] = {{{"nodes", {0}}}};
  d.root["scene"] = 0;
  return d;
}

TEST_F(Gltf, NodesPrimitivesTextureAndUv) {
  const TriMesh mesh = sheet(5);
  const Scan scan = read_scan(write("a.glb", document(mesh).glb()));
  EXPECT_EQ(scan.unit, LengthUnit::metre);
  EXPECT_FALSE(scan.unit_guessed);
  EXPECT_EQ(scan.mesh.triangles, mesh.triangles);
  ASSERT_EQ(scan.mesh.points.rows(), mesh.points.rows());
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {  // a quarter turn about z, then the shift
    EXPECT_NEAR(scan.mesh.points(i, 0), 1 - mesh.points(i, 1), 1e-7);
    EXPECT_NEAR(scan.mesh.points(i, 1), 2 + mesh.points(i, 0), 1e-7);
    EXPECT_NEAR(scan.mesh.points(i, 2), 3 + mesh.points(i, 2), 1e-7);
  }
  ASSERT_EQ(scan.corner_uv.rows(), 3 * mesh.triangles.rows());
  for (Eigen::Index c = 0; c < scan.corner_uv.rows(); ++c)
    EXPECT_FLOAT_EQ(scan.corner_uv(c, 1), mesh.triangles(c / 3, c % 3) / 100.f);
  ASSERT_TRUE(scan.texture);
  EXPECT_EQ(scan.texture->mime_type, "image/png");
  EXPECT_EQ(scan.texture->bytes.size(), testing::png_bytes().size());
}

TEST_F(Gltf, MirroringNodeKeepsTheOutside) {
  const TriMesh mesh = sheet(2);
  Document d = document(mesh);
  d.root["nodes"][1] = {{"mesh", 0}, {"scale", {-1, 1, 1}}};
  const Scan scan = read_scan(write("m.glb", d.glb()));
  const auto normal_z = [](const TriMesh& m) {
    const Vec3 a = m.points.row(m.triangles(0, 0)), b = m.points.row(m.triangles(0, 1)),
               c = m.points.row(m.triangles(0, 2));
    return (b - a).cross(c - a).z();
  };
  EXPECT_GT(normal_z(mesh) * normal_z(scan.mesh), 0);
}

TEST_F(Gltf, TextFormWithBufferAndPictureBesideIt) {
  Document d = document(sheet(3));
  d.root["buffers"] = {{{"uri", "data.bin"}, {"byteLength", d.buffer.size()}}};
  d.root["images"] = {{{"uri", "skin.png"}}};
  const auto file = write("a.gltf", d.root.dump());
  expect_refused(file, "data.bin", [&] { read_scan(file); });
  write("data.bin", d.buffer);
  EXPECT_FALSE(read_scan(file).texture);  // missing: a warning
  write("skin.png", testing::png_bytes());
  const Scan scan = read_scan(file);
  ASSERT_TRUE(scan.texture);
  EXPECT_EQ(scan.texture->bytes.size(), testing::png_bytes().size());
  write("data.bin", d.buffer.substr(0, 100));
  EXPECT_THROW(read_scan(file), InputError);
}

TEST_F(Gltf, StripsFansAndVertexColours) {
  Document d = document(sheet(1));
  const int colour =
      d.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, .5f, .5f, .5f}, 5126, "VEC3", 3);
  auto& primitives = d.root["meshes"][0]["primitives"];
  primitives.erase(1);
  primitives[0]["attributes"]["COLOR_0"] = colour;
  primitives[0]["indices"] = d.accessor(std::vector<std::uint8_t>{0, 1, 2, 3}, 5121, "SCALAR", 1);
  for (const int mode : {5, 6}) {
    primitives[0]["mode"] = mode;
    const Scan scan = read_scan(write("s.glb", d.glb()));
    Triangles expected(2, 3);
    if (mode == 5)
      expected << 0, 1, 2, 1, 3, 2;
    else
      expected << 0, 1, 2, 0, 2, 3;
    EXPECT_EQ(scan.mesh.triangles, expected);
    ASSERT_EQ(scan.vertex_colour.rows(), 4);
    EXPECT_EQ(scan.vertex_colour(1, 1), 255);
    EXPECT_EQ(scan.vertex_colour(3, 0), 128);
    EXPECT_EQ(scan.vertex_colour(3, 3), 255);
  }
}

TEST_F(Gltf, RefusesEachFaultWithOneLine) {
  const auto refused = [&](const std::string& part, const auto& spoil) {
    Document d = document(sheet(3));
    spoil(d);
    const auto file = write("bad.glb", d.glb());
    expect_refused(file, part, [&] { read_scan(file); });
  };
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  refused("vertex 2 (counted from 0)",
          [&](Document& d) { std::memcpy(d.buffer.data() + 2 * 12 + 4, &nan, 4); });
  refused("of a primitive names vertex 60000; expected 0 to 15", [](Document& d) {
    const std::uint16_t wrong = 60000;
    const std::size_t at = d.root["bufferViews"][2]["byteOffset"];
    std::memcpy(d.buffer.data() + at, &wrong, 2);
  });
  refused("its buffer view is too short",
          [](Document& d) { d.root["accessors"][0]["count"] = 1000000000000; });
  refused("is too short: it has", [](Document& d) {
    d.root["bufferViews"][0]["byteLength"] = 4000000;
    d.root["accessors"][0]["count"] = 20;
  });
  refused("there is no accessor 99",
          [](Document& d) { d.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; });
  refused("is in the scene twice", [](Document& d) { d.root["nodes"][1]["children"] = {0}; });
  refused("names mesh 5", [](Document& d) { d.root["nodes"][1]["mesh"] = 5; });
  refused("names node 7", [](Document& d) { d.root["nodes"][0]["children"] = {7}; });
  refused("KHR_draco_mesh_compression",
          [](Document& d) { d.root["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
  refused("has no vertices", [](Document& d) { d.root["nodes"][1].erase("mesh"); });
  refused("has no vertices", [](Document& d) {
    for (auto& primitive : d.root["meshes"][0]["primitives"]) primitive["mode"] = 0;
  });
  refused("there is no buffer 3", [](Document& d) { d.root["bufferViews"][0]["buffer"] = 3; });
  refused("sparse or empty", [](Document& d) { d.root["accessors"][0].erase("bufferView"); });
  refused("texture 4, which is not there", [](Document& d) {
    d.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 4;
  });
  const auto text = write("bad.gltf", "{\"asset\": {\"version\": ");
  expect_refused(text, "is no sound glTF file", [&] { read_scan(text); });
}

TEST_F(Gltf, MillimetresInPlaceOfMetresAreRefusedWithTheUnitThatFits) {
  TriMesh mesh = sheet(3);
  mesh.points *= 1000;
  const auto file = write("mm.glb", document(mesh).glb());
  expect_refused(file,
                 "in metres, glTF's unit; expected a face, 8 to 45 cm: the unit \"mm\" would fit",
                 [&] { read_scan(file); });
  EXPECT_EQ(read_scan(file, LengthUnit::millimetre).unit, LengthUnit::millimetre);
}

TEST_F(Gltf, TornAnywhereIsRefused) {
  const std::string bytes = document(sheet(3)).glb();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto file = write("torn.glb", bytes.substr(0, length));
    EXPECT_THROW(read_scan(file), InputError) << length << " of " << bytes.size();
  }
}

TEST_F(Gltf, FlippedBytesNeverCrash) {
  const std::string bytes = document(sheet(1)).glb();
  testing::read_flipped(bytes, {0xff, 0x80, 0x01, 0x04}, [&](const std::string& changed) {
    read_scan(write("flipped.glb", changed));
  });
}

/// The sheet's second half with two targets, one of them sparse, and a landmark.
Document shaped(const TriMesh& mesh) {
  Document d = document(mesh);
  auto& moved = d.root["meshes"][0];
  std::vector<float> dense(std::size_t(mesh.points.size()));
  for (std::size_t i = 0; i < dense.size(); i += 3) dense[i] = 0.001f * float(i + 3);
  const int all = d.accessor(dense, 5126, "VEC3", 3);
  const int rows = d.view(std::string("\x01\x00\x04\x00", 4));
  const float values[] = {0, 0.002f, 0, 0, 0, 0.003f};
  const int listed = d.view({reinterpret_cast<const char*>(values), sizeof values});
  d.root["accessors"].push_back({{"componentType", 5126},
                                 {"count", mesh.points.rows()},
                                 {"type", "VEC3"},
                                 {"sparse",
                                  {{"count", 2},
                                   {"indices", {{"bufferView", rows}, {"componentType", 5123}}},
                                   {"values", {{"bufferView", listed}}}}}});
  const int few = all + 1;
  moved["primitives"][1]["targets"] = {{{"POSITION", all}}, {{"POSITION", few}}};
  moved["extras"] = {{"targetNames", {"jawOpen", "mouthLeft"}},
                     {"landmarks_m", {{"pronasale", {0.5, 0.25, 0.125}}}}};
  return d;
}

TEST_F(Gltf, ShapesOfARigSparseOnesToo) {
  const TriMesh mesh = sheet(3);
  const ShapedMesh rig = read_gltf_shapes(write("rig.glb", shaped(mesh).glb()));
  EXPECT_EQ(rig.mesh.triangles.rows(), mesh.triangles.rows() / 2) << "the primitive with targets";
  ASSERT_EQ(rig.shapes.size(), 2u);
  EXPECT_EQ(rig.shapes[0].name, "jawOpen");
  EXPECT_EQ(rig.shapes[1].name, "mouthLeft");
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    // The node turns x to y and y to -x; a displacement is not shifted.
    EXPECT_NEAR(rig.shapes[0].displacement_m(v, 1), 0.003 * double(v + 1), 1e-6) << v;
    EXPECT_NEAR(rig.shapes[0].displacement_m(v, 0), 0, 1e-6) << v;
    const Vec3 few = v == 1 ? Vec3(-0.002, 0, 0) : v == 4 ? Vec3(0, 0, 0.003) : Vec3(0, 0, 0);
    EXPECT_LT((rig.shapes[1].displacement_m.row(v).cast<double>().transpose() - few).norm(), 1e-6)
        << v;
  }
  ASSERT_EQ(rig.landmarks.size(), 1u);
  EXPECT_LT((rig.landmarks.at("pronasale") - Vec3(1 - 0.25, 2 + 0.5, 3 + 0.125)).norm(), 1e-6);
}

TEST_F(Gltf, ShapesThatAreFaultyAreRefusedInOneLine) {
  const auto refused = [&](const std::string& part, const auto& spoil) {
    Document d = shaped(sheet(3));
    spoil(d);
    const auto file = write("bad.glb", d.glb());
    expect_refused(file, part, [&] { read_gltf_shapes(file); });
  };
  const auto sparse = [](Document& d) -> json& { return d.root["accessors"].back(); };
  refused("no mesh with named morph targets",
          [](Document& d) { d.root["meshes"][0].erase("extras"); });
  refused("has 3 items; expected 16", [&](Document& d) { sparse(d)["count"] = 3; });
  refused("lists 17 of its 16 items", [&](Document& d) { sparse(d)["sparse"]["count"] = 17; });
  refused("its buffer view is too short", [&](Document& d) { sparse(d)["sparse"]["count"] = 3; });
  refused("lists item 516; expected 0 to 15", [&](Document& d) {
    const std::size_t view = sparse(d)["sparse"]["indices"]["bufferView"];
    d.buffer[std::size_t(d.root["bufferViews"][view]["byteOffset"]) + 3] = 2;
  });
  refused("there is no buffer view 99",
          [&](Document& d) { sparse(d)["sparse"]["values"]["bufferView"] = 99; });
  refused("jawOpen has a number that is not finite", [&](Document& d) {
    const auto nan = std::numeric_limits<float>::quiet_NaN();
    const std::size_t accessor = d.root["accessors"].size() - 2;
    const std::size_t view = d.root["accessors"][accessor]["bufferView"];
    std::memcpy(d.buffer.data() + std::size_t(d.root["bufferViews"][view]["byteOffset"]), &nan, 4);
  });
  refused("three numbers", [](Document& d) {
    d.root["meshes"][0]["extras"]["landmarks_m"]["nose"] = {1, 2};
  });
  testing::read_flipped(
      shaped(sheet(1)).glb(), {0xff, 0x80, 0x01},
      [&](const std::string& changed) { read_gltf_shapes(write("flipped.glb", changed)); });
}

}  // namespace
}  // namespace hyperex::io
