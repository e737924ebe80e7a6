// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "hyperex/core/error.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/scene/variant_names.hpp"
#include "session.hpp"

namespace hyperex::studio {

namespace {

/// Throws InputError, in the page's terms, for a name that is not allowed for the face. `others`:
/// the blocks of all other variants.
void check_face_name(const std::string& name, const std::vector<json>& others) {
  if (!scene::is_variant_name(name))
    throw InputError(
        "a face's name: expected letters a to z and digits, spaces and any of -_.,;:+=%&'()[]");
  if (name == "base")
    throw InputError("a face's name: expected another; \"base\" is the scene itself");
  for (const json& other : others)
    if (scene::name_of_block(other) == name)
      throw InputError(fmt::format("another face is called \"{}\": expected another name", name));
}

}  // namespace

json Session::add_variant(const json& fields) {
  std::vector<json> blocks = scene::variant_blocks(now_.text);
  const std::size_t like = fields.at("like");
  if (like > blocks.size()) throw InputError("like: no such face");
  json block = like > 0 ? blocks[like - 1] : json::object();
  check_face_name(fields.at("name"), blocks);
  block["name"] = fields.at("name");
  if (const std::string preset = fields.value("preset", ""); !preset.empty())
    block["preset"] = preset;
  if (block.size() == 1) block["motion"]["gain"] = values_of(require_face().scene())["motion.gain"];
  blocks.push_back(block);
  commit(scene::with_variants(now_.text, blocks));
  return {{"face", blocks.size()}};
}

json Session::remove_variant(const json& fields) {
  std::vector<json> blocks = scene::variant_blocks(now_.text);
  const std::size_t face = fields.at("face");
  if (face > blocks.size()) throw InputError("face: no such variant");
  blocks.erase(blocks.begin() + std::ptrdiff_t(face) - 1);
  commit(scene::with_variants(now_.text, blocks));
  return json::object();
}

std::string Session::text_with_name(const std::string& text, std::size_t face,
                                    const std::string& name) const {
  std::vector<json> blocks = scene::variant_blocks(text);
  if (face < 1 || face > blocks.size()) throw InputError("face: no such variant");
  std::vector<json> others = blocks;
  others.erase(others.begin() + std::ptrdiff_t(face) - 1);
  check_face_name(name, others);
  blocks[face - 1]["name"] = name;
  return scene::with_variants(text, blocks);
}

json Session::rename_variant(const json& fields) {
  commit(text_with_name(now_.text, fields.at("face"), fields.at("name")));
  return json::object();
}

}  // namespace hyperex::studio
