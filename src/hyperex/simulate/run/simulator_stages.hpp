// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stages of a Simulator and what each is computed from. The table in simulator.hpp is this
// declaration in words, and a test compares the two.
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "hyperex/core/stage_graph.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/simulate/contact/mouth_contact.hpp"
#include "hyperex/simulate/drive/boundary.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"
#include "hyperex/simulate/load/held_load.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/run/readout.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/simulate/run/stream.hpp"

namespace hyperex::simulate {

/// What determines the values in the system matrices, given their sparsity pattern.
struct MatrixValues {
  TissueValues tissue;  ///< without the volume, which changes no matrix
  ModelOptions model;
  DriveBy by;
  MuscleOptions muscles;  ///< as recorded
  std::shared_ptr<const Boundary> boundary;
  bool operator==(const MatrixValues& other) const {
    return tissue == other.tissue && model == other.model && by == other.by &&
           muscles == other.muscles && boundary->same_springs(*other.boundary);
  }
};

/// The factor of the reduced model, with the values that it was made of.
struct ReducedFactor {
  fem::ReducedModel model;
  std::shared_ptr<const MatrixValues> of;  ///< null: a refill failed
};

/// What added volume (TissueValues::volume_ratio) does to the face at rest.
struct AddedVolume {
  /// Growth tensor of each tetrahedron (fem::Assembler::grown); empty: no volume is added.
  std::vector<Eigen::Matrix3d> growth;
  Eigen::VectorXd force;  ///< N, all unknowns, at small strain
  /// The grown tissue, where the strain is finite; else null.
  std::shared_ptr<const fem::Assembler> grown;
};

/// The support with segments of bone moved by surgery, and what it does to the face at rest.
struct MovedBones {
  bool any = false;
  /// Displacement prescribed by moved bones, m, as Boundary::prescribed(); zero where none is
  /// moved.
  Eigen::VectorXd prescribed;
  /// Forces of the springs of moved bones, N, all unknowns; zero where none is moved.
  Eigen::VectorXd force;
  /// Change of Boundary::unit_forces_of_jaw() by surgery; empty where no bone is moved.
  Eigen::MatrixXd jaw_force_change;
  Eigen::Isometry3d upper_teeth = Eigen::Isometry3d::Identity(),
                    lower_teeth = Eigen::Isometry3d::Identity();
};

/// Contact with the compliance of the tissue at rest, and the factor that gives the compliance.
struct ContactModel {
  std::unique_ptr<fem::PartitionedFactor> factor;
  MouthContact contact;
};

/// A part of the options, read by `get`.
class OptionSource final : public Source {
 public:
  template <class Get>
  OptionSource(StageGraph& graph, std::string name, Get get)
      : Source(graph, std::move(name)),
        equal_([get](const SimulationOptions& a, const SimulationOptions& b) {
          return get(a) == get(b);
        }) {}
  bool equal(const SimulationOptions& a, const SimulationOptions& b) const { return equal_(a, b); }

 private:
  std::function<bool(const SimulationOptions&, const SimulationOptions&)> equal_;
};

/// Stages whose values are not kept. They are in the graph so that each option is an input of a
/// stage.
class Uncached final : public Stage {
 public:
  Uncached(StageGraph& graph, std::string name, std::initializer_list<Input> inputs)
      : Stage(graph, std::move(name), inputs) {}
  bool has_value() const override { return false; }

 private:
  void input_changed(OnChange) override {}
  void share(const Stage&) override {}
};

struct SimulatorStages : StageGraph {
  using O = SimulationOptions;
  template <class T>
  using List = std::vector<std::shared_ptr<const T>>;
  static Stage::Input refill(Stage& stage) { return {stage, OnChange::refill}; }
  static Stage::Input unless_held(Stage& stage) { return {stage, OnChange::drop_unless_held}; }
  static bool muscles_drive(const O& o) { return o.drive.by == DriveBy::muscles; }

  // ----- what is given

