// SPDX-License-Identifier: GPL-3.0-or-later
// write_seeds FOLDER: the sound inputs of each reader, FOLDER/READER/0 and so on.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "fuzz/readers.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "write_seeds FOLDER\n";
    return 2;
  }
  for (const auto& reader : hyperex::fuzz::readers()) {
    const auto folder = std::filesystem::path(argv[1]) / reader.name;
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < reader.seeds.size(); ++i)
      std::ofstream(folder / std::to_string(i), std::ios::binary) << reader.seeds[i];
  }
}
