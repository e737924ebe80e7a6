// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/stages/tissue_fields.hpp"

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/scene/stages/thinned_scan.hpp"

namespace hyperex::scene {

std::optional<tissue::TissueField> TissueFields::of(const Scene& scene, const std::string& owner) {
  const tissue::TissueFieldOptions options = scene.tissue;
  if (!is_graded(options)) return std::nullopt;
  Progress progress("spreading the tissue's parameters over the face", 0);
  if (needs_registration(options) && !with_face_) {
    face_ = tissue::register_canonical_face(inputs_.landmarks, inputs_.scan.mesh);
    maker_.reset();
    with_face_ = true;
  }
  if (mesh_.full && !whole_) whole_.emplace(with_full_skin(mesh_));
  if (!maker_)
    maker_.emplace(whole_ ? *whole_ : mesh_, inputs_.landmarks, face_ ? &*face_ : nullptr);
  try {
    tissue::TissueField field = maker_->make(options);
    if (mesh_.full) keep_thinned(field, *mesh_.full);
    return field;
  } catch (const tissue::FieldError& error) {
    InputProblem problem = problem_at(scene, "tissue." + error.problem.key, error.problem.expected);
    problem.key = owner + problem.key;
    throw InputError(problem);
  }
}

}  // namespace hyperex::scene
