// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/text_file.hpp"

#include <fmt/format.h>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {
using namespace std::string_view_literals;

struct FileKind {
  std::string_view head;
  const char* words;
  const char* advice;
};

constexpr const char* kExportAdvice = ": export the table as CSV";

// The first bytes that each format prescribes.
constexpr FileKind kKinds[] = {
    {"%PDF"sv, "a PDF", ""},
    {"PK\x03\x04"sv, "an archive (ZIP), as spreadsheets are (.xlsx, .ods)", kExportAdvice},
    {"\xD0\xCF\x11\xE0"sv, "a file of an office program (.xls, .doc)", kExportAdvice},
    {"\x89PNG"sv, "a picture (PNG)", ""},
    {"\xFF\xD8\xFF"sv, "a picture (JPEG)", ""},
    {"\x1F\x8B"sv, "a compressed file (gzip)", ": unpack it"},
    {"\xFF\xFE"sv, "text in UTF-16", ": save it in UTF-8"},
    {"\xFE\xFF"sv, "text in UTF-16", ": save it in UTF-8"},
};

}  // namespace

void refuse_other_than_text(const std::filesystem::path& file, std::string_view bytes) {
  constexpr std::size_t head = 4096;
  for (const FileKind& kind : kKinds)
    if (bytes.starts_with(kind.head))
      throw InputError(file, fmt::format("is {}, not a table of text{}", kind.words, kind.advice));
  if (bytes.substr(0, head).find('\0') != std::string_view::npos)
    throw InputError(file, "is a binary file, not a table of text");
}

}  // namespace hyperex::io
