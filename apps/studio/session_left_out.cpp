// SPDX-License-Identifier: GPL-3.0-or-later
// Variants of the opened scene that cannot be run: the face is open without them.
#include <fmt/format.h>

#include "hyperex/scene/scene_text.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/session/variants.hpp"
#include "session.hpp"

namespace hyperex::studio {

bool Session::has_tables_of_variants(const std::string& text) {
  try {
    return !scene::variant_texts(text).empty();
  } catch (const scene::TornToml&) {
    return false;  // reading the scene reports the error
  }
}

Session::LeftOut Session::left_out_of(const std::string& text,
                                      const std::vector<scene::LeftOutVariant>& variants) const {
  LeftOut out;
  if (variants.empty()) return out;
  out.with = text;
  out.without = face_->text();
  const std::vector<std::string> texts = scene::variant_texts(text);
  for (const scene::LeftOutVariant& variant : variants) {
    out.variants += "\n" + texts.at(variant.number);
    out.notes.push_back(session::left_out_warning(variant));
    out.notes.back().text = without_folder(out.notes.back().text);
  }
  return out;
}

std::string Session::text_to_save() const {
  const bool unchanged = !left_out_.variants.empty() && now_.text == left_out_.without;
  return unchanged ? left_out_.with : now_.text + left_out_.variants;
}

void Session::report_left_out(bool of_scene) {
  if (left_out_.variants.empty()) return;
  const std::string which = fmt::format("{} variant{} that cannot be run", left_out_.notes.size(),
                                        left_out_.notes.size() == 1 ? "" : "s");
  log("warning", of_scene ? "the saved scene keeps " + which + ": hyperex run refuses it as it is"
                          : "written without " + which);
}

}  // namespace hyperex::studio
