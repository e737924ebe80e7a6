// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/seeds.hpp"

#include <png.h>
#include <turbojpeg.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace hyperex::fuzz {
namespace {

/// The bytes of a number, in reverse order where `turned` is set.
template <class T>
std::string bytes_of(T value, bool turned = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return turned ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

constexpr std::array<std::array<float, 3>, 4> kCorners{
    {{0, 0, 0}, {150, 0, 0}, {150, 160, 20}, {0, 160, 0}}};

std::string ply_header(const std::string& format, const std::string& more) {
  return "ply\nformat " + format +
         " 1.0\ncomment TextureFile none.png\nelement vertex 4\nproperty float x\n"
         "property float y\nproperty float z\n" +
         more + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binary_ply(bool big) {
  std::string text = ply_header(big ? "binary_big_endian" : "binary_little_endian",
                                "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  for (const auto& corner : kCorners) {
    for (const float x : corner) text += bytes_of(x, big);
    text += "\xff\x10\x20";
  }
  text += '\4';
  for (const std::int32_t i : {0, 1, 2, 3}) text += bytes_of(i, big);
  return text;
}

std::string gltf_json(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],)"
         R"("translation":[0,0.1,0],"rotation":[0,0,0,1],"scale":[1,1,1]},{"mesh":0}],"meshes":[)"
         R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0,)"
         R"("mode":4}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"bufferViews":[)"
         R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[)" +
         buffer +
         R"(],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
         R"("textures":[{"source":0}],"images":[{"uri":"none.png"}]})";
}

/// Three corners, metres, and their indices: 42 bytes.
std::string triangle_bytes() {
  std::string bytes;
  for (const float x : {0.f, 0.f, 0.f, 0.15f, 0.f, 0.f, 0.15f, 0.16f, 0.02f}) bytes += bytes_of(x);
  for (const std::uint16_t i : {0, 1, 2}) bytes += bytes_of(i);
  return bytes;
}

/// Base64 of bytes whose number is a multiple of three.
std::string base64(const std::string& bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) text += letters[three >> shift & 63];
  }
  return text;
}

std::string png(bool deep) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = 4;
  image.format = deep ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_RGB;
  std::array<std::uint16_t, 64> pixels{};
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = std::uint16_t(1000 * i);
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr))
    throw std::logic_error("a PNG could not be made");
  return bytes;
}

std::string jpeg() {
  std::array<unsigned char, 48> pixels{};
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<unsigned char>(5 * i);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjhandle coder = tjInitCompress();
  const int failed =
      tjCompress2(coder, pixels.data(), 4, 0, 4, TJPF_BGR, &bytes, &size, TJSAMP_444, 80, 0);
  std::string out(reinterpret_cast<char*>(bytes), failed ? 0 : size);
  tjFree(bytes);
  tjDestroy(coder);
  if (failed) throw std::logic_error("a JPEG could not be made");
  return out;
}

}  // namespace

Seeds ply_seeds() {
  return {ply_header("ascii", "property float s\nproperty float t\nproperty float young_kpa\n") +
              "0 0 0 0 0 1\n150 0 0 1 0 2\n150 160 20 1 1 3\n0 160 0 0 1 nan\n4 0 1 2 3\n",
          binary_ply(false), binary_ply(true)};
}

Seeds obj_seeds() {
  return {
      "# a comment\nmtllib none.mtl\nusemtl skin\nv 0 0 0\nv 150 0 0\nv 150 160 20\nv 0 160 0\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf -4//1 -2//1 -1//1\n",
      "v 0 0 0 1 0 0\nv 150 0 0 0 1 0\nv 150 160 20 0 0 1\nf 1 2 3\n"};
}

Seeds stl_seeds() {
  std::string binary(80, ' ');
  binary += bytes_of(std::uint32_t(2));
  for (const std::array<int, 3>& facet : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    for (const float x : {0.f, 0.f, 1.f}) binary += bytes_of(x);
    for (const int corner : facet)
      for (const float x : kCorners[std::size_t(corner)]) binary += bytes_of(x);
    binary += std::string(2, '\0');
  }
  return {
      "solid face\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 150 0 0\n"
      "vertex 150 160 20\nendloop\nendfacet\nendsolid face\n",
      binary};
}

Seeds gltf_seeds() {
  return {gltf_json("{\"byteLength\":42,\"uri\":\"data:application/octet-stream;base64," +
                    base64(triangle_bytes()) + "\"}"),
          gltf_json(R"({"byteLength":42,"uri":"beside.bin"})")};
}

/// The two parts of a binary glTF file.
std::string glb_of(std::string json, std::string body) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  body.resize((body.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t n) { return bytes_of(std::uint32_t(n)); };
  return "glTF" + word(2) + word(28 + json.size() + body.size()) + word(json.size()) + "JSON" +
         json + word(body.size()) + std::string("BIN\0", 4) + body;
}

