// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/face_rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/expression/gaze.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/rig/correctives.hpp"
#include "hyperex/rig/lid_doubts.hpp"
#include "hyperex/rig/shape_motion.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/scene_source.hpp"
#include "hyperex/simulate/drive/jaw.hpp"

namespace hyperex::rig {
namespace {

using report::RigShape;

/// A frame falls on each pose's time.
constexpr double kFrameRate_hz = 5;
/// Weight at which open mouths with open and closed lips are compared.
constexpr double kClosedAt = 0.7;
/// A jaw that turns by less is taken as not moving.
constexpr double kJaw_rad = 0.005;
/// Sections of a scene whose keys may change a rig.
constexpr const char* kSections[] = {"tissue", "muscles", "contact", "support", "mesh", "teeth"};

/// Lids follow a gaze up or down, and none aside.
bool moves_skin(const std::string& shape) {
  return !shape.starts_with("eyeLookIn") && !shape.starts_with("eyeLookOut") &&
         shape != "tongueOut";
}

const Recipe* recipe_for(const std::string& name, const std::vector<Recipe>& recipes) {
  const auto at = std::ranges::find(recipes, name, &Recipe::name);
  return at == recipes.end() ? nullptr : &*at;
}

bool is_of_arkit(const std::string& name) {
  return std::ranges::find(expression::arkit_shapes(), name) != expression::arkit_shapes().end();
}

/// The weights of ARKit's shapes at weight 1 of the rig's shape of this name.
std::vector<std::pair<std::string, double>> weights_of(const std::string& name,
                                                       const std::vector<Recipe>& recipes) {
  if (const Recipe* own = recipe_for(name, recipes)) return own->weights;
  return {{name, 1.0}};
}

/// The poses that are simulated, by name: every shape that moves skin alone, recipes, those of
/// mouthClose, and pairs at the end, so that the former ones stay where they are.
std::vector<Pose> poses_of(Correctives correctives, const std::vector<Recipe>& recipes,
                           std::map<std::string, std::size_t>& place) {
  std::vector<Pose> poses;
  const auto add = [&](const std::string& name, Pose pose) {
    place[name] = poses.size();
    poses.push_back(std::move(pose));
  };
  for (const std::string& shape : expression::arkit_shapes())
    if (recipe_for(shape, recipes) || (moves_skin(shape) && shape != "mouthClose"))
      add(shape, {.weights = weights_of(shape, recipes)});
  for (const Recipe& recipe : recipes)
    if (!is_of_arkit(recipe.name)) add(recipe.name, {.weights = recipe.weights});
  add("open", {.weights = {{"jawOpen", kClosedAt}}});
  add("closed", {.weights = {{"jawOpen", kClosedAt}, {"mouthClose", kClosedAt}}});
  if (correctives == Correctives::of_clashing_pairs)
    for (const expression::ShapePair& pair : clashing_pairs()) {
      auto both = weights_of(pair.first, recipes);
      for (const auto& weight : weights_of(pair.second, recipes)) both.push_back(weight);
      add(expression::corrective_name(pair), {.weights = std::move(both)});
    }
  return poses;
}

/// The shape that each pose is of. There is one pose per second (motion_through()).
std::vector<std::string> shapes_of(const std::map<std::string, std::size_t>& place) {
  std::vector<std::string> shapes(place.size());
  for (const auto& [name, at] : place)
    shapes[at] = name == "open" || name == "closed" ? "mouthClose" : name;
  return shapes;
}

/// The simulated shapes as those of the rig.
class Shapes {
 public:
  Shapes(const simulate::Performance& performance, const std::vector<Recipe>& recipes,
         std::map<std::string, std::size_t> frame)
      : performance_(performance), recipes_(recipes), frame_(std::move(frame)) {}

