// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files and face sessions: what `hyperex run` and `hyperex check` do, and the parts of it.
#include "hyperex/scene/scene.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "bind.hpp"
#include "callbacks.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/log_note.hpp"
#include "hyperex/session/remarks_json.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/uncertainty/budget_outputs.hpp"
#include "hyperex/uncertainty/face_budget.hpp"
#include "meshes.hpp"
#include "obstacles.hpp"
#include "performance.hpp"

namespace hyperex::python {
namespace {

using Path = std::filesystem::path;

/// Arrays and numbers of numpy as Python's own, and numbers that JSON lacks as text, which the key
/// then refuses by its name. What is nested deeper than `levels` stays as it is.
py::object plain(const py::handle& value, int levels = 64) {
  auto same = py::reinterpret_borrow<py::object>(value);
  if (levels == 0) return same;
  if (py::hasattr(value, "tolist")) return plain(value.attr("tolist")(), levels - 1);
  if (PyFloat_Check(value.ptr()) && !std::isfinite(PyFloat_AsDouble(value.ptr())))
    return py::str(value);
  if (py::isinstance<py::dict>(value)) {
    py::dict out;
    for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value))
      out[key] = plain(item, levels - 1);
    return out;
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    py::list out;
    for (const py::handle item : value) out.append(plain(item, levels - 1));
    return out;
  }
  return same;
}

std::string json_of(const py::handle& value) {
  return py::module_::import("json").attr("dumps")(plain(value)).cast<std::string>();
}

session::Changes changes_of(const py::dict& changes) {
  session::Changes out;
  for (const auto& [key, value] : changes)
    out.emplace(key.cast<std::string>(), session::Value::from_json(json_of(value)));
  return out;
}

