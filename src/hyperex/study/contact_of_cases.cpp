// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/contact_of_cases.hpp"

#include <algorithm>
#include <vector>

#include "hyperex/core/error.hpp"

namespace hyperex::study {
namespace {

bool sets_strain(const Case& one) {
  return std::ranges::any_of(one.overrides, [](const scene::Override& given) {
    return given.text.starts_with("tissue.strain=");
  });
}

bool has_finite_strain(const scene::Scene& scene) {
  return scene.model.strain == simulate::Strain::finite ||
         std::ranges::any_of(scene.variants, [](const scene::Variant& variant) {
           return variant.scene.model.strain == simulate::Strain::finite;
         });
}

}  // namespace

void settle_contact(Study& study) {
  if (std::ranges::none_of(study.cases, sets_strain)) return;
  bool any_finite = false;
  std::vector<Case*> apart;  // their lips are, by default
  for (Case& one : study.cases) {
    try {
      const scene::Scene scene = scene::read_scene_with(study.scene, one.overrides);
      any_finite = any_finite || has_finite_strain(scene);
      if (scene.contact.lips && !scene.origins.contains("contact.lips")) apart.push_back(&one);
    } catch (const InputError&) {  // reported with the plan
      continue;
    }
  }
  if (!any_finite) return;
  for (Case* one : apart)
    one->overrides.push_back({"contact.lips=false", {study.file, 0}, study.file.parent_path()});
}

}  // namespace hyperex::study