Seeds glb_seeds() {
  return {glb_of(gltf_json(R"({"byteLength":42})"), triangle_bytes())};
}

/// The triangle with a sparse morph target and a landmark.
Seeds rig_seeds() {
  const std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{)"
      R"("primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":2},)"
      R"({"POSITION":0}]}],"extras":{"targetNames":["jawOpen","mouthLeft"],)"
      R"("landmarks_m":{"nasion":[0,0.1,0]}}}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},)"
      R"({"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{)"
      R"("bufferView":1,"byteOffset":2,"componentType":5123},"values":{"bufferView":0}}}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,)"
      R"("byteLength":6}],"buffers":[{"byteLength":42}]})";
  return {glb_of(json, triangle_bytes())};
}

Seeds landmark_seeds() {
  return {R"({"units": "mm", "points": {"nose": [1, 2.5, -3e1], "mole, left": [0, 0, 0]}})",
          "{\"points\": {\"ibug68_0\": [0.1, 0.2, 0.3]},\n \"units\": \"m\"}"};
}

Seeds markup_seeds() {
  return {R"({"@schema": "https://x/markups-schema-v1.0.3.json#", "markups": [{"type": "Fiducial",)"
          R"("coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": [{"id": "1",)"
          R"("label": "nose", "position": [1, 2, 3], "positionStatus": "defined"},)"
          R"({"label": "chin", "position": [1, -60, 3]}]}]})"};
}

Seeds csv_seeds() {
  return {
      "time_s,nose_x_mm,nose_y_mm,nose_z_mm,chin_x_mm,chin_y_mm,chin_z_mm\n"
      "0,0,0,0,0,-80,0\n0.1,0,0,0,0,-85,1\n0.2,nan,,0,0,-85.5,1e0\n",
      "# comment\r\ntime;x0;y0;z0;\"x1\";y1;z1\r\n0;0;0;0;0.1;0;0\r\n1;0;0;0;0.1;0.05;0\r\n"};
}

Seeds trc_seeds() {
  return {
      "PathFileType\t4\t(X/Y/Z)\tin.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
      "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n60\t60\t2\t2\tmm\t60\t1\t2\n"
      "Frame#\tTime\tnose\t\t\tchin\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
      "1\t0\t0\t0\t0\t0\t-80\t0\n2\t0.0167\t0\t0\t0\t\t\t\n"};
}

Seeds scene_seeds() {
  return {
      "title = \"a scene\"\nscan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
      "[mesh]\nelement_size_mm = 4.5\nlayers = 2\n[tissue]\nyoung_kpa = 1.9e2\nmirror = true\n"
      "[[tissue.region]]\nname = \"cheek_R\"\nyoung_factor = 5\n"
      "[drive]\npoints = [\"ibug68_48\", \"ibug68_54\"]\n[[variant]]\nname = \"stiff\"\n"
      "tissue = { young_kpa = 400, density_kg_m3 = 1_000 }\n",
      "scan.file = \"embedded\"\nmotion.file = \"embedded\"\nanatomy = { ct = \"ct\" }\n"
      "[[variant]]\nname = \"v\"\nbone = [{ part = \"mandible\", cut = \"bsso\", "
      "move_mm = [0, 1.5, 6], turn_deg = [-2, 0, 1], cut_shift_mm = 3 }]\n"
      "tissue.region = [{ name = \"cheek_R\", volume_ml = 2 }]\n",
      "scan.file = 'embedded'\nmotion.file = \"\"\"embedded\"\"\"\noutput.vtu = false\n"
      "output.picture_times_s = [0.1, 0.2]\ntime.end_s = 1 # s\n"};
}

Seeds camera_seeds() {
  return {
      "width = 640\nheight = 480\nfx = 525.0\nfy = 525.0\ncx = 319.5\ncy = 239.5\n"
      "depth_scale = 5000\nfps = 30\nk1 = 0.0\n"};
}

Seeds list_seeds() {
  return {"# timestamp filename\n0.0 rgb/0.png\n0.033 rgb/1.png\n0.066 rgb/2.png\n",
          "0.0 rgb/0.png 0.001 depth/0.png\n0.033 rgb/1.png 0.034 depth/1.png\n"};
}

Seeds candide_seeds() {
  return {
      "# VERTEX LIST:\n3\n0 0 0\n1 0 0\n0 1 0\n\n# FACE LIST:\n1\n0 1 2\n\n"
      "# ANIMATION UNITS LIST:\n1\n# jaw\n1\n2 0 0.1 0\n\n# SHAPE UNITS LIST:\n1\n# head\n1\n"
      "1 0.1 0 0\n\n# ANIMATION PARAMETERS:\n0\n\n# SHAPE PARAMETERS:\n0\n\n# END OF FILE\n"};
}

Seeds picture_seeds() {
  return {png(false), png(true), jpeg()};
}

}  // namespace hyperex::fuzz
