// SPDX-License-Identifier: GPL-3.0-or-later
// Motions: read, made from arrays, prepared and aligned.
#include <algorithm>
#include <map>
#include <set>

#include "arrays.hpp"
#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "options_class.hpp"
#include "refuse.hpp"
#include "warn_user.hpp"

namespace hyperex::python {
namespace {

using motion::Motion;
using Path = std::filesystem::path;
using Names = std::vector<std::string>;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

Motion make_motion(const Names& names, const std::vector<double>& time_s, const Array& positions_m,
                   const std::string& source) {
  if (positions_m.ndim() != 3 || positions_m.shape(0) != py::ssize_t(time_s.size()) ||
      positions_m.shape(1) != py::ssize_t(names.size()) || positions_m.shape(2) != 3)
    refuse("positions_m",
           "an array of shape " + py::str(positions_m.attr("shape")).cast<std::string>(),
           fmt::format("({}, {}, 3): times, names, axes", time_s.size(), names.size()));
  if (names.empty()) refuse("names", "none", "at least one point");
  if (time_s.empty()) refuse("time_s", "none", "at least one sample");
  std::set<std::string> seen;
  for (const std::string& name : names)
    if (!seen.insert(name).second) refuse("names", name, "each name once");
  for (std::size_t k = 0; k < time_s.size(); ++k)
    if (!std::isfinite(time_s[k]) || (k > 0 && time_s[k] <= time_s[k - 1]))
      refuse("time_s", fmt::format("{:g} at sample {}", time_s[k], k), "rising numbers (s)");
  Motion motion;
  motion.names = names;
  motion.time_s = time_s;
  motion.source = source;
  const auto points = static_cast<Eigen::Index>(names.size());
  for (std::size_t k = 0; k < time_s.size(); ++k)
    motion.positions.emplace_back(
        Eigen::Map<const Points>(positions_m.data(py::ssize_t(k)), points, 3));
  return motion;
}

/// N x 3 of one point.
Points path_of(const Motion& motion, const std::string& name) {
  const int column = motion.index_of(name);
  if (column < 0) throw py::key_error(name);
  Points path(Eigen::Index(motion.time_s.size()), 3);
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    path.row(Eigen::Index(k)) = motion.positions[k].row(column);
  return path;
}

py::array head_pose(const Motion& motion) {
  py::array_t<double> poses({motion.head_pose.size(), std::size_t(4), std::size_t(4)});
  for (std::size_t k = 0; k < motion.head_pose.size(); ++k)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) poses.mutable_at(k, i, j) = motion.head_pose[k].matrix()(i, j);
  return poses;
}

Motion stabilised(const Motion& motion, const Names& rigid_points) {
  motion::StabiliseOptions options;
  options.rigid_points = rigid_points;
  return motion::stabilise(motion, options).motion;
}

Motion filled(const Motion& motion, double max_gap_s) {
  if (!(max_gap_s >= 0)) refuse("max_gap_s", fmt::format("{:g}", max_gap_s), "a number from 0 (s)");
  motion::GapOptions options;
  options.max_gap_s = max_gap_s;
  return motion::fill_gaps(motion, options).motion;
}

simulate::AlignedMotion aligned(const Motion& motion, const io::Landmarks& landmarks,
                                const std::string& method) {
  return simulate::align(motion, landmarks, from_word<simulate::AlignmentMethod>("method", method));
}

/// A motion that is still throughout is meant so; a tiny one is probably in another unit.
bool ever_moves(const Motion& motion) {
  return std::any_of(motion.positions.begin(), motion.positions.end(),
                     [&](const Points& sample) { return sample != motion.positions.front(); });
}

simulate::AlignedMotion prepared(const Motion& motion, const io::Landmarks& landmarks,
                                 double max_gap_s, const Names& rigid_points, bool still_head,
                                 const std::string& method) {
  if (still_head && !rigid_points.empty())
    refuse("rigid_points", fmt::format("{}", fmt::join(rigid_points, ", ")),
           "none, as still_head leaves the head where it is");
  const session::CleanedRecording cleaned = session::cleaned_recording(motion);
  warn_user(cleaned.warnings);
  const Motion whole = filled(cleaned.motion, max_gap_s);
  const Motion steady =
      still_head ? motion::with_still_head(whole).motion : stabilised(whole, rigid_points);
  if (const auto far = session::check_steady(steady)) warn_user({*far});
  if (ever_moves(motion))
    if (const auto tiny = session::stillness_warning(steady, false)) warn_user({*tiny});
  return aligned(steady, landmarks, method);
}

void bind_class(py::module_& m) {
  py::class_<Motion>(m, "Motion", "Named points over time.")
      .def(py::init(&make_motion), "names"_a, "time_s"_a, "positions_m"_a, "source"_a = "",
           "P names, N rising times (s) and N x P x 3 positions (metres; NaN where not measured). "
           "`source` is named in messages.")
      .def_readonly("names", &Motion::names, "P names.")
      .def_property_readonly(
          "time_s", [](const py::object& self) { return view(self.cast<Motion&>().time_s, self); },
          "N times, s, rising.")
      .def_property_readonly(
          "positions_m",
          [](const Motion& self) {
            return stacked(self.positions, Eigen::Index(self.names.size()));
          },
          "N x P x 3, metres; NaN where not measured. A copy.")
      .def_property_readonly(
          "head_pose", &head_pose,
          "N x 4 x 4, the pose that was taken out, metres; N is 0 where none was.")
      .def_readonly("source", &Motion::source)
      .def_readonly("unit_note", &Motion::unit_note, "Which length unit was read, and why.")
      .def("__getitem__", &path_of, "name"_a, "N x 3, metres: the way of one point.")
      .def("__contains__",
           [](const Motion& self, const std::string& name) { return self.index_of(name) >= 0; })
      .def("at", &Motion::at, "time_s"_a, "P x 3, metres: all points, linear between samples.")
      .def("__len__", [](const Motion& self) { return self.time_s.size(); })
      .def("__repr__", [](const Motion& self) {
        return fmt::format("<hyperex.Motion of {} points, {} samples{}>", self.names.size(),
                           self.time_s.size(), self.source.empty() ? "" : ", " + self.source);
      });
  py::class_<simulate::AlignedMotion>(m, "AlignedMotion",
                                      "A motion without the head's own, in the frame of a scan.")
      .def_readonly("motion", &simulate::AlignedMotion::motion, "In the scan's frame.")
      .def_property_readonly(
          "rest_m",
          [](const py::object& self) {
            return view(self.cast<simulate::AlignedMotion&>().rest, self);
          },
          "P x 3, metres: the points at the first sample.")
      .def_readonly("rms_mm", &simulate::AlignedMotion::rms_mm,
                    "Of the common landmarks after the similarity.")
      .def_readonly("common", &simulate::AlignedMotion::common, "Landmarks that both sides name.")
      .def("__repr__", [](const simulate::AlignedMotion& self) {
        return fmt::format("<hyperex.AlignedMotion of {} points, {} samples, {:.1f} mm off>",
                           self.motion.names.size(), self.motion.time_s.size(), self.rms_mm);
      });
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_class(m);
  m.def(
      "read_motion",
      [](const Path& file, const std::optional<std::string>& unit) {
        return motion::read_motion(file, unit_from(unit));
      },
      "file"_a, "unit"_a = py::none(), Unlocked(),
      "Reads named points over time from .csv or .trc. The unit (mm, cm or m) is the file's, "
      "else guessed.");
  m.def("write_motion_csv", &motion::write_motion_csv, "file"_a, "motion"_a, Unlocked(),
        "time_s, NAME_x_mm, NAME_y_mm, NAME_z_mm ...");
  m.def(
      "embedded_mouth_opening",
      [](const io::Landmarks& landmarks, double peak_deg, double duration_s, double rate_hz,
         bool head_moves) {
        return motion::embedded_mouth_opening(landmarks,
                                              {peak_deg, duration_s, rate_hz, head_moves});
      },
      "landmarks"_a, "peak_deg"_a = 13.0, "duration_s"_a = 2.7, "rate_hz"_a = 30.0,
      "head_moves"_a = true, Unlocked(), "A mouth that opens and closes once, made for any face.");
  m.def("fill_gaps", &filled, "motion"_a, "max_gap_s"_a = 0.2, Unlocked(),
        "Interpolates where points were not measured; longer gaps are an error.");
  m.def("stabilise", &stabilised, "motion"_a, "rigid_points"_a = Names{}, Unlocked(),
        "Takes the head's own motion out, found from `rigid_points` or from the whole face.");
  m.def(
      "with_rest",
      [](const Motion& motion, double from_s, double to_s) {
        return motion::with_rest(motion, {from_s, to_s}).motion;
      },
      "motion"_a, "from_s"_a, "to_s"_a, Unlocked(),
      "The motion, preceded by a transition from rest. The face is at rest from from_s to to_s (s "
      "from the start). Stabilise first.");
  m.def(
      "with_point_gains",
      [](const Motion& motion, const std::map<std::string, double>& gains) {
        std::vector<motion::PointGain> list;
        for (const auto& [point, gain] : gains) list.push_back({point, gain});
        return motion::with_point_gains(motion, list);
      },
      "motion"_a, "gains"_a, Unlocked(),
      "Displacements of the named points multiplied: {name: gain}.");
  m.def("time_scaled", &motion::time_scaled, "motion"_a, "scale"_a, Unlocked(),
        "The same way in `scale` times the time.");
  m.def("align", &aligned, "motion"_a, "landmarks"_a, "method"_a = "nonrigid", Unlocked(),
        "A stabilised motion without gaps, carried into the scan's frame; `method` is nonrigid, "
        "similarity or normalised.");
  m.def("prepare_motion", &prepared, "motion"_a, "landmarks"_a, py::kw_only(), "max_gap_s"_a = 0.2,
        "rigid_points"_a = Names{}, "still_head"_a = false, "method"_a = "nonrigid", Unlocked(),
        "What `hyperex run` does with a recording: wild readings left out (UserWarning) or refused "
        "(InputError), fill_gaps, stabilise, align. A UserWarning says where no point of a motion "
        "goes "
        "0.05 mm: its unit is probably not metres.");
}

}  // namespace hyperex::python
