// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/plan_cases.hpp"

#include <fmt/format.h>

#include <set>

#include "hyperex/session/face_session.hpp"
#include "hyperex/study/case_hash.hpp"

namespace hyperex::study {
namespace {
using nlohmann::json;

/// The errors in the cases of a study, each sentence once.
class Sentences {
 public:
  void add(const std::string& lines) {
    std::size_t begin = 0;
    while (begin <= lines.size()) {
      const std::size_t end = std::min(lines.find('\n', begin), lines.size());
      const std::string line = lines.substr(begin, end - begin);
      if (known_.insert(line).second) text_ += (text_.empty() ? "" : "\n") + line;
      begin = end + 1;
    }
  }
  void throw_if_any() const {
    if (!text_.empty()) throw InputError(text_);
  }

 private:
  std::set<std::string> known_;
  std::string text_;
};

/// The options on which a check of the inputs (session::CheckDepth) depends: not the stiffness of
/// tissue and support, the solver or the outputs.
std::string looked_at(const scene::Scene& scene) {
  json options = scene::options_json(scene);
  for (const char* section : {"solver", "time", "output", "title"}) options.erase(section);
  for (const char* section : {"tissue", "support"})
    for (json& value : options[section])
      if (value.is_number()) value = nullptr;
  std::string text = options.dump(-1, ' ', false, json::error_handler_t::replace);
  for (const scene::Variant& variant : scene.variants) text += looked_at(variant.scene);
  return text;
}

void refuse_equal_folders(const Study& study, const std::vector<PlannedCase>& planned,
                          Sentences& wrong) {
  std::set<std::string> folders;
  for (std::size_t i = 0; i < planned.size(); ++i)
    if (!planned[i].hash.empty() && !folders.insert(planned[i].files.folder.string()).second) {
      const Case& one = study.cases[i];
      wrong.add(InputProblem{one.origin.file, one.origin.line, "case", '"' + one.name + '"',
                             "a name that tells it from another case with the same inputs"}
                    .sentence());
    }
}

}  // namespace

std::vector<PlannedCase> plan_cases(const Study& study, const Done& done) {
  std::vector<PlannedCase> planned;
  Sentences wrong;
  ContentHashes contents;
  for (const Case& one : study.cases) {
    try {
      const scene::Scene scene = scene::read_scene_with(study.scene, one.overrides);
      const std::string hash = hash_of(scene, contents);
      planned.push_back({hash, files_of_case(study.out, one.name, hash)});
    } catch (const InputError& error) {
      wrong.add(error.what());
      planned.emplace_back();  // so that rows are those of study.cases; wrong is thrown below
    }
    if (done) done(planned.size());
  }
  refuse_equal_folders(study, planned, wrong);
  wrong.throw_if_any();
  return planned;
}

void check_inputs(const Study& study, const std::vector<std::size_t>& cases, const Done& done) {
  Sentences wrong;
  std::set<std::string> seen;
  std::size_t count = 0;
  for (const std::size_t i : cases) {
    const scene::Scene scene = scene::read_scene_with(study.scene, study.cases[i].overrides);
    if (seen.insert(looked_at(scene)).second) {
      try {
        session::check(scene, nullptr, session::CheckDepth::inputs);
      } catch (const InputError& error) {
        wrong.add(error.what());
      }
    }
    if (done) done(++count);
  }
  wrong.throw_if_any();
}

}  // namespace hyperex::study
