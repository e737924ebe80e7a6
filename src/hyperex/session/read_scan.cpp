// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/read_scan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/anatomy/scan_doubts.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/geometry/turned_triangles.hpp"
#include "hyperex/session/embedded_scan.hpp"
#include "hyperex/session/kept.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "hyperex/tissue/mesh/skin_depth.hpp"

namespace hyperex::session {

void read_scan(const scene::Scene& scene, Inputs& in) {
  if (scene.given.scan) {
    in.scan = *scene.given.scan;
    return;
  }
  if (scene.scan.source.embedded) {
    in.scan = embedded_scan(scene.output.skin_tone);
    return;
  }
  in.scan = io::read_scan(scene.scan.source.file, scene.scan.unit);
  if (in.scan.unit_guessed)
    in.notes.push_back(make_note(
        "scan.unit_guessed",
        fmt::format("the scan's unit is {}; state it with scan.unit", io::unit_note(in.scan))));
}

void note_turned_triangles(const scene::Scene& scene, Inputs& in) {
  if (scene.scan.source.embedded && !scene.given.scan) return;
  if (const std::string doubt = turned_triangles_doubt(in.scan.mesh); !doubt.empty())
    in.notes.push_back(make_warning("scan.turned_triangles", "the scan: " + doubt));
}

io::Landmarks given_landmarks(const scene::Scene& scene) {
  if (!scene.given.landmarks.empty()) return scene.given.landmarks;
  if (!scene.scan.landmarks.empty())
    return io::read_landmarks(scene.scan.landmarks, scene.scan.landmarks_unit);
  if (scene.scan.source.embedded) return anatomy::embedded_face().landmarks;
  return {};
}

void complete_landmarks(const scene::Scene& scene, const io::Landmarks& given, const io::Scan& scan,
                        Inputs& in) {
  const std::string source = scene.scan.source.embedded     ? "embedded face"
                             : scene.scan.landmarks.empty() ? scan.file.string()
                                                            : scene.scan.landmarks.string();
  const std::vector<std::string> known = anatomy::known_landmarks(given).names;
  const auto in_midline = [](const std::string& name) {
    return anatomy::mirrored_landmark(name) == name;
  };
  if (!known.empty() && std::ranges::all_of(known, in_midline))
    throw InputError(
        source,
        fmt::format("its {} landmarks all lie in the midline of the face; expected some of either "
                    "side, as corners of eyes and mouth, or none given: they are then found on the "
                    "scan",
                    known.size()));
  auto completed = completed_landmarks(given, scan, source, scene.kept);
  in.landmarks = std::move(completed.landmarks);
  in.placed = std::move(completed.placed);
  if (!in.placed.empty())
    in.notes.push_back(make_note(
        "landmarks.placed",
        fmt::format("{} of {} landmarks were not given and were placed by fitting the canonical "
                    "face to the {} given ones and the scan",
                    in.placed.size(), in.landmarks.size(), given.size())));
  const std::optional<Note> flat = anatomy::flat_warning(in.landmarks);
  if (!flat)
    if (const auto missing = anatomy::half_missing(given, in.landmarks, scan.mesh))
      throw InputError(scan.file.empty() ? source : scan.file.string(), *missing);
  add(in.notes, flat);
}

void note_tissue_files(const scene::Scene& scene, Inputs& in, bool refuse_variants) {
  const auto note_once = [&](std::vector<Note> notes) {
    for (Note& note : notes)
      if (std::find(in.notes.begin(), in.notes.end(), note) == in.notes.end())
        in.notes.push_back(std::move(note));
  };
  const auto add = [&](const scene::Scene& s) {
    note_once(tissue::notes_on_files(s.tissue, in.scan.mesh));
  };
  note_once(tissue::notes_on_depth_files(scene.mesh, in.scan.mesh));
  add(scene);
  for (const scene::Variant& variant : scene.variants) try {
      if (!(variant.scene.tissue == scene.tissue)) add(variant.scene);
    } catch (const InputError&) {
      if (refuse_variants) throw;  // else the variant is left out when its tissue is set
    }
}

io::Landmarks find_landmarks(const io::Scan& scan, const std::string& why, std::vector<Note>& notes,
                             const KeptResults& kept) {
  FoundLandmarks found = landmarks_on(scan, std::nullopt, kept);
  notes.push_back(make_note(
      "landmarks.found",
      fmt::format(
          "{}: {} were found on the scan in {} pictures, which differ by {:.1f} mm (median) "
          "from their mean; {}hyperex landmarks --picture draws them",
          why, found.landmarks.size(), found.views, 1e3 * found.spread_m,
          found.without_colours ? "the pictures are without the scan's colours, which hide its "
                                  "face; "
                                : "")));
  return std::move(found.landmarks);
}

}  // namespace hyperex::session