py::object loaded(const nlohmann::ordered_json& json) {
  return py::module_::import("json").attr("loads")(
      json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

py::object run(const Path& file, const Path& out, const py::dict& changes) {
  const std::vector<std::string> overrides = overrides_of(changes_of(changes));
  nlohmann::ordered_json summary;
  {
    const py::gil_scoped_release unlocked;
    summary = run::run_scene(scene::read_scene(file, overrides), out);
  }
  return loaded(summary);
}

/// The result of one run of a session.
struct PythonResult {
  session::FaceResult result;
  std::shared_ptr<RunResult> performance;
};

/// Python holds each performance by itself.
std::unique_ptr<RunResult> copied(const RunResult& run) {
  return std::make_unique<RunResult>(run);
}

/// A face session of Python's. Its notes go to the logger as they are found.
class PythonSession {
 public:
  PythonSession(const Path& file, const py::dict& changes)
      : PythonSession([overrides = overrides_of(changes_of(changes)), &file] {
          return session::FaceSession(scene::read_scene(file, overrides), logged());
        }) {}
  PythonSession(const Face& face, const motion::Motion& motion, const py::dict& changes)
      : PythonSession([&face, &motion, own = changes_of(changes)] {
          return session::FaceSession({face.scan, face.landmarks}, motion, own, logged());
        }) {}

  const session::FaceSession& session() const { return session_; }

  PythonResult run(py::object progress, py::object cancelled) {
    return called(std::move(progress), std::move(cancelled),
                  [&](const simulate::RunCallbacks& callbacks) { return session_.run(callbacks); });
  }
  PythonResult variant(const std::string& name, const py::dict& changes, py::object progress,
                       py::object cancelled) {
    const session::Changes own = changes_of(changes);
    return called(std::move(progress), std::move(cancelled),
                  [&](const simulate::RunCallbacks& callbacks) {
                    return session_.variant(name, own, callbacks);
                  });
  }
  void set(const std::string& key, const py::object& value) {
    const session::Value own = session::Value::from_json(json_of(value));
    const py::gil_scoped_release unlocked;
    session_.set(key, own);
  }

  py::object error_budget(py::object progress, py::object cancelled) {
    Callbacks callbacks(std::move(progress), std::move(cancelled));
    nlohmann::ordered_json out;
    try {
      const py::gil_scoped_release unlocked;
      session_.run({.progress = {}, .cancelled = callbacks.for_run().cancelled});
      session_.find_certainty(callbacks.for_run().cancelled);
      out = uncertainty::budget_json(uncertainty::face_budget(session_, callbacks.for_run()));
    } catch (const simulate::Cancelled&) {
      callbacks.rethrow_if_any();
      throw;
    }
    callbacks.rethrow_if_any();
    return loaded(out);
  }

  SharedTissueMesh mesh() const {
    return std::const_pointer_cast<tissue::TissueMesh>(session_.shared_mesh());
  }
  Face face() const {
    return {session_.scan(), session_.inputs().landmarks, session_.inputs().placed};
  }
  py::dict variants() const {
    py::dict all;
    for (std::size_t i = 0; i < session_.variants().size(); ++i)
      all[py::str(session_.variants()[i].scene.title)] = py::cast(session_.options(i + 1));
    return all;
  }
  std::vector<std::string> texts(Severity severity) const {
    return texts_of(session_.notes(), severity);
  }

 private:
  template <class Open>
  explicit PythonSession(Open open)
      : session_([&] {
          const py::gil_scoped_release unlocked;
          return open();
        }()) {}

  static session::SessionOptions logged() { return {.note = session::log_note}; }

  template <class Call>
  PythonResult called(py::object progress, py::object cancelled, Call call) {
    Callbacks callbacks(std::move(progress), std::move(cancelled));
    std::optional<session::FaceResult> result;
    try {
      const py::gil_scoped_release unlocked;
      result = call(callbacks.for_run());
    } catch (const simulate::Cancelled&) {
      callbacks.rethrow_if_any();
      throw;
    }
    callbacks.rethrow_if_any();
    auto performance = std::make_shared<RunResult>();
    performance->result = *result->simulation;
    performance->mesh = session_.shared_mesh();
    return {*std::move(result), std::move(performance)};
  }

  session::FaceSession session_;
};

void bind_note(py::module_& m) {
  py::class_<Note>(m, "Note", "One remark on a run (docs/notes.md).")
      .def_readonly("id", &Note::id, "Stable: \"lips.pass_through\".")
      .def_property_readonly(
          "severity",
          [](const Note& note) { return note.severity == Severity::warning ? "warning" : "note"; },
          "\"note\" or \"warning\".")
      .def_readonly("text", &Note::text, "One sentence.")
      .def_readonly("key", &Note::key, "The scene's key that it is about, or empty.")
      .def_readonly("variant", &Note::variant, "The variant that it is about, or empty.")
      .def("__repr__", [](const Note& note) { return "<hyperex.Note " + note.id + ">"; });
}

void bind_measures_of_a_result(py::module_& m) {
  py::class_<metrics::SymmetryMeasures>(m, "SymmetryMeasures", "Of one motion (docs/symmetry.md).")
      .def_readonly("curve", &metrics::SymmetryMeasures::curve, "S(t).")
      .def_readonly("excursions", &metrics::SymmetryMeasures::excursions,
                    "Of the corners of the mouth and all pairs of points.");
}

void bind_files_of_a_result(py::module_& m) {
  m.def(
      "write_glb",
      [](const Path& file, const PythonResult& r, double tolerance_m) {
        session::write_glb(file, r.result, tolerance_m);
      },
      "file"_a, "result"_a, "tolerance_m"_a = 1e-4, Unlocked(),
      "A FaceResult as animated glTF, with its teeth.");
  m.def(
      "write_skin_ply",
      [](const Path& file, const PythonResult& r) { session::write_skin_ply(file, r.result); },
      "file"_a, "result"_a, Unlocked(),
      "The skin of a FaceResult at its peak, in the scan's unit.");
  m.def(
      "write_motion_csv",
      [](const Path& file, const PythonResult& r) { session::write_motion_csv(file, r.result); },
      "file"_a, "result"_a, Unlocked(), "The landmarks of a FaceResult over time.");
}

using SessionClass = py::class_<PythonSession, std::shared_ptr<PythonSession>>;

SessionClass bind_session(py::module_& m) {
  using S = PythonSession;
  py::class_<PythonResult, std::shared_ptr<PythonResult>>(m, "FaceResult",
                                                          "What one run of a face session gave.")
      .def_property_readonly("name", [](const PythonResult& r) { return r.result.name; })
      .def(
          "performance", [](const PythonResult& r) { return copied(*r.performance); },
          "The moving face.")
      .def(
          "measures", [](const PythonResult& r) { return r.result.measures(); },
          "SymmetryMeasures, with error bands.")
      .def_property_readonly(
          "notes", [](const PythonResult& r) { return r.result.notes; }, "Of the whole session.")
      .def("__repr__",
           [](const PythonResult& r) { return "<hyperex.FaceResult " + r.result.name + ">"; });
  SessionClass bound(
      m, "FaceSession",
      "A face from its inputs to its results, each stage kept until something that it depends on "
      "changes. Notes go to the logger as they are found.");
  bound
      .def(py::init<const Path&, const py::dict&>(), "file"_a, "changes"_a = py::dict(),
           "Reads a scene file and everything that it names, and meshes the tissue.")
      .def(py::init<const Face&, const motion::Motion&, const py::dict&>(), "face"_a, "motion"_a,
           "changes"_a = py::dict(), "The same for a face and a recorded motion.")
      .def("run", &S::run, "progress"_a = py::none(), "cancelled"_a = py::none(),
           "A FaceResult: the face with all changes of set(). Callbacks as of Simulator.run().")
      .def("set", &S::set, "key"_a, "value"_a,
           "Another value of a scene's key, as \"tissue.young_kpa\" or "
           "\"tissue.region[0].young_factor\". Where forces drive, base's forces are kept.")
      .def("variant", &S::variant, "name"_a, "changes"_a, "progress"_a = py::none(),
           "cancelled"_a = py::none(), "Runs a variant with these changes; a FaceResult.")
      .def(
          "performance", [](S& s) { return copied(*s.run(py::none(), py::none()).performance); },
          "The moving face of the last run; runs first where that is not up to date.")
      .def(
          "measures", [](S& s) { return s.run(py::none(), py::none()).result.measures(); },
          "SymmetryMeasures of the last run, likewise.")
      .def("error_budget", &S::error_budget, "progress"_a = py::none(), "cancelled"_a = py::none(),
           "How certain the excursions of the corners of the mouth are, in base and in all "
           "variants, with all errors (docs/uncertainty.md): what `error_budget` of summary.json "
           "has, as a dict. Runs the face some twelve times more.")
      .def(
          "notes", [](const S& s) { return s.session().notes(); },
          "What was assumed, repaired and found so far: a list of Note.")
      .def(
          "warnings", [](const S& s) { return s.session().warnings(); }, "Those to be looked at.");
  return bound;
}

void bind_parts(SessionClass bound, py::module_& m) {
  using S = PythonSession;
  bound.def_property_readonly("face", &S::face)
      .def_property_readonly("mesh", &S::mesh)
      .def_property_readonly("motion", [](const S& s) { return s.session().inputs().motion; })
      .def_property_readonly(
          "mirrored_motion", [](const S& s) { return s.session().mirrored_motion(); },
          "The motion mirrored in the face's midsagittal plane, for a simulator's twin: what "
          "`twin` "
          "of excursions_of() takes.")
      .def_property_readonly(
          "options", [](const S& s) { return s.session().options(0); },
          "SimulationOptions of base, a copy.")
      .def_property_readonly(
          "obstacles", [](const S& s) { return Obstacles{s.session().obstacles()}; },
          "Teeth and eyeballs, if a face has contact.teeth or contact.eyes.")
      .def_property_readonly("variants", &S::variants,
                             "Name -> SimulationOptions of each variant, for "
                             "Simulator.set_options().")
      .def_property_readonly(
          "expected_error_mm",
          [](const S& s) -> py::object {
            const metrics::SkinUncertainty* known = s.session().skin_uncertainty();
            return known ? py::cast(known->distance_mm) : py::none();
          },
          "Per vertex of the skin, once base was run: its expected distance from the true face, "
          "due to what the driven points do not determine. None where shapes of real faces do "
          "not take part.")
      .def_property_readonly(
          "uncertainty",
          [](const S& s) -> py::object {
            const session::FaceSession& session = s.session();
            const metrics::SkinUncertainty* known = session.skin_uncertainty();
            if (!known) return py::none();
            return loaded(metrics::json_of(*known, session.simulation().performance.skin_rest,
                                           session.inputs().landmarks));
          },
          "Per region, once base was run: what `uncertainty` of summary.json has, as a dict. Its "
          "expected error and the share of its motion's variance that the driven points "
          "determine. None where shapes of real faces do not take part.")
      .def_property_readonly(
          "jitter_m", [](const S& s) { return s.session().inputs().jitter_m; },
          "Jitter of the recorded points; 0: none known.")
      .def(
          "simulator",
          [simulator = py::object(m.attr("Simulator"))](const S& s) {
            const session::Inputs& inputs = s.session().inputs();
            py::object made =
                simulator(s.mesh(), inputs.landmarks, inputs.motion, s.session().options(0));
            made.attr("set_obstacles")(Obstacles{s.session().obstacles()});
            return made;
          },
          "A Simulator of base.");
}

/// A scene file, read: a face session whose notes are sentences.
struct PythonScene : PythonSession {
  using PythonSession::PythonSession;
};

void bind_scene_class(py::module_& m) {
  py::class_<PythonScene, PythonSession, std::shared_ptr<PythonScene>>(
      m, "Scene",
      "A scene file, read: face, mesh, motion and options, made ready. A FaceSession "
      "whose notes and warnings are lists of sentences.")
      .def(py::init<const Path&, const py::dict&>(), "file"_a, "changes"_a = py::dict(),
           "Reads everything that the scene names (a camera's recording is tracked, which takes "
           "long) and meshes the tissue. `changes`: {\"tissue.young_kpa\": 300}.")
      .def_property_readonly("notes", [](const PythonScene& s) { return s.texts(Severity::note); })
      .def_property_readonly("warnings",
                             [](const PythonScene& s) { return s.texts(Severity::warning); });
}

py::object checked(const Path& file, const py::dict& changes) {
  const std::vector<std::string> overrides = overrides_of(changes_of(changes));
  std::vector<Note> found;
  {
    const py::gil_scoped_release unlocked;
    found = session::check(scene::read_scene(file, overrides));
  }
  return py::dict("notes"_a = texts_of(found, Severity::note),
                  "warnings"_a = texts_of(found, Severity::warning),
                  "remarks"_a = loaded(session::remarks_json(found)));
}

}  // namespace

void bind_scene(py::module_& m) {
  bind_note(m);
  bind_measures_of_a_result(m);
  bind_parts(bind_session(m), m);
  bind_scene_class(m);
  bind_files_of_a_result(m);
  m.def("run_scene", &run, "file"_a, "out"_a, "changes"_a = py::dict(),
        "What `hyperex run` does: writes all outputs into the folder `out` and returns the content "
        "of summary.json as a dict. `changes`: {\"tissue.young_kpa\": 300}. Ctrl-C ends it when it "
        "is done.");
  m.def(
      "check_scene", &checked, "file"_a, "changes"_a = py::dict(),
      "What `hyperex check` does: reads everything, meshes the tissue, simulates nothing; {notes, "
      "warnings, remarks}.");
}

}  // namespace hyperex::python
