// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/read_visits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/visits/visit_dates.hpp"

namespace hyperex::visits {
namespace fs = std::filesystem;
namespace {
using nlohmann::json;

constexpr std::size_t kMostVisits = 60, kMostRecordings = 20, kLongestText = 200;

class Reader {
 public:
  explicit Reader(const fs::path& file) { out_.file = file; }

  VisitsFile read() {
    try {
      values_ = scene::parse_toml(read_file(out_.file));
    } catch (const scene::TornToml& torn) {
      throw InputError(InputProblem{out_.file, torn.line, "", "", "sound TOML (" + torn.why + ")"});
    }
    refuse_unknown(values_.root, "",
                   {"patient", "expression", "repetition_mm", "unit", "rigid_points", "visit"});
    out_.patient = text("patient", values_.root.value("patient", json()));
    read_expression();
    out_.repetition_m = millimetres("repetition_mm", values_.root.value("repetition_mm", json()));
    read_unit();
    if (values_.root.contains("rigid_points"))
      out_.rigid_points = texts("rigid_points", values_.root["rigid_points"]);
    read_all();
    if (!problems_.empty()) throw InputError(problems_);
    out_.order_remark = sort_by_date(out_.visits);
    return out_;
  }

 private:
  void complain(const std::string& key, const json& value, const std::string& expected) {
    const auto line = values_.lines.find(key);
    problems_.push_back({out_.file, line == values_.lines.end() ? 0 : line->second, key,
                         value.is_null() ? "" : scene::toml_text(value), expected});
  }

  void refuse_unknown(const json& table, const std::string& prefix,
                      const std::vector<std::string>& known) {
    for (const auto& [name, value] : table.items()) {
      if (std::ranges::find(known, name) != known.end()) continue;
      const std::string near = scene::nearest(name, known);
      complain(prefix + name, nullptr,
               fmt::format("one of {}", fmt::join(known, ", ")) +
                   (near.empty() ? "" : "; did you mean " + near + "?"));
    }
  }

  std::string text(const std::string& key, const json& value) {
    if (value.is_null()) return "";
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestText &&
        (value.get_ref<const std::string&>().empty() ||
         io::is_printable_name(value.get_ref<const std::string&>())))
      return value.get<std::string>();
    complain(key, value, fmt::format("a text of at most {} characters on one line", kLongestText));
    return "";
  }

  std::vector<std::string> texts(const std::string& key, const json& value) {
    std::vector<std::string> all;
    if (!value.is_array() || value.empty()) {
      complain(key, value, "a list of one or more texts");
      return all;
    }
    for (std::size_t i = 0; i < value.size(); ++i)
      all.push_back(text(fmt::format("{}[{}]", key, i), value[i]));
    return all;
  }

  std::optional<double> millimetres(const std::string& key, const json& value) {
    if (value.is_null()) return std::nullopt;
    if (value.is_number() && value.get<double>() >= 0 && value.get<double>() <= 20)
      return 1e-3 * value.get<double>();
    complain(key, value, "a number from 0 to 20 (mm)");
    return std::nullopt;
  }

  void read_expression() {
    std::vector<std::string> names;
    for (const Expression& one : expressions()) names.push_back('"' + one.name + '"');
    const json value = values_.root.value("expression", json("smile"));
    const auto found =
        value.is_string() ? expression_named(value.get<std::string>()) : std::nullopt;
    if (found)
      out_.expression = *found;
    else
      complain("expression", value, fmt::format("one of {}", fmt::join(names, ", ")));
  }

  void read_unit() {
    const json value = values_.root.value("unit", json());
    if (value.is_null()) return;
    const std::string name = value.is_string() ? value.get<std::string>() : "";
    if (name == "mm" || name == "cm" || name == "m")
      out_.unit = io::length_unit(name);
    else
      complain("unit", value, "\"mm\", \"cm\" or \"m\"");
  }

