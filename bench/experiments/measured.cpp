// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/measured.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/pictures.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/regions.hpp"

namespace hyperex::bench {
namespace {

constexpr double kScale_mm = 26;  // as in the thesis

struct Peak {
  TriMesh skin;
  Eigen::VectorXf displacement_mm;
  double time_s = 0;
};

Peak peak_of(Study& study) {
  const auto result = study.simulate(study.own_trial());
  const simulate::Performance& p = result.performance;
  const PointsF& d = p.skin_displacement_m[std::size_t(p.peak_frame)];
  return {moved_skin(p, d), 1e3F * d.rowwise().norm(), p.frame_time_s[std::size_t(p.peak_frame)]};
}

/// Mouth; nose and cheeks; the rest of the face; all of it.
std::vector<metrics::Region> parts_of_face(const Points& rest, const io::Landmarks& landmarks) {
  const metrics::Regions regions = metrics::regions_of(rest, landmarks);
  std::vector<int> part(std::size_t(rest.rows()), -1);
  const auto mark = [&](const char* name, int value) {
    if (const metrics::Region* region = regions.find(name))
      for (const int v : region->vertices) part[std::size_t(v)] = value;
  };
  mark("face", 2);
  mark("cheeks", 1);
  mark("nose", 1);
  mark("lips", 0);
  std::vector<metrics::Region> parts = {
      {"mouth", {}}, {"nose and cheeks", {}}, {"rest of the face", {}}, {"whole face", {}}};
  for (std::size_t v = 0; v < part.size(); ++v)
    if (part[v] >= 0) {
      parts[std::size_t(part[v])].vertices.push_back(int(v));
      parts[3].vertices.push_back(int(v));
    }
  return parts;
}

double mean_of(const Eigen::VectorXd& values, const std::vector<int>& vertices) {
  double sum = 0;
  for (const int v : vertices) sum += values[v];
  return sum / double(vertices.size());
}

/// The scan that the face is compared with.
struct SecondScan {
  TriMesh open, truth;
};

MeasuredWay way_of(const std::string& name, const Study& study, const Peak& peak,
                   const SecondScan& second) {
  const Points& rest = study.inputs().scan.mesh.points;
  const Eigen::Index count = rest.rows();
  const Points own = peak.skin.points.topRows(count);
  const Eigen::VectorXd closest = metrics::distance_to_surface(own, second.open);
  const Eigen::VectorXd corresponding =
      metrics::distance_to_corresponding(own, second.truth.points, count);
  const Eigen::VectorXd moved = (own - rest).rowwise().norm();
  const Eigen::VectorXd truth = (second.truth.points.topRows(count) - rest).rowwise().norm();
  MeasuredWay way{name, 0, {}};
  for (const metrics::Region& part : parts_of_face(rest, study.inputs().landmarks)) {
    const auto over = std::count_if(part.vertices.begin(), part.vertices.end(),
                                    [&](int v) { return closest[v] > 0.010; });
    way.regions.push_back({part.name, 1e3 * mean_of(moved, part.vertices),
                           1e3 * mean_of(truth, part.vertices),
                           metrics::statistics_of(closest, part.vertices),
                           metrics::statistics_of(corresponding, part.vertices),
                           double(over) / double(part.vertices.size())});
    if (part.name != "whole face" || over == 0) continue;
    const double chin = study.frame().local(study.inputs().landmarks.at(face::ibug(8))).y();
    const auto below = std::count_if(part.vertices.begin(), part.vertices.end(), [&](int v) {
      return closest[v] > 0.010 && study.frame().local(rest.row(v)).y() < chin;
    });
    way.over_below_chin = double(below) / double(over);
  }
  return way;
}

/// Millimetres for all vertices; NaN for those appended by a lip cut.
Eigen::VectorXf in_mm(const Eigen::VectorXd& distance_m, Eigen::Index count) {
  Eigen::VectorXf all = Eigen::VectorXf::Constant(count, std::nanf(""));
  all.head(distance_m.size()) = (1e3 * distance_m).cast<float>();
  return all;
}

void draw_overlay(const Study& study, const Peak& peak, const SecondScan& second,
                  const std::filesystem::path& file) {
  constexpr double top_mm = 10;
  const FacePictures pictures(study);
  const Eigen::Index count = study.inputs().scan.mesh.points.rows(), all = peak.skin.points.rows();
  const Points own = peak.skin.points.topRows(count);
  const Eigen::VectorXf closest = in_mm(metrics::distance_to_surface(own, second.open), all);
  const Eigen::VectorXf corresponding =
      in_mm(metrics::distance_to_corresponding(own, second.truth.points, count), all);
  const render::Colour scan{0.35, 0.55, 0.80};
  render::ContactSheet sheet;
  sheet.title = "The deformed face over the second scan, which holds the open mouth";
  sheet.note = "left: skin colour where the deformed face is in front, blue where the scan is";
  sheet.columns = 3;
  sheet.bar = render::ColourBar{{0, top_mm}, "distance (mm)", true};
  for (const Vec3& view : {render::front_view(), render::three_quarter_view()}) {
    const bool front = view == render::front_view();
    sheet.pictures.push_back(
        {pictures.draw({{.mesh = peak.skin}, {.mesh = second.open, .plain = scan}}, view),
         front ? "both" : ""});
    sheet.pictures.push_back(
        {pictures.draw({{.mesh = peak.skin, .scalar = closest, .range = {0, top_mm}}}, view),
         front ? "to the closest point of the scan" : ""});
    sheet.pictures.push_back(
        {pictures.draw({{.mesh = peak.skin, .scalar = corresponding, .range = {0, top_mm}}}, view),
         front ? "to where the same point truly went" : ""});
  }
  write_jpeg(file, render::contact_sheet(sheet));
}

std::vector<MeasuredWay> all_ways(const Setting& setting, const Study& study, const Peak& peak,
                                  const SecondScan& second) {
  const std::filesystem::path scene = setting.scene(1, true);
  const std::string truth =
      (setting.data / "rgbd/subject_A_mouth_open/truth_landmarks68_camera_m.csv").string();
  std::vector<MeasuredWay> ways = {way_of("tracked mesh (the experiment)", study, peak, second)};
  Study true_points(scene, {"motion.file=" + truth});
  ways.push_back(
      way_of("the true 68 points in its place", true_points, peak_of(true_points), second));
  Study physics(scene, {"region.measured=none"});
  ways.push_back(way_of("seven tracked points and physics", physics, peak_of(physics), second));
  return ways;
}

}  // namespace

std::vector<MeasuredFace> measured_deformation(const Setting& setting) {
  render::ContactSheet sheet;
  sheet.title = "Measured deformation, coloured by displacement";
  sheet.columns = 4;
  std::vector<MeasuredFace> faces;
  double largest_mm = 0;
  for (const bool subject_a : setting.faces()) {
    Stopwatch watch;
    Study study(setting.scene(1, subject_a));
    MeasuredFace face;
    face.name = study.name();
    face.read_s = watch.lap();
    const Peak peak = peak_of(study);
    const motion::Motion& motion = study.inputs().motion.motion;
    face.vertices = int(peak.skin.points.rows());
    face.frames = int(motion.time_s.size());
    face.points = int(motion.names.size());
    face.peak_s = peak.time_s;
    face.largest_mm = double(peak.displacement_mm.maxCoeff());
    largest_mm = std::max(largest_mm, face.largest_mm);
    const FacePictures pictures(study);
    for (const Vec3& view : {render::front_view(), render::three_quarter_view()})
      sheet.pictures.push_back(
          {pictures.draw(
               {{.mesh = peak.skin, .scalar = peak.displacement_mm, .range = {0, kScale_mm}}},
               view),
           fmt::format("{}, {:.2f} s", face.name, peak.time_s)});
    if (subject_a) {
      const SecondScan second{io::read_mesh(setting.data / "ict/subject_A_mouth_open_scan.ply",
                                            io::LengthUnit::millimetre),
                              io::read_mesh(setting.data / "ict/subject_A_mouth_open_truth.ply",
                                            io::LengthUnit::millimetre)};
      draw_overlay(study, peak, second, setting.pictures / "experiment_1_overlay.jpg");
      face.ways = all_ways(setting, study, peak, second);
    }
    faces.push_back(std::move(face));
  }
  sheet.bar = render::ColourBar{{0, kScale_mm}, "displacement (mm)", largest_mm > kScale_mm};
  write_jpeg(setting.pictures / "experiment_1_displacement.jpg", render::contact_sheet(sheet));
  return faces;
}

}  // namespace hyperex::bench
