// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "hyperex/scene/scene.hpp"
#include "hyperex/session/changes.hpp"

namespace hyperex::session {

/// The variant that FaceSession::set() changes.
inline constexpr const char* kChanged = "changed";

/// Whether a variant may change the key, since another value needs no new inputs and no new mesh.
bool is_variant_key(const std::string& key);

/// The scene of a session, and changes of its keys. Changes go through the text of a scene file, so
/// that every value is checked as in a file. Errors name a key and its variant, and no place in
/// that text.
class SceneSource {
 public:
  /// A scene that was read. `scene.given` is passed to every scene made from it.
  explicit SceneSource(scene::Scene scene);
  /// A face and a motion in memory (`given`), with keys changed.
  SceneSource(scene::GivenFace given, const Changes& changes);

  const scene::Scene& scene() const { return scene_; }

  /// Replaces the scene.
  void replace(scene::Scene scene);

  /// A copy in which a key of base has another value.
  SceneSource with_value(const std::string& key, const Value& value) const;
  /// A copy with a variant of this name and these changes. It replaces a variant of that name.
  SceneSource with_variant(const std::string& name, const Changes& changes) const;
  /// A copy with one more change of the variant `name`, which is added if it does not exist. `key`
  /// may name a part of a list: "tissue.region[0].young_factor".
  SceneSource with_change(const std::string& name, const std::string& key,
                          const Value& value) const;

 private:
  /// Reads text_. `changed`: keys of base whose values are new; `variant`: the variant that is new.
  void read(const std::string& changed = "", const std::string& variant = "");
  std::string text_now() const;

  scene::Scene scene_;
  std::string text_;  // empty: not yet made from scene_
  scene::GivenFace given_;
};

}  // namespace hyperex::session
