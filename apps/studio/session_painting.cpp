// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/error.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "painting.hpp"
#include "scene_files.hpp"
#include "session.hpp"

namespace hyperex::studio {

json Session::paint(const json& fields) {
  const tissue::TissueMesh& mesh = require_face().session().mesh();
  return {{"file", write_painting(mesh, fields.at("vertices"), fields.at("shares"), uploads())}};
}

json Session::region_shares(const json& fields) {
  require_face();
  json row = fields.at("region");
  if (!row.is_object()) throw InputError("region: expected a row of tissue.region");
  for (const char* key : {"young_kpa", "viscosity_pa_s", "poisson", "density_kg_m3"})
    row.erase(key);
  row["young_factor"] = 2;  // any change: only its share matters
  const json rows = with_uploads("tissue.region", json::array({row}), uploads(), known_paths());
  const Eigen::VectorXf shares =
      face_->region_shares(scene::with_value(now_.text, "tissue.region", rows)).cast<float>();
  report::BinaryBlock block;
  const json head = {{"event", "shares"},
                     {"key", fields.at("key")},
                     {"values", block.add("float32", shares.data(), std::size_t(shares.size()))}};
  send_(binary_message(head, block), true, "");
  return json::object();
}

}  // namespace hyperex::studio