  RigShape named(const std::string& name) const {
    RigShape shape{.name = name};
    shape.displacement_m = PointsF::Zero(skin("open").rows(), 3);
    for (const auto& [one, weight] : weights_of(name, recipes_)) turn_eye(shape, one, weight);
    if (recipe_for(name, recipes_)) {
      shape.displacement_m = skin(name);
      shape.jaw_now_from_rest = jaw(name);
    } else if (name == "mouthClose") {
      shape.displacement_m = (skin("closed") - skin("open")) / float(kClosedAt);
    } else if (moves_skin(name)) {
      shape.displacement_m = skin(name);
      shape.jaw_now_from_rest = jaw(name);
    }
    return shape;
  }

  /// What the face that shows a pair adds to the sum of its two. `shapes`: the 52.
  RigShape corrective(const expression::ShapePair& pair,
                      const std::vector<RigShape>& shapes) const {
    const auto place = [&](const std::string& name) {
      return std::size_t(std::ranges::find(shapes, name, &RigShape::name) - shapes.begin());
    };
    RigShape shape{.name = expression::corrective_name(pair)};
    shape.corrects = std::array{place(pair.first), place(pair.second)};
    shape.displacement_m = skin(shape.name);
    Eigen::Matrix4d added_by_jaw = jaw(shape.name).matrix() - Eigen::Matrix4d::Identity();
    for (const std::size_t one : *shape.corrects) {
      shape.displacement_m -= shapes.at(one).displacement_m;
      added_by_jaw -= shapes[one].jaw_now_from_rest.matrix() - Eigen::Matrix4d::Identity();
    }
    shape.jaw_now_from_rest.matrix() += added_by_jaw;
    return shape;
  }

