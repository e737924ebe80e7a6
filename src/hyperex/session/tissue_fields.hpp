// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {

/// Tissue fields of a scene and its variants on one mesh; what does not depend on their options is
/// computed once, when it is first needed.
class TissueFields {
 public:
  /// Both must outlive this.
  TissueFields(const Inputs& inputs, const tissue::TissueMesh& mesh)
      : inputs_(inputs), mesh_(mesh) {}

  /// Nothing where the tissue is uniform. Throws InputError naming the scene's key, preceded by
  /// `owner`: "variant[0].".
  std::optional<tissue::TissueField> of(const scene::Scene& scene, const std::string& owner = "");
  /// The share (0 to 1) of a region's change that applies at each vertex of the skin. Errors as
  /// above.
  Eigen::VectorXd region_shares(const scene::Scene& scene, std::size_t region);

 private:
  template <typename Made>
  Made made(const scene::Scene& scene, const std::string& owner,
            const std::function<Made(const tissue::TissueFieldMaker&)>& make);

  const Inputs& inputs_;
  const tissue::TissueMesh& mesh_;
  std::optional<tissue::TissueMesh> whole_;  ///< of a thinned scan: files name its own vertices
  std::optional<anatomy::RegisteredFace> face_;
  std::optional<tissue::TissueFieldMaker> maker_;
  bool with_face_ = false;
};

}  // namespace hyperex::session
