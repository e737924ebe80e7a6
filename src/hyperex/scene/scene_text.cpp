// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/scene_text.hpp"

#include <algorithm>
#include <optional>

#include "hyperex/core/error.hpp"
#include "hyperex/io/toml.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::scene {
namespace {

using nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool begins(const std::string& line, const char* with) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at != std::string::npos && line.compare(at, std::string(with).size(), with) == 0;
}

bool blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

/// Lines [first, last) of the i-th [[variant]], with its sub-tables. Comments and blank lines
/// before the next header belong to that header.
struct Stretch {
  std::size_t first, last;
};
std::vector<Stretch> variant_lines(const std::vector<std::string>& lines) {
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!begins(lines[i], "[[variant]]")) continue;
    std::size_t end = i + 1;
    while (end < lines.size() && (!begins(lines[end], "[") || begins(lines[end], "[variant.") ||
                                  begins(lines[end], "[[variant.")))
      ++end;
    if (end < lines.size())
      while (end > i + 1 && (blank(lines[end - 1]) || begins(lines[end - 1], "#"))) --end;
    out.push_back({i, end});
  }
  return out;
}

/// The name of a key, in quotes where it needs them.
std::string key_text(const std::string& name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return bare ? name : toml_text(name);
}

void add_values(const json& table, const std::string& before, std::string& text) {
  for (const auto& [name, value] : table.items())
    text += before + key_text(name) + " = " + toml_text(value) + "\n";
}

std::string variant_text(const json& block) {
  std::string text = "[[variant]]\n";
  if (block.contains("name")) text += "name = " + toml_text(block["name"]) + "\n";
  for (const auto& [name, value] : block.items()) {
    if (name == "name") continue;
    if (value.is_object())
      add_values(value, key_text(name) + ".", text);
    else
      text += key_text(name) + " = " + toml_text(value) + "\n";
  }
  return text;
}

/// The table of a dotted name; null where there is none.
const toml::table* table_at(const toml::table& root, const std::string& section) {
  return section.empty() ? &root : root[section].as_table();
}

std::optional<std::size_t> offset_of(const std::vector<std::string>& lines,
                                     const toml::source_position& at) {
  std::size_t offset = 0;
  if (at.line == 0 || at.line > lines.size() + 1) return std::nullopt;
  for (std::size_t i = 0; i + 1 < at.line; ++i) offset += lines[i].size() + 1;
  // A column counts code points, not bytes.
  const std::string& line = at.line <= lines.size() ? lines[at.line - 1] : lines.back();
  std::size_t byte = 0;
  for (unsigned column = 1; column < at.column && byte < line.size(); ++column) {
    ++byte;
    while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U) ++byte;
  }
  return offset + byte;
}

/// `root` with the change.
json changed(json root, const std::string& section, const std::string& name, const json& value) {
  json& table = section.empty() ? root : root[section];
  if (!table.is_object()) table = json::object();
  if (value.is_null())
    table.erase(name);
  else
    table[name] = value;
  if (!section.empty() && table.empty()) root.erase(section);
  return root;
}

/// Edits one place of the text; nothing where the layout is not one of those handled here.
std::optional<std::string> edited(const std::string& text, const std::string& section,
                                  const std::string& name, const json& value) {
  std::vector<std::string> lines = lines_of(text);
  const toml::table root = toml::parse(text);
  const toml::table* table = table_at(root, section);
  const toml::node* node = table ? table->get(name) : nullptr;
  if (node) {
    const toml::source_region& at = node->source();
    if (value.is_null()) {
      // Only where the key has its lines to itself.
      std::size_t first = at.begin.line - 1;
      const std::size_t last = at.end.line;
      const std::string& line = lines.at(first);
      const std::string begin = line.substr(0, line.find('='));
      if (begin.find(name) == std::string::npos || begin.find('{') != std::string::npos)
        return std::nullopt;
      lines.erase(lines.begin() + std::ptrdiff_t(first), lines.begin() + std::ptrdiff_t(last));
      return joined(lines);
    }
    const auto from = offset_of(lines, at.begin), to = offset_of(lines, at.end);
    if (!from || !to || *to <= *from) return std::nullopt;
    std::string whole = joined(lines);
    return whole.replace(*from, *to - *from, toml_text(value));
  }
  if (value.is_null()) return text;
  const std::string line = key_text(name) + " = " + toml_text(value);
  const std::string header = "[" + section + "]";
  for (std::size_t i = 0; i < lines.size() && !section.empty(); ++i) {
    if (!begins(lines[i], header.c_str())) continue;
    std::size_t end = i + 1;
    while (end < lines.size() && !begins(lines[end], "[")) ++end;
    while (end > i + 1 && (blank(lines[end - 1]) || begins(lines[end - 1], "#"))) --end;
    lines.insert(lines.begin() + std::ptrdiff_t(end), line);
    return joined(lines);
  }
  std::size_t before = 0;  // line of the first table
  while (before < lines.size() && !begins(lines[before], section.empty() ? "[" : "[[variant"))
    ++before;
  while (before > 0 && before < lines.size() && begins(lines[before - 1], "#")) --before;
  if (section.empty()) {
    while (before > 0 && blank(lines[before - 1])) --before;
    lines.insert(lines.begin() + std::ptrdiff_t(before), line);
    return joined(lines);
  }
  std::vector<std::string> block;
  if (before > 0 && !blank(lines[before - 1])) block.push_back("");
  if (table) {  // it has dotted keys or is an inline table: a header may not follow
    return std::nullopt;
  }
  block.push_back(header);
  block.push_back(line);
  if (before < lines.size()) block.push_back("");
  lines.insert(lines.begin() + std::ptrdiff_t(before), block.begin(), block.end());
  return joined(lines);
}

}  // namespace

