// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Every reader of a file that a user may hand in, under one name and signature: for the fuzzer
// (target.cpp) and for mutated inputs (mutated_test.cpp).
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hyperex::fuzz {

struct Reader {
  std::string name;                                        ///< "ply"
  std::string file;                                        ///< as the input is called: "in.ply"
  std::function<void(const std::filesystem::path&)> read;  ///< may throw InputError, nothing else
  std::vector<std::string> seeds;                          ///< sound inputs, small
};

const std::vector<Reader>& readers();
/// Throws std::out_of_range where there is none of that name.
const Reader& reader(const std::string& name);

/// What is wrong with the sentences of an InputError: empty, more than 25 lines, a line of more
/// than 1,000 characters, a control character. Empty where nothing is.
std::string fault_of_message(const std::string& message);

/// Writes `bytes` to `folder` / reader.file and reads it. Whether the reader took it; throws
/// std::logic_error where its message has a fault, and what else the reader threw.
bool try_input(const Reader& reader, const std::filesystem::path& folder, const std::string& bytes);

}  // namespace hyperex::fuzz
