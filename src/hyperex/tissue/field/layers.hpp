// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/tissue/mesh/volume_mesh.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// The layers of the options, or those of their preset where they have none. From the skin inwards.
const std::vector<TissueLayer>& layers_of(const TissueFieldOptions& options);

/// The parameters of each layer before points, files and regions, SI. Where the last row of
/// layers_of() has a thickness, the uniform tissue under it comes last. Without layers: one entry,
/// uniform_parameters().
std::vector<TissueParameters> layer_parameters(const TissueFieldOptions& options);

/// What is wrong with the options' own layers, as far as it is known without a mesh.
void check_layers(const TissueFieldOptions& options, std::vector<FieldProblem>& problems);

/// The first layer that begins or ends deeper than the tissue is anywhere; none where all lie
/// within. check_layers() must have found nothing.
std::optional<FieldProblem> layer_beneath(const TissueFieldOptions& options,
                                          const VolumeMesh& volume);

/// Says where the tissue is too thin for the deepest layer, or for all layers where each has a
/// thickness, in per cent of the skin; nothing below one per cent, nor where they fill it exactly.
std::vector<Note> notes_on_layers(const TissueFieldOptions& options, const VolumeMesh& volume);

/// Each layer's share of each tetrahedron: |tets| x layer_parameters().size(), rows sum to 1. It is
/// the share of the height of the tetrahedron's prism that lies within the layer. Depths count
/// along the prism's edges from the skin, their mean over its three edges.
Eigen::MatrixXd layer_shares(const TissueFieldOptions& options, const VolumeMesh& volume);

/// The mean of each tetrahedron over its layers by their shares: Voigt's mean of E where Poisson's
/// ratio is alike. `of_layers`: one list of |tets| values per column of `share`. Equal values, and
/// the value of a layer that fills the tetrahedron, are reproduced exactly.
std::vector<double> layer_means(const Eigen::MatrixXd& share,
                                const std::vector<std::vector<double>>& of_layers);

}  // namespace hyperex::tissue
