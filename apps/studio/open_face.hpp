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

/// The open face: a scene's text, the session of that scene, and the data that the page draws. Face
/// 0 is the base case, 1, 2 ... are its variants. Not thread-safe.
class OpenFace {
 public:
  using Stage = std::function<void(const std::string&)>;  ///< called as each stage begins

  /// Reads and meshes; simulates nothing yet. `file`: the place of the scene's text. Relative paths
  /// are relative to its folder, and messages name it. With `left_out`, variants that cannot be run
  /// are missing in text() and are added there. Throws InputError.
  OpenFace(std::string text, std::filesystem::path file, KeptResults kept, const Stage& stage,
           std::vector<scene::LeftOutVariant>* left_out = nullptr);

  const std::string& text() const { return text_; }
  session::FaceSession& session() { return session_; }
  const session::FaceSession& session() const { return session_; }
  const scene::Scene& scene() const { return session_.scene(); }
  const session::Inputs& inputs() const { return session_.inputs(); }

  /// Sets another text. Returns false and changes nothing where the text names another scan,
  /// recording or mesh, which needs another OpenFace. Throws InputError and changes nothing where
  /// the text is not a valid scene.
  bool set_text(const std::string& text);

  /// The options with which a face follows `points` (names) that arrive live. Throws InputError
  /// where a driving point is not among them.
  simulate::SimulationOptions options_live(std::size_t face,
                                           const std::vector<std::string>& points) const;
  /// The effect of the first region of another text of this face at each vertex of the skin, as a
  /// share from 0 to 1 of its full change. Throws InputError.
  Eigen::VectorXd region_shares(const std::string& text);

  /// The thickness of the tissue at each vertex of the skin (mm), without mesh.thickness_region.
  Eigen::VectorXf unpainted_mm() const;
  /// Whether the other face has the same skin, landmarks and motion; only the painted thickness may
  /// differ.
  bool same_skin(const OpenFace& other) const;

  /// Runs all faces that are not up to date. Throws NumericalError, or simulate::Cancelled; results
  /// so far are kept.
  void run(const simulate::RunCallbacks& callbacks);

  /// The data that the page reads (report::replay_manifest). All faces must be up to date.
  nlohmann::json replay(report::BinaryBlock& block, bool with_face) const;
  /// The activations of the muscles over time, on the same condition; null where no muscles drive
  /// (protocol.json, event face).
  nlohmann::json activations(report::BinaryBlock& block) const;

 private:
  std::string text_;
  session::FaceSession session_;
  report::DisplacementModes modes_;  // of the base case, at its last run
};

/// Every key with its value, in the units of scene files: {"tissue.young_kpa": 150}.
nlohmann::json values_of(const scene::Scene& scene);

}  // namespace hyperex::studio