  void read_all() {
    const json visits = values_.root.value("visit", json());
    if (!visits.is_array() || visits.empty() || visits.size() > kMostVisits ||
        !std::ranges::all_of(visits, [](const json& one) { return one.is_object(); })) {
      complain("visit", nullptr,
               fmt::format("from 1 to {} tables [[visit]], each with a date and recordings",
                           kMostVisits));
      return;
    }
    std::set<std::string> labels;
    for (std::size_t i = 0; i < visits.size(); ++i) {
      const std::string prefix = fmt::format("visit[{}].", i);
      out_.visits.push_back(entry(visits[i], prefix));
      if (!labels.insert(out_.visits.back().label).second)
        complain(prefix + "date", visits[i].value("date", json()),
                 "a date that no other visit has");
    }
  }

  VisitEntry entry(const json& table, const std::string& prefix) {
    refuse_unknown(table, prefix,
                   {"date", "recording", "recordings", "note", "jitter_mm", "end_s", "rest_scan",
                    "rest_landmarks", "peak_scan", "peak_landmarks"});
    VisitEntry visit;
    const json date = table.value("date", json());
    visit.label = date.is_object() ? date.value("date or time", "") : text(prefix + "date", date);
    if (visit.label.empty() && (date.is_null() || date == ""))
      complain(prefix + "date", nullptr, "a date, such as 2026-03-01, or a name in quotes");
    visit.note = text(prefix + "note", table.value("note", json()));
    visit.jitter_m = millimetres(prefix + "jitter_mm", table.value("jitter_mm", json()));
    if (const json end = table.value("end_s", json()); end.is_number() && end.get<double>() > 0)
      visit.end_s = end.get<double>();
    else if (!end.is_null())
      complain(prefix + "end_s", end, "a number above 0 (s)");
    read_recordings(table, prefix, visit);
    visit.rest_scan = scan(table, prefix, "rest");
    visit.peak_scan = scan(table, prefix, "peak");
    return visit;
  }

  /// The scan of a face at rest or at the peak, with its landmarks where they are given.
  std::optional<VisitScan> scan(const json& table, const std::string& prefix,
                                const std::string& when) {
    const std::string key = when + "_scan", landmarks = when + "_landmarks";
    if (!table.contains(key)) {
      if (table.contains(landmarks))
        complain(prefix + landmarks, nullptr, key + " beside it, the scan that they are of");
      return std::nullopt;
    }
    VisitScan out{existing(prefix + key, table[key], "an existing scan (PLY, OBJ, STL, glTF)"), {}};
    if (table.contains(landmarks))
      out.landmarks = existing(prefix + landmarks, table[landmarks], "an existing file (.json)");
    return out;
  }

  fs::path existing(const std::string& key, const json& value, const std::string& expected) {
    const std::string name = text(key, value);
    fs::path path = (out_.file.parent_path() / name).lexically_normal();
    std::error_code error;
    if (name.empty() || !fs::is_regular_file(path, error)) complain(key, value, expected);
    return path;
  }

  void read_recordings(const json& table, const std::string& prefix, VisitEntry& visit) {
    std::vector<std::string> names;
    if (table.contains("recordings"))
      names = texts(prefix + "recordings", table["recordings"]);
    else if (table.contains("recording"))
      names = {text(prefix + "recording", table["recording"])};
    if (table.contains("recording") == table.contains("recordings") ||
        names.size() > kMostRecordings)
      complain(prefix + "recordings", nullptr,
               fmt::format("either recording = \"FILE\" or recordings = [\"FILE\", ...] with at "
                           "most {} files",
                           kMostRecordings));
    for (const std::string& name : names) {
      const fs::path path = (out_.file.parent_path() / name).lexically_normal();
      std::error_code error;
      if (!name.empty() && !fs::is_regular_file(path, error))
        complain(prefix + (table.contains("recordings") ? "recordings" : "recording"), name,
                 "an existing file (CSV or TRC)");
      else if (!known_.insert(fs::weakly_canonical(path, error)).second)
        complain(prefix + "recordings", name, "a recording that is not given before");
      visit.recordings.push_back(path);
    }
  }

  VisitsFile out_;
  std::set<fs::path> known_;
  scene::TomlValues values_;
  std::vector<InputProblem> problems_;
};

}  // namespace

bool has_scans(const VisitsFile& file) {
  return std::ranges::any_of(
      file.visits, [](const VisitEntry& visit) { return visit.rest_scan || visit.peak_scan; });
}

VisitsFile read_visits(const fs::path& file) {
  return Reader(file).read();
}

}  // namespace hyperex::visits
