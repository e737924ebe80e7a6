// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/report/page_data.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/mirrored_twin.hpp"
#include "hyperex/session/prepared_face.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::studio {

/// The face that is open: a scene's text and what a run makes of it, kept so that a change costs no
/// more than it must. Face 0 is base, 1, 2 ... its variants. One thread at a time.
class OpenFace {
 public:
  using Stage = std::function<void(const std::string&)>;  ///< told as each begins

  /// Reads and meshes; simulates nothing yet. `file`: where the scene's text belongs: relative
  /// paths are taken from its folder, messages name it. Throws InputError.
  OpenFace(std::string text, std::filesystem::path file, KeptResults kept, const Stage& stage);

  const std::string& text() const { return text_; }
  const std::filesystem::path& file() const { return scene_.file; }
  const scene::Scene& scene() const { return scene_; }
  const session::Inputs& inputs() const { return inputs_; }
  const tissue::TissueMesh& mesh() const { return *face_.mesh; }
  std::size_t faces() const { return 1 + runs_.size(); }
  /// What is probably wrong with the inputs or the mesh, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Why the program picked what drives, a sentence.
  const std::string& drive_why() const { return drive_why_; }

  /// Another text. False, and nothing is changed, where it names another scan, recording or mesh:
  /// that is another OpenFace. Throws InputError, and nothing is changed, for a text that is no
  /// sound scene.
  bool set_text(const std::string& text);

  /// What the first change of a first variant needs beside base's motion, so that it need not wait
  /// for that: where points drive base, the muscles' forces that a variant keeps are found. To be
  /// called once all is up to date; does nothing where there are variants.
  void expect_variant();
  /// Whether still() has all but what the change itself asks for.
  bool ready(std::size_t face) const;
  /// Of the skin, m, in static equilibrium at an instant.
  PointsF still(std::size_t face, double time_s);

  /// A face as it would follow `points` (names) that come in live. Throws InputError where one that
  /// drives is not among them.
  simulate::SimulationOptions options_live(std::size_t face,
                                           const std::vector<std::string>& points) const;
  std::shared_ptr<const tissue::TissueMesh> shared_mesh() const { return face_.mesh; }
  /// Of the first region of another text of this face, how much of its change holds at each vertex
  /// of the skin, 0 to 1. Throws InputError.
  Eigen::VectorXd region_shares(const std::string& text);

  /// At each vertex of the skin, mm: how thick the tissue is to be, without mesh.thickness_region.
  Eigen::VectorXf unpainted_mm() const;
  /// Whether the other has the same skin, landmarks and motion: all but painted thickness.
  bool same_skin(const OpenFace& other) const;

  bool up_to_date() const;
  /// Runs what is not up to date. Throws NumericalError, and simulate::Cancelled: what was done so
  /// far stays.
  void run(const simulate::RunCallbacks& callbacks);

  /// Whether the error bands of all figures are known: not while one edits, as each takes a run of
  /// the mirrored face.
  bool bands_known() const;
  /// Finds them once all is up to date. Throws as run(); what was done so far stays.
  void find_bands(const std::function<bool()>& cancelled);

  /// Once all is up to date: what the page reads (report::replay_manifest).
  nlohmann::json replay(report::BinaryBlock& block, bool with_face) const;
  /// Likewise: of the muscles over time; null where none drive (protocol.json, event face).
  nlohmann::json activations(report::BinaryBlock& block) const;

 private:
  /// What a variant's run rests on.
  struct Standing {
    std::optional<simulate::Simulator> simulator;  ///< with base's load held; none: not made yet
    bool stale = true, bands = false;
  };
  simulate::SimulationOptions options_of(const scene::Scene& scene, const session::Inputs& inputs,
                                         const std::optional<tissue::TissueField>& field) const;
  void take(scene::Scene next);
  simulate::Simulator& simulator_of(std::size_t face);
  run::Results results() const;

  std::string text_;
  scene::Scene scene_;
  session::Inputs inputs_;
  std::size_t own_notes_ = 0;  ///< of the inputs' notes, those of reading
  std::string drive_why_;
  session::PreparedFace face_;
  std::shared_ptr<const anatomy::Teeth> teeth_;  ///< null: none
  std::vector<std::string> teeth_notes_, warnings_;
  std::unique_ptr<session::TissueFields> fields_;
  std::optional<tissue::TissueField> field_;
  std::optional<simulate::Simulator> simulator_;
  /// Of expect_variant(): base as it is once there is a variant, none where it stays as it is; and
  /// that variant's.
  std::optional<simulate::Simulator> next_base_, next_variant_;
  std::vector<bool> touched_{false, false};  ///< whether obstacles are set for teeth, for eyes
  bool stale_ = true;
  simulate::SimulationResult simulation_;
  metrics::SymmetryMeasures symmetry_;
  std::optional<session::MirroredTwin> twin_;  ///< of base as it is; none: not run yet
  report::DisplacementModes modes_;
  std::vector<session::VariantRun> runs_;  ///< of the variants
  std::vector<Standing> standing_;         ///< of each of them
};

/// Every key with its value, in the units of scene files: {"tissue.young_kpa": 150}.
nlohmann::json values_of(const scene::Scene& scene);

}  // namespace hyperex::studio
