// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::studio {

/// What the page needs to move segments of bone (protocol.json, event face): the axes of the face,
/// the usual segments with their cuts, and the surfaces of the person's own bones in front of the
/// ears.
nlohmann::json bones_json(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          report::BinaryBlock& block);

}  // namespace hyperex::studio
