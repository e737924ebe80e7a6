// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/candide.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::expression {

namespace {

constexpr int kMostEntries = 1'000'000;
constexpr const char *kVertexList = "VERTEX LIST", *kFaceList = "FACE LIST",
                     *kAnimation = "ANIMATION UNITS LIST", *kShape = "SHAPE UNITS LIST",
                     *kAnimationParameters = "ANIMATION PARAMETERS",
                     *kShapeParameters = "SHAPE PARAMETERS", *kTexture = "TEXTURE",
                     *kEnd = "END OF FILE";

/// A line that is not blank.
struct Line {
  int number = 0;
  bool comment = false;
  std::string_view text;  ///< trimmed, without '#'
};

class Reader {
 public:
  Reader(std::filesystem::path file, std::string_view text) : file_(std::move(file)), lines_(text) {
    advance();
  }

  const std::optional<Line>& next() const { return next_; }

  [[noreturn]] void refuse(const std::string& expected) const {
    throw InputError({file_, next_ ? next_->number : lines_.number(), "",
                      next_ ? io::quotable(next_->text) : "end of the file", expected});
  }

  /// Whether the next line is the comment "NAME" or "NAME:". If so, consumes it.
  bool section(std::string_view name) {
    if (!next_ || !next_->comment) return false;
    std::string_view text = next_->text;
    if (text.ends_with(':')) text.remove_suffix(1);
    if (text != name) return false;
    advance();
    return true;
  }

  void needed_section(std::string_view name) {
    if (!section(name)) refuse(fmt::format("the section '# {}:'", name));
  }

  std::string comment(const std::string& expected) {
    if (!next_ || !next_->comment) refuse(expected);
    std::string text(next_->text);
    advance();
    return text;
  }

  int count(const std::string& of_what) {
    const std::string expected = "the number of " + of_what;
    if (!next_ || next_->comment) refuse(expected);
    const auto value = io::parse_integer(next_->text);
    if (!value || *value < 0 || *value > kMostEntries) refuse(expected);
    advance();
    return int(*value);
  }

  /// Reads `size` finite numbers from the next line.
  std::vector<double> numbers(std::size_t size, const std::string& expected) {
    if (!next_ || next_->comment) refuse(expected);
    std::vector<double> values;
    for (const auto word : io::words(next_->text)) {
      const auto value = io::parse_number(word);
      if (!value || !std::isfinite(*value)) refuse(expected);
      values.push_back(*value);
    }
    if (values.size() != size) refuse(expected);
    return values;
  }

  int index(double value, Eigen::Index end, const std::string& expected) const {
    if (value != std::floor(value) || value < 0 || value >= double(end)) refuse(expected);
    return int(value);
  }

  void advance() {
    next_.reset();
    std::string_view text;
    while (lines_.next(text)) {
      text = io::trimmed(text);
      if (text.empty()) continue;
      const bool comment = text.front() == '#';
      if (comment) text = io::trimmed(text.substr(1));
      if (comment && text.empty()) continue;
      next_ = Line{lines_.number(), comment, text};
      return;
    }
  }

 private:
  std::filesystem::path file_;
  io::Lines lines_;
  std::optional<Line> next_;
};

TriMesh read_mesh(Reader& reader) {
  TriMesh mesh;
  reader.needed_section(kVertexList);
  mesh.points.resize(reader.count("vertices"), 3);
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const auto row =
        reader.numbers(3, fmt::format("x y z of vertex {} of {}", v, mesh.points.rows()));
    mesh.points.row(v) << row[0], row[1], row[2];
    reader.advance();
  }
  reader.needed_section(kFaceList);
  mesh.triangles.resize(reader.count("faces"), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const std::string expected = fmt::format("three different vertices, 0 to {}, of face {} of {}",
                                             mesh.points.rows() - 1, f, mesh.triangles.rows());
    const auto row = reader.numbers(3, expected);
    for (int corner = 0; corner < 3; ++corner)
      mesh.triangles(f, corner) =
          reader.index(row[std::size_t(corner)], mesh.points.rows(), expected);
    if (row[0] == row[1] || row[1] == row[2] || row[2] == row[0]) reader.refuse(expected);
    reader.advance();
  }
  return mesh;
}

std::vector<CandideUnit> read_units(Reader& reader, std::string_view section,
                                    Eigen::Index vertices) {
  reader.needed_section(section);
  std::vector<CandideUnit> units(std::size_t(reader.count("units")));
  for (std::size_t k = 0; k < units.size(); ++k) {
    CandideUnit& unit = units[k];
    unit.name =
        reader.comment(fmt::format("'# NAME' of unit {} of {} ({})", k + 1, units.size(), section));
    const std::string quoted = io::quotable(unit.name);
    unit.displacement.resize(reader.count("vertices that unit '" + quoted + "' moves"), 3);
    for (Eigen::Index i = 0; i < unit.displacement.rows(); ++i) {
      const std::string expected =
          fmt::format("entry {} of {} of unit '{}': a vertex, 0 to {}, and dx dy dz", i + 1,
                      unit.displacement.rows(), quoted, vertices - 1);
      const auto row = reader.numbers(4, expected);
      unit.vertices.push_back(reader.index(row[0], vertices, expected));
      unit.displacement.row(i) << row[1], row[2], row[3];
      reader.advance();
    }
  }
  return units;
}

Eigen::VectorXd read_parameters(Reader& reader, std::string_view section, std::size_t units) {
  Eigen::VectorXd parameters = Eigen::VectorXd::Zero(Eigen::Index(units));
  if (!reader.section(section)) return parameters;
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    parameters[k] = reader.numbers(1, fmt::format("one number a unit ({})", section))[0];
    reader.advance();
  }
  return parameters;
}

}  // namespace

CandideFile read_candide(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  Reader reader(file, text);
  CandideFile candide;
  candide.mesh = read_mesh(reader);
  const Eigen::Index vertices = candide.mesh.points.rows();
  candide.animation_units = read_units(reader, kAnimation, vertices);
  candide.shape_units = read_units(reader, kShape, vertices);
  candide.animation_parameters =
      read_parameters(reader, kAnimationParameters, candide.animation_units.size());
  candide.shape_parameters = read_parameters(reader, kShapeParameters, candide.shape_units.size());
  if (reader.section(kTexture)) {
    candide.texture.resize(vertices, 2);
    for (Eigen::Index v = 0; v < vertices; ++v) {
      const auto row = reader.numbers(2, fmt::format("u v of vertex {} of {}", v, vertices));
      candide.texture.row(v) << row[0], row[1];
      reader.advance();
    }
  }
  reader.section(kEnd);
  if (reader.next()) reader.refuse("nothing more, or the next section");
  return candide;
}

}  // namespace hyperex::expression
