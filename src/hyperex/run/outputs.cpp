// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/report/glb.hpp"
#include "hyperex/run/activations.hpp"
#include "hyperex/run/asymmetry_picture.hpp"
#include "hyperex/run/backing_surfaces.hpp"
#include "hyperex/run/face_box.hpp"
#include "hyperex/run/frames.hpp"
#include "hyperex/run/gaze_table.hpp"
#include "hyperex/run/muscle_picture.hpp"
#include "hyperex/run/skin_colours.hpp"
#include "hyperex/session/thinned_scan.hpp"

namespace hyperex::run {
namespace {
using simulate::Performance;

Points moved(const Performance& p, const PointsF& displacement) {
  return p.skin_rest.points + displacement.cast<double>();
}

/// In double precision: the square of a very small displacement is a denormal number in single
/// precision, which some libraries' threads take for 0 and others do not.
Eigen::VectorXf lengths_mm(const PointsF& d) {
  return (1e3 * d.cast<double>().rowwise().norm()).cast<float>();
}

/// The map at the peak in the face's frame, in which teeth and the mouth's cavity are.
void draw_map(const Results& r, const TriMesh& skin, const Eigen::VectorXf& map_mm,
              const std::string& note, const std::filesystem::path& file) {
  const Performance& p = r.simulation.performance;
  const auto peak = std::size_t(p.peak_frame);
  const face::FaceFrame frame = face::face_frame(r.inputs.landmarks);
  const TriMesh local{frame.local_points(skin.points), skin.triangles};
  io::Landmarks landmarks;
  for (const auto& [name, place] : r.inputs.landmarks) landmarks[name] = frame.local(place);
  const report::FaceBacking backing =
      backing_in_frame(p.skin_rest, r.inputs.landmarks, r.teeth, frame);
  const BackingSurfaces behind(backing, frame, local.points, r.teeth, p.jaw_now_from_rest[peak],
                               p.upper_teeth_now_from_rest, gaze_in(p, peak));
  render::write_png(file, draw_asymmetry(local, map_mm, *r.symmetry.map, landmarks,
                                         "Asymmetry of the motion", note, &behind));
}

/// The skin at the peak in the scan's unit; its own vertices first, in their order.
void write_peak(const Results& r, const std::filesystem::path& directory) {
  const Performance& p = r.simulation.performance;
  const PointsF& d = p.skin_displacement_m[p.peak_frame];
  const TriMesh skin{moved(p, d), p.skin_rest.triangles};
  const metrics::Asymmetry& asymmetry = *r.symmetry.map;
  const Eigen::VectorXf map_mm = metrics::asymmetry_mm(asymmetry.plane, asymmetry.pairs, d);
  if (const auto& full = r.mesh.full) {
    const PointsF all = session::on_full_skin(*full, d);
    const auto on_scan = [&](const Eigen::VectorXf& values) {
      return Eigen::VectorXf(session::on_full_skin(*full, values));
    };
    std::vector<io::VertexScalar> values = {{"displacement_mm", lengths_mm(all)},
                                            {"asymmetry_mm", on_scan(map_mm)}};
    if (r.uncertainty) values.push_back({"uncertainty_mm", on_scan(r.uncertainty->distance_mm)});
    io::write_ply(directory / "skin_peak.ply",
                  {full->skin.points + all.cast<double>(), full->skin.triangles},
                  r.inputs.scan.unit, values);
  } else {
    std::vector<io::VertexScalar> values = {{"displacement_mm", lengths_mm(d)},
                                            {"asymmetry_mm", map_mm}};
    if (r.uncertainty) values.push_back({"uncertainty_mm", r.uncertainty->distance_mm});
    io::write_ply(directory / "skin_peak.ply", skin, r.inputs.scan.unit, values);
  }
  const metrics::AsymmetrySummary& frame = asymmetry.frames[static_cast<std::size_t>(p.peak_frame)];
  std::string note = fmt::format(
      "the face less its reflection, less the same at rest, at {:.2f} s; face rms {:.2f} mm, mouth "
      "rms {:.2f} mm",
      p.frame_time_s[static_cast<std::size_t>(p.peak_frame)], frame.face_rms_mm,
      frame.mouth_rms_mm);
  if (asymmetry.mesh_floor)
    note += fmt::format("; by the mesh and the face's own shape alone {:.2f} and {:.2f} mm",
                        asymmetry.mesh_floor->face_rms_mm, asymmetry.mesh_floor->mouth_rms_mm);
  draw_map(r, skin, map_mm, note, directory / "asymmetry.png");
}

double longest_mm(const PointsF& d) {
  return 1e3 * double(d.rowwise().norm().maxCoeff());
}

std::vector<render::Marker> markers(const Performance& p, const face::FaceFrame& frame) {
  std::vector<render::Marker> list;
  for (Eigen::Index i = 0; i < p.driven_points_rest.rows(); ++i)
    list.push_back({frame.local(p.driven_points_rest.row(i)), render::palette::driven, 3.5});
  return list;
}

struct Still {
  double time_s;
  const PointsF* displacement;
  const Eigen::Isometry3d* jaw;  ///< now_from_rest
};

/// The requested shapes with their times. Times after the end of the run are replaced by its end,
/// without duplicates.
std::vector<Still> stills_of(const Results& r) {
  std::vector<Still> stills;
  const Performance& p = r.simulation.performance;
  if (r.scene.time.still_times_s.empty())
    for (const std::size_t f : spread_frames(p.frame_time_s.size(), std::size_t(p.peak_frame)))
      stills.push_back({p.frame_time_s[f], &p.skin_displacement_m[f], &p.jaw_now_from_rest[f]});
  const std::vector<double> shown =
      shown_times_s(r.scene.time.still_times_s, run_end_s(r.scene, r.inputs));
  for (std::size_t s = 0; s < shown.size(); ++s)
    stills.push_back({shown[s], &r.simulation.still_displacement_m[s],
                      &r.simulation.still_jaw_now_from_rest[s]});
  return stills;
}

/// The skin in the face's box, in all its shapes.
Points framed_points(const Results& r, const std::vector<Still>& stills,
                     const face::FaceFrame& frame) {
  const FaceBox box = face_box(r.inputs.landmarks, frame);
  const Performance& p = r.simulation.performance;
  std::vector<Vec3> kept;
  for (Eigen::Index v = 0; v < p.skin_rest.points.rows(); ++v) {
    const Vec3 rest = p.skin_rest.points.row(v), local = frame.local(rest);
    if (!box.holds(local)) continue;
    kept.push_back(local);
    for (const Still& still : stills)
      kept.push_back(
          frame.local(rest + still.displacement->row(v).transpose().cast<double>().eval()));
  }
  Points points(Eigen::Index(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) points.row(Eigen::Index(i)) = kept[i].transpose();
  return points;
}

bool pull_alike(const simulate::MuscleCourse& a, const simulate::MuscleCourse& b) {
  return a.names == b.names && a.time_s == b.time_s && a.activation == b.activation;
}

}  // namespace

double run_end_s(const scene::Scene& scene, const session::Inputs& inputs) {
  const auto& times = inputs.motion.motion.time_s;
  return scene.time.end_s > 0 ? scene.time.end_s : times.back() - times.front();
}

std::vector<double> shown_times_s(const std::vector<double>& wanted_s, double end_s) {
  std::vector<double> shown;
  for (const double t : wanted_s) {
    const double at = std::min(t, end_s);
    if (shown.empty() || at > shown.back()) shown.push_back(at);
  }
  return shown;
}

std::vector<std::size_t> spread_frames(std::size_t count, std::size_t peak) {
  constexpr std::size_t most = 5;
  const std::size_t wanted = std::min(most, count);
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < wanted; ++i)
    frames.push_back(wanted > 1 ? (i * (count - 1) + (wanted - 1) / 2) / (wanted - 1) : 0);
  if (wanted < 3 || peak == 0 || peak + 1 >= count) return frames;
  // Ends stay: the face at rest and what is left at the end are worth a picture.
  *std::min_element(frames.begin() + 1, frames.end() - 1, [&](std::size_t a, std::size_t b) {
    const auto off = [&](std::size_t f) { return f > peak ? f - peak : peak - f; };
    return off(a) < off(b);
  }) = peak;
  return frames;
}

void write_contact_sheet(const Results& r, const std::filesystem::path& file) {
  const Performance& p = r.simulation.performance;
  const face::FaceFrame frame = face::face_frame(r.inputs.landmarks);
  const std::vector<Still> stills = stills_of(r);
  double top = 1;
  for (const Still& still : stills) top = std::max(top, longest_mm(*still.displacement));

  render::RenderOptions options;
  options.width_px = 280;
  options.height_px = 350;
  const double aspect = double(options.width_px) / options.height_px;
  const Points framed = framed_points(r, stills, frame);
  std::array cameras{render::framing(framed, render::front_view(), aspect),
                     render::framing(framed, render::three_quarter_view(), aspect)};
  // The face as large in either view.
  cameras[0].height_m = cameras[1].height_m = std::max(cameras[0].height_m, cameras[1].height_m);

  const report::FaceBacking backing =
      backing_in_frame(p.skin_rest, r.inputs.landmarks, r.teeth, frame);
  const render::VertexColours skin = skin_colours(p, r.inputs.scan, r.scene.output.skin_tone);

  render::ContactSheet sheet;
  sheet.title = r.scene.title.empty() ? r.inputs.scan.file.filename().string() : r.scene.title;
  sheet.note =
      "displacement of the skin; red: driven points, hollow where hidden; R and L: the subject's "
      "own sides";
  if (p.lip_cut_rest.rows() > 0) sheet.note += "; orange: where the joined lips were cut";
  sheet.columns = static_cast<int>(stills.size()) + 1;
  sheet.bar = render::ColourBar{{0, top}, "displacement (mm)"};
  std::vector<render::Polyline> lines;
  if (p.lip_cut_rest.rows() > 0) lines.push_back({frame.local_points(p.lip_cut_rest)});
  const auto draw = [&](const render::Camera& camera, const Still* still) -> render::SheetPicture {
    const Points shape = still ? moved(p, *still->displacement) : p.skin_rest.points;
    const TriMesh mesh{frame.local_points(shape), p.skin_rest.triangles};
    const BackingSurfaces behind(
        backing, frame, mesh.points, r.teeth, still ? *still->jaw : Eigen::Isometry3d::Identity(),
        still ? p.upper_teeth_now_from_rest : Eigen::Isometry3d::Identity(),
        still && r.inputs.gaze ? std::optional(r.inputs.gaze->at(still->time_s)) : std::nullopt);
    if (!still)
      return {render::render(behind.with({.mesh = mesh, .colours = skin}), camera, options,
                             markers(p, frame), lines),
              "rest", render::side_marks(camera)};
    const render::Surface surface{
        .mesh = mesh, .scalar = 1e3F * still->displacement->rowwise().norm(), .range = {0, top}};
    return {render::render(behind.with(surface), camera, options),
            fmt::format("{:.2f} s", still->time_s), render::side_marks(camera)};
  };
  const std::size_t columns = stills.size() + 1;
  sheet.pictures.resize(cameras.size() * columns);
  run_each(sheet.pictures.size(), [&](std::size_t i) {
    const std::size_t column = i % columns;
    sheet.pictures[i] = draw(cameras[i / columns], column > 0 ? &stills[column - 1] : nullptr);
  });
  render::write_png(file, render::contact_sheet(sheet));
}

nlohmann::ordered_json glb_json(const report::GlbReport& glb) {
  return {{"keys", glb.keys},
          {"largest_error_mm", 1e3 * glb.max_error_m},
          {"size_mb", 1e-6 * glb.bytes}};
}

std::vector<Note> glb_notes(const scene::OutputOptions& output, const report::GlbReport& glb) {
  if (glb.max_error_m <= output.glb_tolerance_m) return {};
  return {make_warning(
      "output.glb_coarse",
      fmt::format("performance.glb shows the motion to {:.2f} mm in place of {:g} mm "
                  "(output.glb_tolerance_mm): "
                  "its {} shape keys fill output.glb_max_mb = {:g}, and a larger one allows more",
                  1e3 * glb.max_error_m, 1e3 * output.glb_tolerance_m, glb.keys, output.glb_max_mb),
      "output.glb_max_mb")};
}

std::optional<report::GlbReport> write_outputs(const Results& r,
                                               const std::filesystem::path& directory,
                                               const Results* base) {
  const Performance& p = r.simulation.performance;
  std::optional<report::GlbReport> glb;
  Progress progress("writing pictures and files", 0);
  run_together(
      {[&] {
         if (r.scene.output.vtu) write_frames(r, directory);
       },
       [&] { write_contact_sheet(r, directory / "contact_sheet.png"); },
       [&] {
         if (r.scene.output.glb)
           glb = report::write_glb(directory / "performance.glb", p, r.inputs.scan,
                                   {r.scene.output.glb_tolerance_m, 1e6 * r.scene.output.glb_max_mb,
                                    r.teeth, r.scene.output.skin_tone, r.backing});
       },
       [&] {
         write_peak(r, directory);
         if (r.tissue) write_tissue_map(r, directory / "tissue_map.png");
         motion::write_motion_csv(directory / "motion.csv", p.landmarks);
         if (!base && !p.gaze.empty()) write_gaze_csv(directory / "gaze.csv", p);
         metrics::write_symmetry_csv(directory / "symmetry.csv", r.symmetry);
         if (!p.muscles.names.empty()) {
           write_activations_csv(directory / "activations.csv", p.muscles);
           if (!base || !pull_alike(p.muscles, base->simulation.performance.muscles))
             render::write_png(
                 directory / "muscles.png",
                 draw_muscles(r.mesh, r.inputs.landmarks, p.muscles, r.scene.muscles.table()));
         }
         metrics::write_excursions_csv(directory / "excursions.csv", r.symmetry.excursions);
       }});
  return glb;
}

}  // namespace hyperex::run
