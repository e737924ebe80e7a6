// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/tissue_fields.hpp"

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/session/thinned_scan.hpp"
#include "hyperex/session/unknown_names.hpp"

namespace hyperex::session {

template <typename Made>
Made TissueFields::made(const scene::Scene& scene, const std::string& owner,
                        const std::function<Made(const tissue::TissueFieldMaker&)>& make) {
  // In the studio a scene may change after its inputs were read and checked.
  const auto problems = tissue::problems_of(scene.tissue, inputs_.landmarks);
  if (!problems.empty()) {
    InputProblem first =
        scene::problem_at(scene, "tissue." + problems[0].key, problems[0].expected);
    first.expected += did_you_mean_region(first.key, first.value);
    first.key = owner + first.key;
    throw InputError(first);
  }
  if (needs_registration(scene.tissue) && !with_face_) {
    face_ = anatomy::register_canonical_face(inputs_.landmarks, inputs_.scan.mesh);
    maker_.reset();
    with_face_ = true;
  }
  if (mesh_.full && !whole_) whole_.emplace(tissue::with_full_skin(mesh_));
  if (!maker_)
    maker_.emplace(whole_ ? *whole_ : mesh_, inputs_.landmarks, face_ ? &*face_ : nullptr);
  try {
    return make(*maker_);
  } catch (const tissue::FieldError& error) {
    InputProblem problem =
        scene::problem_at(scene, "tissue." + error.problem.key, error.problem.expected);
    problem.key = owner + problem.key;
    throw InputError(problem);
  }
}

std::optional<tissue::TissueField> TissueFields::of(const scene::Scene& scene,
                                                    const std::string& owner) {
  const tissue::TissueFieldOptions options = scene.tissue;
  if (!is_graded(options)) return std::nullopt;
  Progress progress("interpolating the tissue's parameters", 0);
  tissue::TissueField field = made<tissue::TissueField>(
      scene, owner, [&](const tissue::TissueFieldMaker& maker) { return maker.make(options); });
  if (mesh_.full) keep_thinned(field, *mesh_.full);
  return field;
}

Eigen::VectorXd TissueFields::region_shares(const scene::Scene& scene, std::size_t region) {
  const auto shares = made<Eigen::VectorXd>(scene, "", [&](const tissue::TissueFieldMaker& maker) {
    return maker.region_shares(scene.tissue, region);
  });
  return mesh_.full ? Eigen::VectorXd(shares(mesh_.full->kept)) : shares;
}

}  // namespace hyperex::session