  Source motion{*this, "motion"};
  Source obstacles{*this, "obstacles"};
  OptionSource region{*this, "region", [](const O& o) { return o.region; }};
  OptionSource drive{*this, "drive (not its gain)", [](const O& o) {
                       DriveOptions but_gain = o.drive;
                       but_gain.gain = 1;
                       return but_gain;
                     }};
  OptionSource drive_by{*this, "drive.by", [](const O& o) { return o.drive.by; }};
  OptionSource drive_gain{*this, "drive.gain", [](const O& o) { return o.drive.gain; }};
  /// Where muscles do not drive, they have no effect.
  OptionSource muscles{*this, "muscles (not their gains)", [](const O& o) {
                         return muscles_drive(o) ? as_recorded(o.muscles) : MuscleOptions();
                       }};
  OptionSource gains{*this, "muscles.gain", [](const O& o) {
                       return std::make_tuple(o.muscles.gains, o.muscles.mirrored);
                     }};
  OptionSource support{*this, "support", [](const O& o) { return o.support; }};
  OptionSource element{*this, "model.element", [](const O& o) { return o.model.element; }};
  OptionSource model{*this, "model", [](const O& o) { return o.model; }};
  OptionSource tissue{*this, "tissue (not its volume)",
                      [](const O& o) { return std::tie(o.tissue.uniform, o.tissue.element); }};
  OptionSource volume{*this, "tissue.volume_ratio",
                      [](const O& o) { return std::tie(o.tissue.volume_ratio); }};
  OptionSource contact{*this, "contact", [](const O& o) { return o.contact; }};
  OptionSource surgery{*this, "surgery", [](const O& o) { return o.surgery; }};
  OptionSource bodies{*this, "contact.teeth or eyes",
                      [](const O& o) { return std::make_tuple(o.contact.teeth, o.contact.eyes); }};
  OptionSource tolerance{*this, "solver.tolerance", [](const O& o) { return o.solver.tolerance; }};
  OptionSource newmark{*this, "solver.newmark", [](const O& o) {
                         return std::make_tuple(o.solver.newmark_beta, o.solver.newmark_gamma);
                       }};
  OptionSource solver{*this, "solver", [](const O& o) { return o.solver; }};
  OptionSource step{*this, "time.step_s", [](const O& o) { return o.time.step_s; }};
  OptionSource end{*this, "time.end_s", [](const O& o) { return o.time.end_s; }};
  OptionSource time{*this, "time", [](const O& o) { return o.time; }};
  /// Reactions are found at the steps of a run.
  OptionSource reaction_steps{*this, "steps of reactions", [](const O& o) {
                                return o.drive.by == DriveBy::reactions
                                           ? std::make_tuple(o.time.step_s, o.time.end_s,
                                                             o.solver.tolerance)
                                           : std::make_tuple(0.0, 0.0, 0.0);
                              }};
  /// Activations are fitted up to the end of a run, and a few steps on (samples_of_run()).
  OptionSource muscle_end{*this, "end of muscles", [](const O& o) {
                            return muscles_drive(o) && o.time.end_s > 0
                                       ? std::make_tuple(o.time.end_s, o.time.step_s)
                                       : std::make_tuple(0.0, 0.0);
                          }};

  // ----- what copies share

  Cached<Readout> readout{*this, "readout", {}};
  Cached<MeasuredRegion> measured{*this, "measured region", {motion, region}};
  Cached<DrivenPoints> points{*this, "driven points", {motion, drive}};
  Cached<DrivenSkin> driven{*this, "driven skin", {motion, measured, drive}};
  Cached<Boundary> boundary{*this, "boundary", {motion, driven, drive_by, support, muscles}};
  Cached<MovedBones> moved_bones{*this, "moved bones", {boundary, surgery}};
  Cached<MatrixValues> values{*this, "matrix values", {boundary, drive_by, tissue, model, muscles}};
  Cached<fem::Assembler> pattern{*this, "pattern", {element}};
  Cached<AddedVolume> added_volume{*this, "added volume", {pattern, values, volume}};
  Checked<std::vector<int>> prescribed{*this, "prescribed unknowns", {boundary}};
  Cached<EliminationOrder> order{*this, "order", {pattern, prescribed}};
  Cached<MuscleModel> muscle_model{
      *this, "muscle model", {pattern, order, drive_by, support, tissue, model, muscles}};
  /// Whether a load has been found for this motion, drive and muscles. A further one then is for
  /// another tissue or support.
  Cached<bool> answered{*this,
                        "load was found",
                        {motion, measured, drive, drive_gain, muscles, reaction_steps, muscle_end}};
  Cached<HeldLoad> load{
      *this,
      "load",
      {motion, measured, drive, drive_gain, muscles, reaction_steps, unless_held(driven),
       unless_held(muscle_model), unless_held(pattern), unless_held(support), unless_held(tissue),
       unless_held(model), unless_held(muscle_end)}};
  Cached<InputShapes> input{
      *this,
      "input",
      {motion, boundary, moved_bones, load, drive_gain, gains, muscles, step, end, tolerance}};
  Cached<List<ObstaclePlaces>> places{*this, "obstacle places", {obstacles, bodies}};

  // ----- what each simulator has for itself

  Owned<ReducedFactor> factor{*this, "factor", {pattern, order, prescribed, refill(values)}};
  Owned<fem::Newmark> full{
      *this, "full model", {pattern, order, prescribed, newmark, step, refill(values)}};
  // Gains: the response to the load as it was recorded, and what they add to it.
  Owned<fem::Response> recorded{
      *this,
      "motion as recorded",
      {factor, boundary, moved_bones, load, muscles, newmark, step, end, tolerance}};
  /// The change of each muscle's gain over the greatest of them.
  Checked<std::vector<double>> direction{*this, "direction of the gains", {gains}};
  Owned<fem::Drive> added_drive{
      *this, "drive that gains add", {boundary, load, muscles, direction, step, end, tolerance}};
  Owned<fem::Response> added{
      *this, "motion that gains add", {factor, added_drive, recorded, newmark, step, tolerance}};
  Owned<fem::Response> response{
      *this,
      "reduced motion",
      {factor, input, load, recorded, added_drive, added, gains, newmark, step, tolerance}};
  /// One flag for each place of each obstacle.
  Checked<std::vector<std::vector<char>>> near{*this, "places that come near", {}};
  Owned<ContactModel> contact_model{
      *this,
      "compliance in contact",
      {readout, measured, points, pattern, order, values, contact, places, near}};
  Owned<Stream> stream{*this, "stream", {pattern, order, prescribed, refill(values)}};
  Uncached frames{
      *this,
      "frames",
      {response, full, input, moved_bones, added_volume, contact_model, solver, contact, time}};

  /// Drops the stages that depend on options that differ.
  void options_changed(const SimulationOptions& before, const SimulationOptions& now);
};

}  // namespace hyperex::simulate