 private:
  static void turn_eye(RigShape& shape, const std::string& arkit, double weight) {
    const auto gaze = expression::gaze_of_shape(arkit);
    if (!gaze || weight == 0) return;
    auto& eye = arkit.ends_with("Left") ? shape.left_eye : shape.right_eye;
    if (!eye) eye = expression::Gaze{0, 0};
    eye->up_rad += weight * gaze->up_rad;
    eye->left_rad += weight * gaze->left_rad;
  }
  Eigen::Affine3d jaw(const std::string& pose) const {
    const Eigen::Isometry3d& now = performance_.jaw_now_from_rest.at(frame_.at(pose));
    const bool turns =
        pose.starts_with("jaw") || Eigen::AngleAxisd(now.linear()).angle() > kJaw_rad;
    return turns ? Eigen::Affine3d(now) : Eigen::Affine3d::Identity();
  }
  /// From the face at rest, which added volume may have changed.
  PointsF skin(const std::string& pose) const {
    const PointsF& moved = performance_.skin_displacement_m.at(frame_.at(pose));
    const PointsF& rest = performance_.neutral_displacement_m;
    return rest.rows() > 0 ? PointsF(moved - rest) : moved;
  }
  const simulate::Performance& performance_;
  const std::vector<Recipe>& recipes_;
  std::map<std::string, std::size_t> frame_;
};

/// A scan with closed eyes has no lids to move: their shapes are taken away, with a note.
void close_eyes(FaceRig& rig, const io::Landmarks& landmarks) {
  const Points& skin = rig.performance.skin_rest.points;
  const auto open = report::open_eyes(report::face_backing(rig.performance), skin, landmarks);
  for (const auto& [side, is_open] : {std::pair{"Right", open[0]}, {"Left", open[1]}}) {
    if (is_open) continue;
    for (RigShape& shape : rig.shapes)
      if (shape.name.starts_with("eye") && shape.name.ends_with(side)) {
        shape.displacement_m.setZero();
        shape.left_eye = shape.right_eye = std::nullopt;
      }
    rig.closed_eyes.emplace_back(side);
  }
}

/// Whether a note is about the scan, its tissue or its shapes. Others are about the recording that
/// make_rig() makes itself, how it drives the face, and keys that a rig does not take.
bool concerns_the_scan(const Note& note) {
  constexpr const char* of_the_recording[] = {"recording.", "head.", "time.", "drive.", "forces."};
  return note.id != "tissue.large_strain" &&
         std::ranges::none_of(of_the_recording,
                              [&](const char* start) { return note.id.starts_with(start); });
}

void refuse_other_keys(const session::Changes& changes) {
  for (const auto& [key, value] : changes)
    if (const std::string section = key.substr(0, key.find('.'));
        std::ranges::find(kSections, section) == std::end(kSections))
      throw InputError({"the rig's scene", 0, key, value.json(),
                        "a key of tissue, muscles, contact, support, mesh or teeth"});
}

/// make_rig(), with recipes that may move the lids of a closed eye.
FaceRig rig_of(session::Face face, const session::Changes& changes,
               const std::function<void(const Note&)>& report, Correctives correctives,
               const std::vector<Recipe>& recipes) {
  std::map<std::string, std::size_t> place;
  std::vector<Pose> poses = poses_of(correctives, recipes, place);
  motion::Motion motion = motion_through(poses);
  session::Changes all = {{"drive.points", "all"},
                          {"contact.lips", true},
                          {"time.step_s", 0.02},
                          {"time.frame_rate_hz", kFrameRate_hz}};
  for (const auto& [key, value] : changes) all.insert_or_assign(key, value);
  scene::GivenFace given;
  given.scan = std::make_shared<const io::Scan>(std::move(face.scan));
  given.landmarks = std::move(face.landmarks);
  given.motion = std::make_shared<const motion::Motion>(std::move(motion));
  given.of_weights = true;
  const std::vector<std::string> shapes = shapes_of(place);
  const auto in_shape = [&](int frame) {
    return "in the shape " + shapes.at(std::size_t(frame / kFrameRate_hz));
  };
  session::FaceSession session(
      session::SceneSource(std::move(given), all).scene(),
      {.certainty = session::Certainty::on_request, .note = report, .frame_words = in_shape});
  session.run_base();
  for (auto& [name, at] : place) at = std::size_t(std::lround(poses[at].time_s * kFrameRate_hz));
  const Shapes simulated(session.simulation().performance, recipes, std::move(place));
  FaceRig rig;
  rig.scan = std::make_shared<const io::Scan>(session.inputs().scan);
  rig.teeth = session.teeth();
  rig.jaw_axis_m =
      simulate::JawHinge(session.inputs().landmarks, session.mesh().bones.get()).centre;
  for (const std::string& name : expression::arkit_shapes())
    rig.shapes.push_back(simulated.named(name));
  for (const Recipe& recipe : recipes)
    if (!is_of_arkit(recipe.name)) rig.shapes.push_back(simulated.named(recipe.name));
  if (correctives == Correctives::of_clashing_pairs)
    for (const expression::ShapePair& pair : clashing_pairs())
      rig.shapes.push_back(simulated.corrective(pair, rig.shapes));
  rig.lips =
      std::make_shared<const simulate::LipSurfaces>(session.mesh(), session.inputs().landmarks);
  rig.performance = session.simulation().performance;
  close_eyes(rig, session.inputs().landmarks);
  const bool sides_alike = std::ranges::all_of(session.scene().muscles.gains,
                                               [](const auto& gain) { return gain.gain == 1; });
  for (const Note& one : lid_doubts(rig.performance.skin_rest.points, session.inputs().landmarks,
                                    rig.shapes, sides_alike))
    report(one);
  return rig;
}

}  // namespace

FaceRig make_rig(session::Face face, const session::Changes& changes,
                 const std::function<void(const Note&)>& note, Correctives correctives,
                 const std::vector<Recipe>& recipes) {
  refuse_other_keys(changes);
  std::set<std::string> reported;
  const auto report_once = [&](const Note& one) {
    if (note && concerns_the_scan(one) && reported.insert(one.text).second) note(one);
  };
  FaceRig rig = rig_of(face, changes, report_once, correctives, recipes);
  // Which eyes are closed is known after the scan was prepared.
  const std::vector<Recipe> still = without_eyes(recipes, rig.closed_eyes);
  return still == recipes ? rig : rig_of(face, changes, report_once, correctives, still);
}

}  // namespace hyperex::rig
