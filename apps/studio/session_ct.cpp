// SPDX-License-Identifier: GPL-3.0-or-later
// A CT as the scan and the bones of a face.
#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/ct/outputs.hpp"
#include "hyperex/ct/read_series.hpp"
#include "hyperex/ct/summary.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "session.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {
namespace {

Vec3 point_of(const json& fields, const char* name) {
  const json& value = fields.at(name);
  const bool fits =
      value.is_array() && value.size() == 3 &&
      std::all_of(value.begin(), value.end(), [](const json& one) { return one.is_number(); });
  if (!fits) throw InputError(std::string(name) + ": expected three numbers, metres");
  return Vec3(value[0], value[1], value[2]);
}

}  // namespace

bool Session::is_ct(const fs::path& file) {
  return ending_of(file) == ".zip" || ct::is_volume_file(file);
}

fs::path Session::write_bones(const ct::CtFace& face) {
  const fs::path folder = options_.folder / unused_name(options_.folder, "ct");
  fs::create_directories(folder);
  report_progress("writing the surfaces of the CT");
  ct::write_ct(face, folder);
  for (const std::string& note : face.notes) log("note", note);
  for (const std::string& warning : face.warnings) log("warning", warning);
  for (const std::string& line : ct::summary_lines(face)) log("note", line);
  return folder;
}

void Session::open_ct(const fs::path& file, const fs::path& recording) {
  report_progress("reading the CT");
  ct::SeriesVolume series = ct::read_series(file);
  report_progress("finding skin, skull and jaw");
  ct::CtFace face = ct::face_of_series(std::move(series));
  const fs::path folder = write_bones(face);
  std::string text = scan_scene(folder / "skin.ply", recording);
  text = scene::with_value(text, "title", "A face from a CT");
  text = scene::with_value(text, "scan.unit", "mm");
  text = scene::with_value(text, "anatomy.ct", fs::absolute(folder).string());
  open_text(text, options_.folder / "scene.toml");
  ct_ = std::make_unique<OpenCt>(std::move(face.series));
}

OpenCt& Session::require_ct() {
  if (!ct_ || require_face().scene().anatomy.ct.empty())
    throw InputError("the open face is not of a CT that was opened in this session");
  return *ct_;
}

void Session::send_ct_pictures() {
  const fs::path folder = require_face().scene().anatomy.ct;
  report::BinaryBlock block;
  json pictures = json::object();
  if (!folder.empty())
    for (const char* name : {"slices", "bones_through_skin", "thickness"}) {
      const fs::path file = folder / (std::string(name) + ".png");
      if (!fs::is_regular_file(file)) continue;
      const std::string bytes = read_file(file);
      pictures[name] = block.add("uint8", bytes.data(), bytes.size());
    }
  json head = {{"event", "ct"}, {"pictures", pictures}, {"measured", ct_ && !folder.empty()}};
  if (const auto bone_hu = bone_hu_of(folder)) head["bone_hu"] = *bone_hu;
  send_(binary_message(head, block), true, "ct");
}

json Session::ct_bones(const json& fields) {
  OpenCt& ct = require_ct();
  ct::CtOptions options = ct.options_of(face_->scene().anatomy.ct);
  if (fields.contains("skull") != fields.contains("mandible"))
    throw InputError("skull and mandible are given together; expected both or neither");
  if (fields.contains("skull"))
    options.seeds = ct::Seeds{point_of(fields, "skull"), point_of(fields, "mandible")};
  if (fields.contains("bone_hu")) options.bone_hu = fields.at("bone_hu");
  report_progress("finding the bones anew");
  const fs::path folder = write_bones(ct::face_of_series(ct::SeriesVolume(ct.series()), options));
  ct.options_of(fs::absolute(folder)) = options;
  commit(scene::with_value(now_.text, "anatomy.ct", fs::absolute(folder).string()));
  report_progress("");
  return json::object();
}

json Session::ct_slice(const json& fields) {
  const int axis = fields.at("axis");
  const OpenCt::Slice slice =
      require_ct().slice(face_->scene().anatomy.ct, axis, fields.at("share"));
  const std::vector<std::uint8_t> png = render::png_bytes(slice.picture);
  report::BinaryBlock block;
  const json head = {{"event", "ct_slice"},
                     {"axis", axis},
                     {"caption", slice.caption},
                     {"picture", block.add("uint8", png.data(), png.size())}};
  send_(binary_message(head, block), true, "");
  return {{"superseded", false}};
}

}  // namespace hyperex::studio
