// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/page.hpp"

#include <fmt/format.h>

namespace hyperex::bench {
std::string measured_section(const std::vector<MeasuredFace>& faces, const std::string& pictures) {
  std::string page = fmt::format(
      "\n## Experiment 1: measured deformation\n"
      "`examples/experiment_1_embedded.toml`, `bench/scenes/experiment_1_subject_a.toml`. Every "
      "vertex "
      "follows the tracked\ntriangle that it is matched to; nothing is simulated.\n\n"
      "![Displacement at the peak]({}/experiment_1_displacement.jpg)\n\n"
      "| | vertices | frames | tracked points | peak, s | largest displacement, mm |\n"
      "|---|---|---|---|---|---|\n",
      pictures);
  for (const MeasuredFace& face : faces)
    page += fmt::format("| {} | {} | {} | {} | {:.2f} | {:.1f} |\n", face.name, face.vertices,
                        face.frames, face.points, face.peak_s, face.largest_mm);
  for (const MeasuredFace& face : faces) {
    if (face.ways.empty()) continue;
    page += fmt::format(
        "\n**Against the second scan** of {0}, which holds the open mouth (other noise, no "
        "correspondence), and against the\ntruth, which knows where each vertex went. The first "
        "flatters: skin that slides along itself costs nothing.\n\n"
        "![The deformed face over the second scan]({1}/experiment_1_overlay.jpg)\n\n"
        "| driven by | part | moved, true | moved, ours | to the scan: mean / median / 95 % / most "
        "| "
        "farther than 10 mm | to the truth: mean / median / 95 % / most |\n"
        "|---|---|---|---|---|---|---|\n",
        face.name, pictures);
    for (const MeasuredWay& way : face.ways)
      for (const MeasuredRegion& part : way.regions)
        page += fmt::format(
            "| {} | {} | {:.2f} | {:.2f} | {:.2f} / {:.2f} / {:.2f} / {:.2f} | {:.2f} % | {:.2f} / "
            "{:.2f} / {:.2f} / {:.2f} |\n",
            way.name, part.name, part.truth_moved_mm, part.moved_mm, part.closest.mean_mm,
            part.closest.median_mm, part.closest.p95_mm, part.closest.max_mm, 100 * part.over_10_mm,
            part.corresponding.mean_mm, part.corresponding.median_mm, part.corresponding.p95_mm,
            part.corresponding.max_mm);
    page +=
        "\nAll in mm, at the peak. Parts as `hyperex compare` has them: mouth within 15 mm of the "
        "lips' points, nose within\n12 mm and cheeks within 22 mm of theirs, the face within 40 mm "
        "of any of the 68 points.\n";
  }
  return page;
}

std::string physics_section(const std::vector<PhysicsFace>& faces, const std::string& pictures) {
  std::string page = fmt::format(
      "\n## Experiment 2: mouth opening by physics\n"
      "`examples/experiment_2_embedded.toml`, `bench/scenes/experiment_2_subject_a.toml`.\n\n"
      "![The mouth at the thesis' five times]({}/experiment_2_times.jpg)\n\n"
      "Red: the driven points; blue: some of the nodes that are held. Which points the thesis "
      "drives and holds is not\nlegible; ours are the seven of `drive.points`, a held border and "
      "bones to slide on.\n\n"
      "| | nodes | tetrahedra | driven points (nodes) | nodes on the skull | on the mandible | "
      "eta / G, ms |\n|---|---|---|---|---|---|---|\n",
      pictures);
  for (const PhysicsFace& f : faces)
    page += fmt::format("| {} | {} | {} | {} ({}) | {} | {} | {:.1f} |\n", f.name, f.nodes, f.tets,
                        f.driven_points, f.driven_nodes, f.skull_nodes, f.mandible_nodes,
                        f.relaxation_ms);
  page +=
      "\n**Does the tissue come late?** Each run is held against one with a hundredth of the "
      "viscosity and the mass, which\nfollows its input at once. The lag is that of landmarks "
      "which "
      "move by more than a millimetre and lie off all\ndriven patches, by cross-correlation "
      "([symmetry.md](symmetry.md)). Below 0 a point runs ahead: it moves by the\ndifference of "
      "inputs that pull it either way. *Behind* is the greatest distance of any vertex from the "
      "run "
      "without\ndelay, over time, and in the last frame.\n\n"
      "| face | element | viscous tensor | eta, Pa s | lag, ms: median (least to most) | behind, "
      "mm "
      "| in the last frame, mm | from the first row, mm | largest displacement, mm | turned inside "
      "out |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const PhysicsFace& f : faces)
    for (const auto* rows : {&f.elements, &f.viscosities})
      for (const PhysicsRow& r : *rows) {
        if (rows == &f.viscosities && &r == &rows->front()) continue;  // shown already
        page += fmt::format(
            "| {} | `{}` | {} | {:.1f} | {:.2f} ({:.2f} to {:.2f}) | {:.3f} | {:.4f} | {:.3f} | "
            "{:.2f} | {} |\n",
            f.name, r.element, r.form, r.viscosity_pa_s, r.lag_median_ms, r.lag_least_ms,
            r.lag_most_ms, r.behind_mm, r.behind_at_end_mm, r.from_base_mm, r.largest_mm,
            r.inverted_tets);
      }
  page += fmt::format(
      "\n{}. Reduced models, estimated error at most: {} of the largest displacement.\n",
      of_each(faces, [](const PhysicsFace& f) { return fmt::format("{} landmarks", f.landmarks); }),
      of_each(faces,
              [](const PhysicsFace& f) { return fmt::format("{:.0e}", f.estimated_error); }));
  return page;
}

std::string models_section(const std::vector<ModelsFace>& faces, const std::string& pictures) {
  std::string page =
      "\n## Experiment 3: three tissues\n"
      "`examples/experiment_3_embedded.toml`, `bench/scenes/experiment_3_subject_a.toml`: the "
      "preset "
      "`source_model_1` and two\nvariants, which differ at the right crista philtri superior "
      "(cphs) "
      "alone. The thesis' \"cheek\" is not among its\nlandmarks; ours is `cheek_L` and `cheek_R`, "
      "the middle of the cheek ([landmarks.md](landmarks.md)).\n\n";
  for (const ModelsFace& f : faces)
    page += fmt::format("![Three models, {}]({}/experiment_3_maps_{}.jpg)\n\n", f.name, pictures,
                        f.name == "subject A" ? "subject_a" : "embedded");
  page +=
      "| face | models | largest distance, mm | at, from the right cphs | rms at the end, mm | "
      "within 25 mm of the right cphs | half of it within | within 25 mm of the mouth's middle | "
      "change of displacement within 10 mm of the cphs, mm | lag there, ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ModelsFace& f : faces)
    for (const ModelPair& p : f.pairs)
      page += fmt::format(
          "| {} | {} | {:.3f} | {:.1f} mm | {:.4f} | **{:.0f} %** | {:.1f} mm | {:.0f} % | {:+.4f} "
          "of {:.2f} | {:+.2f} |\n",
          f.name, p.name, p.largest_mm, p.largest_from_cphs_mm, p.rms_at_end_mm,
          100 * p.share_near_cphs, p.half_radius_mm, 100 * p.share_near_mouth, p.change_mm,
          p.moved_mm, p.lag_ms);
  page += fmt::format(
      "\nShares are of the summed squared distance (greatest over time, weighted with area); of "
      "the "
      "skin's area as much as\n{} lies within 25 mm of the right cphs. The change is the mean of "
      "\\|u_b\\| - \\|u_1\\| at the end, below 0 where model b moves\nless; single points differ "
      "by {}. "
      "Reduced models, estimated error at most: {}.\n",
      of_each(faces,
              [](const ModelsFace& f) { return fmt::format("{:.1f} %", 100 * f.area_share); }),
      of_each(faces,
              [](const ModelsFace& f) {
                return fmt::format("{:+.3f} to {:+.3f} mm (model 2), {:+.3f} to {:+.3f} mm (3)",
                                   f.pairs[0].most_less_mm, f.pairs[0].most_more_mm,
                                   f.pairs[1].most_less_mm, f.pairs[1].most_more_mm);
              }),
      of_each(faces,
              [](const ModelsFace& f) { return fmt::format("{:.4f} mm", f.estimated_error_mm); }));
  page += fmt::format(
      "\n### S(t)\n![S(t) of the three models]({}/experiment_3_symmetry.png)\n\n"
      "With D = xi_L - xi_R, S = ln |D|. What the tissue does is D_2 - D_1 and D_3 - D_1; D_1 is "
      "the face's and the\nmotion's own. The motion mirrored tells these two apart: what keeps its "
      "sign is of the face (scan, landmarks, mesh),\nwhat changes it is of the motion.\n\n"
      "| face | D_1, D_2, D_3 at the end, x 1000 | D_1: of face and mesh | of the motion | least "
      "size "
      "of D_1 "
      "from 0.1 s on | S from 0.1 s on | noise floor at the end | jitter at which models 2 and 3 "
      "are told apart |\n|---|---|---|---|---|---|---|---|\n",
      pictures);
  for (const ModelsFace& f : faces)
    page += fmt::format(
        "| {} | {:.3f}, {:.3f}, {:.3f} | {:.3f} | {:.3f} | {:.3f} at {:.2f} s | {:.1f} to {:.1f} | "
        "{} | {:.1f} um |\n",
        f.name, 1e3 * f.difference_at_end[0], 1e3 * f.difference_at_end[1],
        1e3 * f.difference_at_end[2], 1e3 * f.own_mesh, 1e3 * f.own_motion, 1e3 * f.own_least,
        f.own_least_s, f.s_least, f.s_most,
        f.jitter_mm > 0 ? fmt::format("{:.1f} ({:.2f} mm of jitter)", f.noise_floor, f.jitter_mm)
                        : fmt::format("none, exact input ({:.1f} for 0.3 mm)", f.noise_floor),
        1e3 * f.jitter_to_tell_mm);
  page +=
      "\n**From the mesh or from the tissue?** The same on other meshes. The embedded face and its "
      "motion "
      "are symmetric, so all of\nits D_1 is the mesh's, whose elements are not the same on either "
      "side. On a real face most of it is the face's own\nshape (docs/symmetry.md). " +
      of_each(faces,
              [](const ModelsFace& f) {
                return std::string(by_mesh(f.meshes) ? "D_1 changes its sign with the mesh"
                                                     : "D_1 keeps its sign") +
                       (tissue_stays(f.meshes)
                            ? ", what the tissue adds keeps its sign and, to a factor of two, its "
                              "size"
                            : ", what the tissue adds changes its sign or by more than a factor of "
                              "two: S(t) tells nothing of such small changes there");
              }) +
      ".\n\n"
      "| face | element size, mm | tetrahedra | D_1 at the end, x 1000 | D_2 - D_1, x 1000 | D_3 - "
      "D_1, x 1000 |\n|---|---|---|---|---|---|\n";
  for (const ModelsFace& f : faces)
    for (const MeshRow& r : f.meshes)
      page += fmt::format("| {} | {:.1f} | {} | {:.3f} | {:.4f} | {:.4f} |\n", f.name, r.element_mm,
                          r.tets, 1e3 * r.own, 1e3 * r.added_2, 1e3 * r.added_3);
  page += fmt::format(
      "\n**What parts the curves**, tried: the spread is the greatest S of the three less the "
      "least. "
      "In the window of the\nthesis, {:.2f} to {:.2f} s, lies {} of the time.\n\n"
      "| face | condition | element | viscous tensor | D_2 - D_1, x 1000 | D_3 - D_1, x 1000 | "
      "greatest spread of S | at, s | mean in the window | share in the window |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      kSourceWindow_s[0], kSourceWindow_s[1],
      faces.empty() ? ""
                    : fmt::format("{:.0f} %", 100 * (kSourceWindow_s[1] - kSourceWindow_s[0]) /
                                                  faces.front().end_s));
  for (const ModelsFace& f : faces)
    for (const SpreadRow& r : f.rows)
      page += fmt::format(
          "| {} | {} | `{}` | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.4f} | {:.0f} % |\n",
          f.name, r.condition, r.element, r.form, 1e3 * r.tissue_2, 1e3 * r.tissue_3, r.spread,
          r.spread_at_s, r.spread_in_window, 100 * r.share_in_window);
  return page;
}

std::string experiments_page(const Experiments& all, const PageHead& head) {
  std::string page = fmt::format(
      "# The thesis' three experiments\n\n"
      "Written by `make experiments` at commit {}: every figure below comes from that run, none is "
      "typed. {}.\n\n"
      "H. Kato, *Hyper-expression with feature tracking* (thesis), reports three experiments. Its "
      "scans and recordings are\nnot public, so each is done here on two faces. One comes with the "
      "program: an exact motion, symmetric by construction.\nThe other is subject A: a scan, a "
      "depth "
      "camera's recording that the program tracks, a second scan and the truth,\nall rendered. "
      "What is compared is what happens and how large it is, not digit by digit. One experiment "
      "is\none command, and its report a page to turn and play:\n\n"
      "```sh\nhyperex run examples/experiment_3_embedded.toml --out out/experiment_3\n```\n\n",
      head.commit, head.machine);
  if (all.measured.size() < 2)
    page += "**Subject A's data was not there: what rests on it is left out below.**\n\n";
  page += point_by_point(all);
  page += measured_section(all.measured, head.pictures);
  page += physics_section(all.physics, head.pictures);
  page += models_section(all.models, head.pictures);
  page += same_forces_section(all.same_forces);
  page +=
      "\n## What the thesis leaves open, and what stands here\n"
      "* **Driven and held**: not legible there. Seven points around mouth and chin, each a patch "
      "of skin; the border held;\n  bones to slide on; the mandible follows the chin.\n"
      "* **30 Hz input, steps of 1 or 2 ms**: a C2 spline through the recorded frames, at rest at "
      "both ends.\n"
      "* **Interpolation** of the named points: linear over triangles of points, as the thesis' "
      "likely is; with "
      "the harmonic\n  field ([tissue.md](tissue.md)) the tissue changes xi_L - xi_R by less: " +
      of_each(all.models,
              [](const ModelsFace& f) {
                return fmt::format("{:.0f} %",
                                   100 * f.rows.back().tissue_2 / f.rows.front().tissue_2);
              }) +
      " of that.\n"
      "* **Element**: `tet4-star`, which does not lock at nu = 0.495; `tet4`, the thesis', beside "
      "it ([elements.md](elements.md)).\n"
      "* **Viscous tensor**: Stokes' law; the printed one, which is not isotropic, beside it.\n"
      "* **The base of the logarithm**: natural.\n";
  return page;
}

}  // namespace hyperex::bench
