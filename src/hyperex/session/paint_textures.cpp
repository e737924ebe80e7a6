// SPDX-License-Identifier: GPL-3.0-or-later
// Runs while the program is built: paints the embedded face's textures, which the program then
// carries. Painting one takes 0.3 s, which no run should spend.
//   paint_textures LIGHT.jpg MEDIUM.jpg DARK.jpg
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "hyperex/capture/encode.hpp"
#include "hyperex/face/complexion.hpp"

namespace {

void write_texture(hyperex::face::SkinTone tone, const char* file) {
  const hyperex::face::SkinPicture& skin = hyperex::face::painted_skin(tone);
  const auto bytes = hyperex::capture::jpeg_bytes(skin.rgb, skin.size_px, skin.size_px);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!out.flush()) throw std::runtime_error(std::string(file) + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  constexpr auto tones = hyperex::face::words_of(hyperex::face::SkinTone{});
  try {
    if (argc != 1 + int(tones.size())) throw std::invalid_argument("one file for each tone");
    for (std::size_t i = 0; i < tones.size(); ++i) write_texture(tones[i].value, argv[1 + i]);
  } catch (const std::exception& error) {
    std::cerr << "paint_textures: " << error.what() << '\n';
    return 1;
  }
}
