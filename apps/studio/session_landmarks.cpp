// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/fold_landmarks.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/muscles/fold_pull.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "session.hpp"

namespace hyperex::studio {

json Session::move_landmark(const json& fields) {
  const io::Landmarks& known = require_face().inputs().landmarks;
  const std::string name = fields.at("name");
  io::Landmarks all = known;
  if (!known.count(name)) {
    const io::Landmarks by_rule = muscles::fold_places(face_->session().mesh(), known);
    const auto found = by_rule.find(name);
    if (found == by_rule.end()) throw InputError(name + ": no landmark of this face");
    all.insert(*found);
  }
  const io::Scan& scan = face_->inputs().scan;
  if (!scan_) scan_.emplace(scan.mesh);
  std::vector<std::string> names{name};
  if (const std::string other = face::other_name(name); known.count(other)) names.push_back(other);
  for (const std::string& one : names) moved_.erase(one);
  if (fields.contains("position")) {
    const json& at = fields.at("position");
    const bool sound =
        at.is_array() && at.size() == 3 && std::all_of(at.begin(), at.end(), [](const json& x) {
          return x.is_number() && std::abs(x.get<double>()) < 1e3;
        });
    if (!sound) throw InputError("position: expected [x, y, z] in metres");
    const Vec3 place(at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
    for (const std::string& one : names) moved_[one] = scan_->query(place).point;
  }
  for (const auto& [one, place] : moved_) all[one] = place;
  const Vec3 now = all.at(name);
  std::vector<std::string> warnings = anatomy::fold_landmark_problems(all);
  if (names.size() > 1) all.erase(names[1]);  // one doubt per place, under the requested name
  for (std::string& text : texts_of(anatomy::landmark_doubts(all, scan.mesh)))
    warnings.push_back(std::move(text));
  return {{"position", {now.x(), now.y(), now.z()}}, {"warnings", warnings}};
}

json Session::landmarks_done(const json&) {
  io::Landmarks all = require_face().inputs().landmarks;
  for (const auto& [name, place] : moved_) all[name] = place;
  // A new name each time, so that undo finds the previous file.
  const fs::path file = options_.folder / fmt::format("landmarks-{}.mrk.json", ++landmark_files_);
  io::write_landmarks(file, all, face_->inputs().scan.unit);
  std::string text = scene::with_value(now_.text, "scan.landmarks", file.string());
  text = scene::with_value(text, "scan.landmarks_unit", nullptr);
  commit(text);
  moved_.clear();
  return json::object();
}

}  // namespace hyperex::studio
