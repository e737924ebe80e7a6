// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a scan names: those beside it, and no others of the machine.
#include <sys/stat.h>

#include "hyperex/core/files.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/io/scan.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using testing::png_bytes;
namespace fs = std::filesystem;

class NamedFiles : public testing::FileTest {
 protected:
  void SetUp() override {
    for (const char* folder : {"scan", "scan/textures", "elsewhere", "scan-2"})
      fs::create_directory(path(folder));
    for (const char* name :
         {"scan/face.png", "scan/textures/face.png", "elsewhere/secret.png", "scan-2/secret.png"})
      write(name, png_bytes());
    fs::create_symlink(path("elsewhere/secret.png"), path("scan/link.png"));
    fs::create_symlink("textures", path("scan/own"));
    ASSERT_EQ(::mkfifo(path("scan/pipe").c_str(), 0600), 0);
  }

  /// What a scan may not name; an absolute path, one upwards, a link, a pipe, devices.
  std::vector<std::string> forbidden() const {
    return {path("elsewhere/secret.png").string(),
            "../elsewhere/secret.png",
            "../scan-2/secret.png",
            "link.png",
            "pipe",
            "/dev/zero",
            "/dev/stdin",
            "textures"};
  }

  /// Whether the scan of `name` has a texture.
  bool has_texture(const std::string& name, const std::string& text) const {
    return read_scan(write("scan/" + name, text)).texture.has_value();
  }
};

std::string ply(const std::string& texture) {
  return "ply\nformat ascii 1.0\ncomment TextureFile " + texture +
         "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "property float s\nproperty float t\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n"
         "0 0 0 0 0\n150 0 0 1 0\n0 150 0 0 1\n3 0 1 2\n";
}

std::string obj(const std::string& library) {
  return "mtllib " + library +
         "\nusemtl a\nv 0 0 0\nv 150 0 0\nv 0 150 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
}

std::string gltf_with_files(const std::string& picture, const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[)"
         R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         buffer +
         R"("}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
         R"("textures":[{"source":0}],"images":[{"uri":")" +
         picture + "\"}]}";
}

TEST_F(NamedFiles, AreRememberedForWhoAsks) {
  const hyperex::NamedFiles asked;
  named_file(path("scan"), "face.png");
  EXPECT_THROW(named_file(path("scan"), "gone.png"), InputError);
  EXPECT_EQ(asked.requested(),
            (std::vector<fs::path>{path("scan") / "face.png", path("scan") / "gone.png"}));
}

TEST_F(NamedFiles, LieInTheFolderOrBelow) {
  EXPECT_EQ(named_file(path("scan"), "face.png"), path("scan/face.png"));
  EXPECT_EQ(named_file(path("scan"), "own/face.png"), path("scan/own/face.png"));
  EXPECT_EQ(named_file(path("scan"), path("scan/face.png").string()), path("scan/face.png"));
  for (const std::string& name : forbidden())
    expect_refused(path("scan") / name, "expected", [&] { named_file(path("scan"), name); });
  expect_refused(path("scan/none"), "no such file", [&] { named_file(path("scan"), "none"); });
}

TEST_F(NamedFiles, ATextureOfAPly) {
  EXPECT_TRUE(has_texture("a.ply", ply("face.png")));
  EXPECT_TRUE(has_texture("a.ply", ply("textures\\face.png")));
  for (const std::string& name : forbidden()) EXPECT_FALSE(has_texture("a.ply", ply(name))) << name;
}

TEST_F(NamedFiles, MaterialsAndTextureOfAnObj) {
  write("scan/good.mtl", "newmtl a\nmap_Kd face.png\n");
  EXPECT_TRUE(has_texture("a.obj", obj("good.mtl")));
  write("elsewhere/good.mtl", "newmtl a\nmap_Kd face.png\n");
  for (const std::string& name :
       {path("elsewhere/good.mtl").string(), std::string("../elsewhere/good.mtl"),
        std::string("pipe"), std::string("/dev/zero"), std::string("../../../../../dev/zero")})
    EXPECT_FALSE(has_texture("a.obj", obj(name))) << name;
  for (const std::string& name : forbidden()) {
    write("scan/bad.mtl", "newmtl a\nmap_Kd " + name + "\n");
    EXPECT_FALSE(has_texture("a.obj", obj("bad.mtl"))) << name;
  }
}

TEST_F(NamedFiles, BuffersAndPicturesOfAGltf) {
  const float corners[9] = {0, 0, 0, 0.15f, 0, 0, 0, 0.15f, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  write("scan/good.bin", bytes);
  write("elsewhere/good.bin", bytes);
  EXPECT_TRUE(has_texture("a.gltf", gltf_with_files("face.png", "good.bin")));
  for (const std::string& name : forbidden())
    EXPECT_FALSE(has_texture("a.gltf", gltf_with_files(name, "good.bin"))) << name;
  for (const char* name : {"../elsewhere/good.bin", "pipe", "/dev/zero"}) {
    const auto file = write("scan/b.gltf", gltf_with_files("face.png", name));
    expect_refused(file, "no sound glTF", [&] { read_scan(file); });
  }
}

TEST_F(NamedFiles, ADeviceIsNoInputAndAPipeIsReadToItsEnd) {
  expect_refused("/dev/zero", "is a device", [] { read_file("/dev/zero"); });
  expect_refused(path("scan/pipe"), "pipe", [&] { read_regular_file(path("scan/pipe")); });
  const std::string command = "echo through > '" + path("scan/pipe").string() + "' &";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_file(path("scan/pipe")), "through\n");
}

}  // namespace
}  // namespace hyperex::io
