// SPDX-License-Identifier: GPL-3.0-or-later
#include "open_face.hpp"

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/run/report_page.hpp"
#include "hyperex/run/variants.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/remarks_json.hpp"
#include "hyperex/session/same_face.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/simulate/load/known_activation.hpp"
#include "hyperex/tissue/mesh/skin_depth.hpp"
#include "live.hpp"

namespace hyperex::studio {

using nlohmann::json;

namespace {

scene::Scene scene_of(const std::string& text, const std::filesystem::path& file,
                      const KeptResults& kept, std::vector<scene::LeftOutVariant>* left_out) {
  scene::Scene scene = scene::read_scene_text(text, file, left_out);
  scene.kept = kept;
  return scene;
}

}  // namespace

json values_of(const scene::Scene& scene) {
  json out = json::object();
  const json sections = scene::options_json(scene);
  for (const auto& [section, keys] : sections.items()) {
    if (!keys.is_object()) {
      out[section] = keys;
      continue;
    }
    for (const auto& [key, value] : keys.items()) out[section + "." + key] = value;
  }
  return out;
}

OpenFace::OpenFace(std::string text, std::filesystem::path file, KeptResults kept,
                   const Stage& stage, std::vector<scene::LeftOutVariant>* left_out)
    : text_(std::move(text)),
      session_(scene_of(text_, file, kept, left_out), {.certainty = session::Certainty::on_request,
                                                       .stage = stage,
                                                       .leave_out_variants = left_out != nullptr}) {
  if (!left_out) return;
  left_out->insert(left_out->end(), session_.left_out().begin(), session_.left_out().end());
  if (left_out->empty()) return;
  std::ranges::sort(*left_out, {}, &scene::LeftOutVariant::number);
  const std::vector<json> all = scene::variant_blocks(text_);
  std::vector<json> sound;
  for (const scene::Variant& variant : scene().variants) sound.push_back(all[variant.number]);
  set_text(scene::with_variants(text_, sound));
}

bool OpenFace::set_text(const std::string& text) {
  if (!session_.set_scene(scene::read_scene_text(text, scene().file))) return false;
  text_ = text;
  return true;
}

simulate::SimulationOptions OpenFace::options_live(std::size_t face,
                                                   const std::vector<std::string>& points) const {
  if (face >= session_.faces()) throw InputError("face: there is none of this number");
  const scene::Scene& of = face == 0 ? scene() : session_.variants()[face - 1].scene;
  motion::Motion named;
  named.names = points;
  simulate::SimulationOptions options = session_.options(face);
  options.drive.points = session::driven_points(of, named);
  for (const std::string& point : options.drive.points)
    if (std::find(points.begin(), points.end(), point) == points.end())
      throw InputError("drive.points", point + ": not tracked live");
  if (options.region.measured != simulate::Measured::none)
    throw InputError("region.measured", "live the whole skin is simulated: expected none");
  return live_options(std::move(options));
}

Eigen::VectorXd OpenFace::region_shares(const std::string& text) {
  return session_.region_shares(scene::read_scene_text(text, scene().file), 0);
}

Eigen::VectorXf OpenFace::unpainted_mm() const {
  tissue::TissueMeshOptions options = scene().mesh;
  options.depth_regions.clear();
  return (1e3 * tissue::skin_depth(session_.mesh(), inputs().landmarks, options)).cast<float>();
}

bool OpenFace::same_skin(const OpenFace& other) const {
  const TriMesh &own = session_.mesh().skin, &others = other.session_.mesh().skin;
  return session::same_face(scene(), other.scene(), "mesh.thickness_region") &&
         own.points.rows() == others.points.rows() && own.points == others.points &&
         own.triangles.rows() == others.triangles.rows() && own.triangles == others.triangles;
}

void OpenFace::run(const simulate::RunCallbacks& callbacks) {
  const bool base_runs = !session_.base_up_to_date();
  session_.run_base(callbacks);
  if (base_runs)
    modes_ = report::displacement_modes(session_.simulation().performance.skin_displacement_m);
  session_.run_variants(callbacks);
}

json OpenFace::replay(report::BinaryBlock& block, bool with_face) const {
  run::Results all = run::results_of(session_);
  all.modes = modes_;
  json summary;
  summary["symmetry"] = metrics::summary_of(all.symmetry);
  summary["warnings"] = texts_of(all.notes, Severity::warning);
  summary["remarks"] = session::remarks_json(all.notes);
  if (all.inputs.head_uncertainty_known) {
    summary["head_shift_uncertainty_mm"] = all.inputs.head_shift_uncertainty_mm;
    summary["head_turn_uncertainty_deg"] = all.inputs.head_turn_uncertainty_deg;
  } else {
    summary["head_shift_uncertainty_mm"] = summary["head_turn_uncertainty_deg"] = nullptr;
  }
  const simulate::Performance& p = all.simulation.performance;
  summary["peak_time_s"] = p.frame_time_s[std::size_t(p.peak_frame)];
  if (all.uncertainty)
    summary["uncertainty"] = metrics::json_of(*all.uncertainty, p.skin_rest, all.inputs.landmarks);
  const std::vector<session::VariantRun>& variants = session_.variants();
  if (!variants.empty()) summary["variants"] = {{"table", run::variant_table(all, variants)}};
  const run::ReplayPage page(all, variants, summary);
  return report::replay_manifest(page.input(), block, with_face);
}

json OpenFace::activations(report::BinaryBlock& block) const {
  const simulate::MuscleCourse& base = session_.simulation().performance.muscles;
  if (base.names.empty()) return nullptr;
  const auto rows = [&](const simulate::MuscleCourse& course) {
    if (course.names != base.names) return json();
    std::vector<float> values;
    for (const auto& row : course.activation.rowwise())
      values.insert(values.end(), row.begin(), row.end());
    return block.add(values);
  };
  json faces = json::array({rows(base)});
  for (const session::VariantRun& run : session_.variants())
    faces.push_back(rows(run.simulation.performance.muscles));
  json notes = json::array();
  for (Eigen::Index m = 0; m < base.activation.rows(); ++m) {
    Eigen::Index most = 0;
    base.activation.row(m).cwiseAbs().maxCoeff(&most);
    notes.push_back(simulate::muscle_words(base, m, most));
  }
  return {{"names", base.names}, {"time_s", base.time_s}, {"faces", faces}, {"notes", notes}};
}

}  // namespace hyperex::studio
