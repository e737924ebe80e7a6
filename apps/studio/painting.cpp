// SPDX-License-Identifier: GPL-3.0-or-later
#include "painting.hpp"

#include <fmt/format.h>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/sha256.hpp"
#include "hyperex/session/thinned_scan.hpp"

namespace hyperex::studio {

using nlohmann::json;

std::string write_painting(const tissue::TissueMesh& mesh, const json& vertices, const json& shares,
                           const std::filesystem::path& folder) {
  if (!vertices.is_array() || !shares.is_array() || vertices.empty() ||
      vertices.size() != shares.size())
    throw InputError("shares: expected one for each of the vertices, and some");
  Eigen::MatrixXf of_skin = Eigen::MatrixXf::Zero(mesh.skin.points.rows(), 1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const json &vertex = vertices[i], &share = shares[i];
    if (!vertex.is_number_integer() || vertex.get<double>() < 0 ||
        vertex.get<double>() >= double(of_skin.rows()))
      throw InputError(
          fmt::format("vertices: expected whole numbers from 0 to {}", of_skin.rows() - 1));
    if (!share.is_number() || !(share.get<double>() > 0 && share.get<double>() <= 1))
      throw InputError("shares: expected numbers above 0, up to 1");
    of_skin(vertex.get<Eigen::Index>(), 0) = share.get<float>();
  }
  if (mesh.full) of_skin = session::on_full_skin(*mesh.full, of_skin);
  const Eigen::Index rows = mesh.full ? mesh.full->scan_vertices : mesh.scan_vertices;
  if (!(of_skin.topRows(rows).maxCoeff() > 0))
    throw InputError("vertices: expected some of the scan's own");
  std::string text = "weight\n";
  for (Eigen::Index v = 0; v < rows; ++v)
    text += fmt::format("{:.6g}\n", std::min(of_skin(v, 0), 1.0F));
  Sha256 hash;
  hash.add_text(text);
  const std::string name = "painted-" + hash.hex().substr(0, 16) + ".csv";
  if (!std::filesystem::exists(folder / name))
    write_file_atomically(folder / name, [&](std::ostream& out) { out << text; });
  return name;
}

}  // namespace hyperex::studio