std::string toml_document(const json& root) {
  std::string text;
  for (const auto& [name, value] : root.items())
    if (!value.is_object() && name != "variant")
      text += key_text(name) + " = " + toml_text(value) + "\n";
  for (const auto& [name, value] : root.items()) {
    if (!value.is_object() || value.empty()) continue;
    text += (text.empty() ? "[" : "\n[") + key_text(name) + "]\n";
    add_values(value, "", text);
  }
  if (root.contains("variant"))
    for (const json& block : root["variant"])
      text += (text.empty() ? "" : "\n") + variant_text(block);
  return text;
}

namespace {

/// Writes the whole document. Throws InputError for a value that TOML cannot represent.
std::string written_anew(const json& wanted, const std::string& key) {
  const std::string text = toml_document(wanted);
  try {
    if (parse_toml(text).root == wanted) return text;
  } catch (const TornToml&) {
  }
  throw InputError(key + ": a value that a scene file cannot hold");
}

}  // namespace

std::string with_value(const std::string& text, const std::string& key, const json& value) {
  const std::size_t dot = key.find('.');
  const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
  const std::string name = dot == std::string::npos ? key : key.substr(dot + 1);
  const json wanted = changed(parse_toml(text).root, section, name, value);
  try {
    if (const auto out = edited(text, section, name, value)) {
      json got = parse_toml(*out).root;
      if (!section.empty() && got.contains(section) && got[section].empty()) got.erase(section);
      if (got == wanted) return *out;
    }
  } catch (const TornToml&) {
    // Not one of the ways that are known here.
  } catch (const toml::parse_error&) {
  }
  return written_anew(wanted, key);
}

std::vector<json> variant_blocks(const std::string& text) {
  const json root = parse_toml(text).root;
  if (!root.contains("variant") || !root["variant"].is_array()) return {};
  return root["variant"].get<std::vector<json>>();
}

std::vector<std::string> variant_texts(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  std::vector<std::string> texts;
  for (const Stretch& s : variant_lines(lines))
    texts.push_back(
        joined({lines.begin() + std::ptrdiff_t(s.first), lines.begin() + std::ptrdiff_t(s.last)}));
  if (texts.size() != variant_blocks(text).size()) return {};
  return texts;
}

std::string with_variants(const std::string& text, const std::vector<json>& blocks) {
  json wanted = parse_toml(text).root;
  const std::vector<json> old = variant_blocks(text);
  if (blocks.empty())
    wanted.erase("variant");
  else
    wanted["variant"] = blocks;
  std::vector<std::string> lines = lines_of(text);
  const std::vector<Stretch> stretches = variant_lines(lines);
  const std::vector<std::string> texts = variant_texts(text);
  if (stretches.size() != old.size()) return written_anew(wanted, "variant");
  for (auto s = stretches.rbegin(); s != stretches.rend(); ++s) {
    std::size_t first = s->first;
    if (first > 0 && blank(lines[first - 1])) --first;
    lines.erase(lines.begin() + std::ptrdiff_t(first), lines.begin() + std::ptrdiff_t(s->last));
  }
  std::string out = joined(lines);
  for (const json& block : blocks) {
    const auto same = std::find(old.begin(), old.end(), block);
    out += (out.empty() ? "" : "\n") +
           (same == old.end() ? variant_text(block) : texts[std::size_t(same - old.begin())]);
  }
  try {
    if (parse_toml(out).root == wanted) return out;
  } catch (const TornToml&) {
  }
  return written_anew(wanted, "variant");
}

}  // namespace hyperex::scene
