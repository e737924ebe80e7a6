// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::studio {

/// The face that is open: a scene's text, the session of that scene, and what the page draws of it.
/// Face 0 is base, 1, 2 ... its variants. One thread at a time.
class OpenFace {
 public:
  using Stage = std::function<void(const std::string&)>;  ///< called as each stage begins

  /// Reads and meshes; simulates nothing yet. `file`: where the scene's text belongs: relative
  /// paths are taken from its folder, messages name it. Throws InputError.
  OpenFace(std::string text, std::filesystem::path file, KeptResults kept, const Stage& stage);

  const std::string& text() const { return text_; }
  session::FaceSession& session() { return session_; }
  const session::FaceSession& session() const { return session_; }
  const scene::Scene& scene() const { return session_.scene(); }
  const session::Inputs& inputs() const { return session_.inputs(); }

  /// Another text. False, and nothing is changed, where it names another scan, recording or mesh:
  /// that is another OpenFace. Throws InputError, and nothing is changed, for a text that is no
  /// sound scene.
  bool set_text(const std::string& text);

  /// A face as it would follow `points` (names) that come in live. Throws InputError where one that
  /// drives is not among them.
  simulate::SimulationOptions options_live(std::size_t face,
                                           const std::vector<std::string>& points) const;
  /// How much of the change of the first region of another text of this face holds at each vertex
  /// of the skin, 0 to 1. Throws InputError.
  Eigen::VectorXd region_shares(const std::string& text);

  /// At each vertex of the skin, mm: the thickness of the tissue without mesh.thickness_region.
  Eigen::VectorXf unpainted_mm() const;
  /// Whether the other has the same skin, landmarks and motion: all but painted thickness.
  bool same_skin(const OpenFace& other) const;

  /// Runs what is not up to date. Throws NumericalError, and simulate::Cancelled: what was done so
  /// far stays.
  void run(const simulate::RunCallbacks& callbacks);

  /// Once all is up to date: what the page reads (report::replay_manifest).
  nlohmann::json replay(report::BinaryBlock& block, bool with_face) const;
  /// Likewise: of the muscles over time; null where none drive (protocol.json, event face).
  nlohmann::json activations(report::BinaryBlock& block) const;

 private:
  std::string text_;
  session::FaceSession session_;
  report::DisplacementModes modes_;  // of base as it was run last
};

/// Every key with its value, in the units of scene files: {"tissue.young_kpa": 150}.
nlohmann::json values_of(const scene::Scene& scene);

}  // namespace hyperex::studio
