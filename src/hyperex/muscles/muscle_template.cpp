// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <tuple>

#include "hyperex/core/error.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/toml.hpp"

__asm__(
    ".pushsection .rodata\n"
    ".global hyperex_muscles_begin\n"
    ".global hyperex_muscles_end\n"
    "hyperex_muscles_begin:\n"
    ".incbin \"" HYPEREX_MUSCLES_TOML
    "\"\n"
    "hyperex_muscles_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" const char hyperex_muscles_begin[], hyperex_muscles_end[];

namespace hyperex::muscles {
namespace {

/// Reads "0.35*45 + 0.65*54 (2, -8) d0.4" from left to right.
class PlaceReader {
 public:
  explicit PlaceReader(std::string_view text) : rest_(text) {}

  std::optional<TemplatePlace> read() {
    TemplatePlace place;
    double sum = 0;
    do {
      const auto first = number();
      if (!first) return {};
      double weight = 1, point = *first;
      if (take('*')) {
        const auto second = number();
        if (!second) return {};
        weight = *first, point = *second;
      }
      if (point < 0 || point > 67 || point != std::floor(point)) return {};
      place.ibug.emplace_back(static_cast<int>(point), weight);
      sum += weight;
    } while (take('+'));
    if (std::abs(sum - 1) > 1e-6) return {};
    if (take('(')) {
      const auto out = number();
      if (!out || !take(',')) return {};
      const auto up = number();
      if (!up || !take(')')) return {};
      place.out_mm = *out, place.up_mm = *up;
    }
    if (take('d')) {
      const auto depth = number();
      if (!depth || *depth < 0 || *depth > 1) return {};
      place.depth = *depth;
    }
    skip();
    if (!rest_.empty()) return {};
    return place;
  }

 private:
  void skip() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::optional<double> number() {
    skip();
    std::size_t n = 0;
    while (n < rest_.size() && (std::isdigit(static_cast<unsigned char>(rest_[n])) ||
                                rest_[n] == '.' || (n == 0 && rest_[n] == '-')))
      ++n;
    const auto value = io::parse_number(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return value;
  }
  std::string_view rest_;
};

/// Reads one table; its errors name the table.
class MuscleReader {
 public:
  MuscleReader(const toml::table& table, const std::string& source)
      : table_(table), source_(source), name_(table["name"].value_or(std::string())) {}

  TemplateMuscle read(const std::vector<TemplateMuscle>& before) const {
    TemplateMuscle m;
    if (name_.empty()) fail("name", "a name");
    for (const TemplateMuscle& other : before)
      if (other.name == name_) fail("name", "a name that no other muscle has");
    m.name = name_;
    m.latin = value("latin", name_, "text");
    m.group = value("group", name_, "text");
    m.branch = value("branch", std::string(), "text");
    m.path = path();
    m.width_mm = positive("width_mm", m.width_mm);
    if (table_.contains("band")) m.band = positive("band", 1);
    if (table_.contains("ramp")) m.ramp = positive("ramp", 1);
    m.kind = one_of("kind", {"pull", "ring"}) == 1 ? MuscleKind::ring : MuscleKind::pull;
    m.lip = static_cast<MuscleLip>(one_of("lip", {"both", "upper", "lower"}));
    m.straight = value("straight", false, "true or false");
    m.jaw = value("jaw", false, "true or false");
    m.tone = value("tone", false, "true or false");
    m.cheek = value("cheek", false, "true or false");
    m.readiness = positive("readiness", m.readiness);
    if (table_.contains("yields")) m.yields = positive("yields", 1);
    m.few_share = share("few_share");
    m.many_share = share("many_share");
    m.together = together();
    std::tie(m.fold_from, m.fold_to) = fold();
    m.fold_strength = positive("fold_strength", m.fold_strength);
    return m;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
    throw InputError(source_, fmt::format("muscle {}: {}: expected {}",
                                          name_.empty() ? "without name" : name_, key, expected));
  }
  /// The value of a key; `otherwise` where the key is not given.
  template <class T>
  T value(const char* key, const T& otherwise, const std::string& expected) const {
    if (!table_.contains(key)) return otherwise;
    const std::optional<T> given = table_[key].value_exact<T>();
    if (!given) fail(key, expected);
    return *given;
  }
  std::vector<TemplatePlace> path() const {
    constexpr const char* kExpected =
        "two or more places like \"0.35*45 + 0.65*54 (2, -8) d0.4\": weights that sum to 1 of "
        "iBUG points, offset out and up in mm, depth 0 to 1, first and last with a depth";
    std::vector<TemplatePlace> path;
    if (const toml::array* places = table_["path"].as_array())
      for (const auto& entry : *places) {
        const auto text = entry.value<std::string>();
        const auto place = text ? PlaceReader(*text).read() : std::nullopt;
        if (!place) fail("path", kExpected);
        path.push_back(*place);
      }
    if (path.size() < 2 || path.front().depth < 0 || path.back().depth < 0) fail("path", kExpected);
    return path;
  }
  std::vector<std::pair<std::string, double>> together() const {
    constexpr const char* kExpected =
        "muscles with correlations between -1 and 1, like { malaris = 0.4 }";
    std::vector<std::pair<std::string, double>> out;
    if (!table_.contains("together")) return out;
    const toml::table* others = table_["together"].as_table();
    if (!others) fail("together", kExpected);
    for (const auto& [key, entry] : *others) {
      const double value = entry.value<double>().value_or(1);
      if (!(std::abs(value) < 1) || key.str() == name_) fail("together", kExpected);
      out.emplace_back(std::string(key.str()), value);
    }
    return out;
  }
  std::pair<double, double> fold() const {
    if (!table_.contains("fold")) return {0, 0};
    const toml::array* part = table_["fold"].as_array();
    if (part && part->size() == 2) {
      const double from = (*part)[0].value<double>().value_or(-1);
      const double to = (*part)[1].value<double>().value_or(-1);
      if (from >= 0 && from < to && to <= 1) return {from, to};
    }
    fail("fold", "two rising numbers from 0 (nose) to 1 (mouth), like [0.3, 0.7]");
  }
  double share(const char* key) const {
    if (!table_.contains(key)) return -1;
    const double value = table_[key].value<double>().value_or(-1);
    if (!(value >= 0 && value <= 1)) fail(key, "a number, 0 to 1");
    return value;
  }
  double positive(const char* key, double otherwise) const {
    if (!table_.contains(key)) return otherwise;
    const double value = table_[key].value<double>().value_or(0);
    if (!(value > 0 && value <= 100)) fail(key, "a number above 0, at most 100");
    return value;
  }
  int one_of(const char* key, const std::vector<std::string>& values) const {
    const std::string expected = fmt::format("one of {}", fmt::join(values, ", "));
    const std::string word = value(key, values.front(), expected);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] == word) return static_cast<int>(i);
    fail(key, expected);
  }

  const toml::table& table_;
  const std::string& source_;
  std::string name_;
};

}  // namespace

MuscleTable read_muscles(std::string_view toml, const std::string& source) {
  toml::table file;
  try {
    file = toml::parse(toml);
  } catch (const toml::parse_error& e) {
    throw InputError(source, std::string(e.description()));
  }
  MuscleTable muscles;
  if (!file.contains("muscle")) return muscles;
  const toml::array* tables = file["muscle"].as_array();
  if (!tables || !tables->is_array_of_tables())
    throw InputError(source, "muscle: expected tables, [[muscle]]");
  for (const auto& entry : *tables)
    muscles.push_back(MuscleReader(*entry.as_table(), source).read(muscles));
  return muscles;
}

const MuscleTable& muscle_template() {
  static const MuscleTable muscles =
      read_muscles({hyperex_muscles_begin, hyperex_muscles_end}, "the muscles inside this program");
  return muscles;
}

const TemplateMuscle* find_muscle(const std::string& name, const MuscleTable& among) {
  for (const TemplateMuscle& muscle : among)
    if (muscle.name == name) return &muscle;
  return nullptr;
}

MuscleTable changed_table(MuscleTable table, const MuscleTable& own,
                          const std::vector<std::string>& without) {
  for (const TemplateMuscle& muscle : own) {
    const auto same = std::find_if(table.begin(), table.end(), [&](const TemplateMuscle& other) {
      return other.name == muscle.name;
    });
    if (same == table.end())
      table.push_back(muscle);
    else
      *same = muscle;
  }
  for (const TemplateMuscle& muscle : own)
    for (const auto& [other, value] : muscle.together)
      if (!find_muscle(other, table))
        throw InputError("muscle " + muscle.name,
                         fmt::format("together: expected names of muscles, without side; {} is "
                                     "none",
                                     other));
  std::erase_if(table, [&](const TemplateMuscle& muscle) {
    return std::find(without.begin(), without.end(), muscle.name) != without.end();
  });
  return table;
}

std::set<std::string> names_for(const std::string& muscle, const MuscleTable& among) {
  const std::string side = muscle.substr(muscle.size() - 2);  // "_L"
  std::set<std::string> names = {muscle, "side" + side};
  const TemplateMuscle* row = find_muscle(muscle.substr(0, muscle.size() - 2), among);
  if (row && !row->branch.empty()) names.insert(row->branch + side);
  return names;
}

std::string other_side(std::string name) {
  name.back() = name.back() == 'L' ? 'R' : 'L';
  return name;
}

std::vector<std::string> gain_names(const MuscleTable& among) {
  std::set<std::string> all;
  for (const TemplateMuscle& muscle : among)
    for (const char* side : {"_L", "_R"}) all.merge(names_for(muscle.name + side, among));
  return {all.begin(), all.end()};
}

}  // namespace hyperex::muscles
