// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/run_scene.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/run/earlier_run.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/run/report_page.hpp"
#include "hyperex/run/setting_words.hpp"
#include "hyperex/run/summary.hpp"
#include "hyperex/run/variants.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/log_note.hpp"
#include "hyperex/session/remarks_json.hpp"
#include "hyperex/session/run_cost.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/uncertainty/budget_outputs.hpp"

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;

Json seconds_json(const session::FaceSession& session) {
  const session::StageSeconds stages = session.seconds();
  const simulate::SimulationReport& report = session.simulation().report;
  return {{"read", stages.read},         {"mesh", stages.mesh},
          {"tissue", stages.tissue},     {"assemble", report.assemble_s},
          {"analyse", report.analyse_s}, {"factor", report.factor_s},
          {"basis", report.basis_s},     {"simulate", report.simulate_s}};
}

/// Notes name files as their paths are given; summary and report name the files alone, unless the
/// scene asks for paths.
void name_files(const scene::Scene& scene, std::vector<Note>& notes) {
  for (Note& note : notes) note.text = scene::with_file_names(scene, note.text);
}

/// Base's own files are written on one core while the variants are simulated on the other.
struct Written {
  std::optional<report::GlbReport> glb;
  Json variants;
};
Written write_files(session::FaceSession& session, Results& results,
                    const std::filesystem::path& directory,
                    const std::function<bool()>& cancelled) {
  Written out;
  run_together({[&] { out.glb = write_outputs(results, directory); },
                [&] {
                  if (results.scene.output.report)
                    results.modes = report::displacement_modes(
                        results.simulation.performance.skin_displacement_m);
                },
                [&] {
                  session.run_variants({.progress = {}, .cancelled = cancelled});
                  if (!session.variants().empty())
                    out.variants =
                        write_variants(results, session.variants(), session.mesh(), directory);
                }});
  return out;
}

void write_summary(Json& summary, const std::filesystem::path& directory) {
  // A later run into the same folder removes these and nothing else.
  std::vector<std::string> files = files_below(directory);
  files.push_back("summary.json");
  summary["files"] = files;
  write_file_atomically(directory / "summary.json", [&](std::ostream& stream) {
    // A path need not be UTF-8.
    stream << summary.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  });
}

Json write_into(session::FaceSession& session, Stopwatch& total,
                const std::filesystem::path& directory, const std::function<bool()>& cancelled) {
  const auto stop_here = [&] {
    if (cancelled && cancelled()) throw simulate::Cancelled();
  };
  stop_here();
  session.run_base({.progress = {}, .cancelled = cancelled});
  Stopwatch stage;
  Results results = results_of(session);
  Json summary = summary_of(session, results);
  const Written written = write_files(session, results, directory, cancelled);
  stop_here();
  session.find_certainty(cancelled);
  results.notes = session.notes();
  if (!written.variants.is_null()) summary["variants"] = written.variants;
  double budget_s = 0;
  if (results.scene.output.error_budget) {
    Stopwatch watch;
    const uncertainty::FaceBudget budget =
        uncertainty::face_budget(session, {.progress = {}, .cancelled = cancelled});
    uncertainty::write_budget_csv(directory / "error_budget.csv", budget);
    summary["error_budget"] = uncertainty::budget_json(budget);
    for (const std::string& sentence : uncertainty::corner_sentences(budget))
      results.notes.push_back(make_note("run.error_budget", sentence));
    budget_s = watch.lap();
  }
  if (written.glb) {
    summary["glb"] = glb_json(*written.glb);
    for (const Note& note : glb_notes(results.scene.output, *written.glb)) {
      session::log_note(note);
      results.notes.push_back(note);
    }
  }
  name_files(results.scene, results.notes);
  Json seconds = seconds_json(session);
  if (!written.variants.is_null()) seconds["variants"] = session.seconds().variants;
  if (budget_s > 0) seconds["error_budget"] = budget_s;
  seconds["export"] = stage.lap() - session.seconds().variants - budget_s;
  seconds["total"] = total.lap();
  summary["seconds"] = seconds;
  summary["notes"] = texts_of(results.notes);
  summary["warnings"] = texts_of(results.notes, Severity::warning);
  summary["remarks"] = session::remarks_json(results.notes);
  summary["options"] = options_in_use(results.scene, results.inputs);
  if (results.scene.output.report) {
    write_report(results, session.variants(), summary, directory);
    summary["seconds"]["export"] = seconds["export"].get<double>() + stage.lap();
    summary["seconds"]["total"] = seconds["total"].get<double>() + total.lap();
  }
  write_summary(summary, directory);
  return summary;
}

/// Says that results will go, before the run begins: it may be a mistake in --out.
void announce_replacing(const OutputDirectory& out, const std::filesystem::path& directory,
                        bool with_variants) {
  const std::set<std::string>& earlier = out.earlier_files();
  if (earlier.empty()) return;
  const bool variants = std::ranges::any_of(
      earlier, [](const std::string& file) { return file.starts_with("variants/"); });
  spdlog::info("replacing the results of an earlier run in {} once this run ends{}",
               directory.string(), variants && !with_variants ? ", those of its variants too" : "");
}

}  // namespace

Json run_scene(const scene::Scene& scene, const std::filesystem::path& directory,
               const std::function<bool()>& cancelled) {
  OutputDirectory out(directory, files_of_earlier_run, files_named_by(scene));
  announce_replacing(out, directory, !scene.variants.empty());
  try {
    Stopwatch total;
    // Meshing alone takes minutes where elements are small, so settings and cost are stated before.
    const auto state_cost = [&](const session::Inputs& inputs) {
      for (const std::string& line : setting_lines(scene)) spdlog::info("{}", line);
      if (const auto cost = session::checked_cost(scene, inputs, session::Extent::full))
        spdlog::info("{}", session::sentence_of(*cost));
    };
    session::FaceSession session(scene, {.note = session::log_note, .inputs = state_cost});
    const tissue::TissueMesh& mesh = session.mesh();
    session::checked_cost(scene, session.inputs(), session::Extent::full, &mesh.volume);
    spdlog::info("{} nodes, {} tetrahedra under {} vertices of skin", mesh.volume.nodes.rows(),
                 mesh.volume.tets.rows(), mesh.skin.points.rows());
    Json summary = write_into(session, total, out.path(), cancelled);
    out.commit();
    return summary;
  } catch (const InputError& error) {
    throw InputError(out.with_own_name(error.what()));
  }
}

}  // namespace hyperex::run
