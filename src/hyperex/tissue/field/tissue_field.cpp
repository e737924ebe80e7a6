// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/tissue_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/tissue/field/frontal.hpp"
#include "hyperex/tissue/field/harmonic.hpp"
#include "hyperex/tissue/field/layers.hpp"
#include "hyperex/tissue/field/points.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/regions.hpp"
#include "hyperex/tissue/mesh/on_skin.hpp"
#include "hyperex/tissue/per_vertex/per_vertex.hpp"

namespace hyperex::tissue {
namespace {
/// How much tissue may grow or shrink.
constexpr double kLeastVolumeRatio = 0.5, kMostVolumeRatio = 2;

/// The margin (anatomy::upper_lip_margin) at which a landmark is looked up on the skin: far on the
/// landmark's own lip, 0 for landmarks of neither lip.
double margin_of(const std::string& landmark) {
  if (landmark == "labiale_superius" || landmark.starts_with("crista_philtri")) return 1;
  if (landmark == "labiale_inferius") return -1;
  return anatomy::lip_of(landmark);
}

/// The skin above the centroid of each tetrahedron: each node counts as the outer vertex over it.
std::vector<PlaceOnMesh> places_above(const TissueMesh& mesh, const SideTree& tree) {
  const VolumeMesh& volume = mesh.volume;
  std::vector<PlaceOnMesh> places(volume.tets.rows());
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    Vec3 at = Vec3::Zero();
    double margin = 0;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Index vertex = volume.tets(t, k) % volume.surface_nodes();
      at += volume.outer.points.row(vertex).transpose() / 4;
      margin += mesh.upper_margin[vertex] / 4;
    }
    places[t] = tree.query(at, margin);
  }
  return places;
}

double volume_of(const VolumeMesh& mesh, Eigen::Index t) {
  const Vec3 a = mesh.nodes.row(mesh.tets(t, 0));
  const auto edge = [&](int k) -> Vec3 { return mesh.nodes.row(mesh.tets(t, k)).transpose() - a; };
  return edge(1).cross(edge(2)).dot(edge(3)) / 6;
}

/// Whether mirror makes this region of both sides.
bool has_two_sides(const TissueFieldOptions& options, const TissueRegion& region) {
  if (!options.mirror) return false;
  if (!region.name.empty()) return region.name.ends_with("_L") || region.name.ends_with("_R");
  return std::ranges::any_of(region.scar, [](const std::string& landmark) {
    return anatomy::mirrored_landmark(landmark) != landmark;
  });
}

struct VolumeOfRegion {
  std::size_t region;
  double m3 = 0, held_m3 = 0, greatest_share = 0;
  /// The change of volume of the tissue that takes most of it.
  double greatest() const { return m3 / held_m3 * greatest_share; }
};

/// Names the region that changes its tissue most.
void refuse_extreme_volumes(const TissueFieldOptions& options,
                            const std::vector<VolumeOfRegion>& given,
                            const std::vector<double>& ratio) {
  const auto [least, most] = std::ranges::minmax(ratio);
  if (least >= kLeastVolumeRatio && most <= kMostVolumeRatio) return;
  const bool grows = most > kMostVolumeRatio;
  const VolumeOfRegion& worst = *std::ranges::max_element(
      given, {}, [&](const auto& one) { return grows ? one.greatest() : -one.greatest(); });
  const TissueRegion& region = options.regions[worst.region];
  const double limit = std::abs((grows ? kMostVolumeRatio : kLeastVolumeRatio) - 1);
  const double alone_ml =
      std::floor(1e7 * std::abs(region.volume_m3) * limit / std::abs(worst.greatest())) / 10;
  throw FieldError(
      {fmt::format("region[{}].volume_ml", worst.region),
       fmt::format(
           "volumes with which no part of the tissue takes less than {:g} or more than {:g} "
           "times its volume, all regions together; this region alone takes {}{:.1f} ml",
           kLeastVolumeRatio, kMostVolumeRatio, grows ? "up to " : "down to -", alone_ml),
       fmt::format("{:g}", 1e6 * region.volume_m3)});
}

std::string key_of(const ResolvedPoint& point) {
  return point.key == "preset" ? point.key : point.key + ".landmark";
}

/// The points that give a parameter, and their values.
struct Given {
  std::vector<std::size_t> point;
  Eigen::VectorXd value;
};

Given given_by(const std::vector<ResolvedPoint>& points, int parameter) {
  Given given;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].value[parameter]) given.point.push_back(i);
  given.value.resize(Eigen::Index(given.point.size()));
  for (std::size_t i = 0; i < given.point.size(); ++i)
    given.value[Eigen::Index(i)] = *points[given.point[i]].value[parameter];
  return given;
}

/// A preset's factor of a layer, or of the values at points, may take an allowed value out of
/// range. `by_points`: the parameter is given at points, so that the layer's own value of it counts
/// no more.
void refuse_out_of_range(const TissueFieldOptions& options, std::size_t layer, int parameter,
                         const Eigen::VectorXd& values, bool by_points) {
  const double least = values.minCoeff(), most = values.maxCoeff();
  if (is_allowed(parameter, least) && is_allowed(parameter, most)) return;
  const ParameterInfo& info = parameter_info(parameter);
  const std::vector<TissueLayer>& layers = layers_of(options);
  std::string of;
  if (by_points)
    of = " at points";
  else if (layer < layers.size() && !layers[layer].name.empty())
    of = " of " + layers[layer].name;
  throw FieldError({options.preset.empty() ? info.key : "preset",
                    fmt::format("{}{} to stay {}; it would be {:.4g}", info.title, of, info.allowed,
                                (is_allowed(parameter, least) ? most : least) / info.si)});
}

bool any(const GivenParameters& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& v) { return v.has_value(); });
}

void check_region(const TissueFieldOptions& options, std::size_t index,
                  const io::Landmarks& landmarks, std::vector<FieldProblem>& problems) {
  const TissueRegion& region = options.regions[index];
  const std::string key = fmt::format("region[{}]", index);
  const auto complain = [&](const std::string& below, const std::string& expected) {
    problems.push_back({key + below, expected});
  };
  const int kinds = int(!region.name.empty()) + int(!region.scar.empty()) +
                    int(!region.scar_points_m.empty()) + int(!region.painted.empty());
  if (kinds != 1) complain("", "one of name, scar, scar_points_mm and painted");
  if (!any(region.value) && !any(region.factor) && region.volume_m3 == 0)
    complain("",
             "a value, a factor or a volume, as young_kpa = 300, young_factor = 5 or "
             "volume_ml = 2");
  for (int p = 0; p < parameter_count; ++p)
    if (region.value[p] && region.factor[p])
      complain("", fmt::format("either {} or its factor", parameter_info(p).key));
  if (!region.name.empty() && !is_region(region.name))
    problems.push_back({key + ".name", "the name of a region (hyperex presets lists them)",
                        '"' + region.name + '"'});
  if (region.scar.size() == 1) complain(".scar", "two landmarks or more");
  if (region.scar_points_m.size() == 1) complain(".scar_points_mm", "two points or more");
  for (const std::string& name : region.scar)
    if (!landmarks.contains(name))
      complain(".scar", fmt::format("names of landmarks of the scan ({} is none)", name));
  if (!options.mirror) return;
  if (!region.scar_points_m.empty())
    complain(".scar_points_mm", "landmarks instead (scar), as mirror is true");
  if (!region.painted.empty())
    complain(".painted", "mirror = false, as the paint covers both sides");
  for (std::size_t other = 0; other < index; ++other)
    if (!region.name.empty() && region.name != options.regions[other].name &&
        anatomy::mirrored_landmark(region.name) == options.regions[other].name)
      complain(".name", fmt::format("one side alone, as mirror is true and region[{}] "
                                    "is {}",
                                    other, options.regions[other].name));
}

}  // namespace

bool adds_volume(const TissueFieldOptions& options) {
  return std::any_of(options.regions.begin(), options.regions.end(),
                     [](const TissueRegion& region) { return region.volume_m3 != 0; });
}

bool needs_registration(const TissueFieldOptions& options) {
  return std::any_of(options.regions.begin(), options.regions.end(),
                     [](const TissueRegion& region) { return !region.name.empty(); });
}

std::vector<FieldProblem> problems_of(const TissueFieldOptions& options,
                                      const io::Landmarks& landmarks) {
  std::vector<FieldProblem> problems;
  if (!options.preset.empty() && !find_preset(options.preset))
    problems.push_back({"preset", "the name of a preset (hyperex presets lists them)"});
  if (options.mirror && !options.per_vertex.empty())
    problems.push_back({"mirror", "false, as per_vertex covers both sides"});
  check_layers(options, problems);
  resolve_points(options, landmarks, problems);
  for (std::size_t i = 0; i < options.regions.size(); ++i)
    check_region(options, i, landmarks, problems);
  return problems;
}

bool is_graded(const TissueFieldOptions& options) {
  const TissuePreset* preset = find_preset(options.preset);
  return !options.points.empty() || !options.regions.empty() || !options.per_vertex.empty() ||
         (preset && !preset->points.empty()) || !layers_of(options).empty();
}

bool TissueField::varies_within(int parameter) const {
  const Eigen::VectorXd& outer = skin[parameter];
  return varies(parameter) || std::ranges::any_of(deeper, [&](const SkinField& under) {
           return ((under[parameter] - outer).array().abs() > 1e-9 * outer.array().abs()).any();
         });
}

std::vector<Note> notes_on_files(const TissueFieldOptions& options, const TriMesh& scan) {
  std::vector<Note> notes;
  if (!options.per_vertex.empty()) read_per_vertex(options.per_vertex, scan, notes);
  for (const TissueRegion& region : options.regions)
    if (!region.painted.empty()) read_paint(region.painted, scan, notes);
  return notes;
}

TissueFieldMaker::TissueFieldMaker(const TissueMesh& mesh, const io::Landmarks& landmarks,
                                   const anatomy::RegisteredFace* face)
    : mesh_(mesh),
      landmarks_(landmarks),
      joined_(joined_vertices(mesh.skin.points, mesh.skin_upper_margin)),
      skin_tree_(skin_tree(mesh, landmarks)),
      above_(places_above(mesh, skin_tree_)) {
  if (face) regions_.emplace(mesh, landmarks, *face);
}

TissueField TissueFieldMaker::make(const TissueFieldOptions& options) const {
  if (auto problem = layer_beneath(options, mesh_.volume)) throw FieldError(*std::move(problem));
  TissueField field;
  field.deeper = skin_fields(options);
  field.skin = std::move(field.deeper.front());
  field.deeper.erase(field.deeper.begin());
  const auto of_elements = [&](const Eigen::VectorXd& skin) {
    std::vector<double> values(above_.size());
    for (std::size_t t = 0; t < above_.size(); ++t) values[t] = above_[t].value(skin);
    return values;
  };
  if (!field.deeper.empty()) {
    field.layer_share = layer_shares(options, mesh_.volume);
    field.notes = notes_on_layers(options, mesh_.volume);
  }
  for (int p = 0; p < parameter_count; ++p) {
    std::vector<std::vector<double>> layers = {of_elements(field.skin[p])};
    for (const SkinField& under : field.deeper) layers.push_back(of_elements(under[p]));
    field.element[p] =
        field.deeper.empty() ? std::move(layers.front()) : layer_means(field.layer_share, layers);
  }
  if (adds_volume(options)) add_volumes(options, field);
  return field;
}

/// One for each of layer_parameters().
std::vector<SkinField> TissueFieldMaker::skin_fields(const TissueFieldOptions& options) const {
  const Eigen::Index vertices = mesh_.skin.points.rows();
  SkinField points;  // empty where none gives the parameter
  interpolate(options, points);
  PerVertex own;  // likewise
  if (!options.per_vertex.empty()) {
    std::vector<Note> noted;  // when the inputs were read
    own = read_per_vertex(options.per_vertex, scan_of(mesh_), noted);
    for (Eigen::VectorXd& values : own)
      if (values.size() > 0) values = on_skin(mesh_, values);
  }
  std::vector<SkinField> layers;
  for (const TissueParameters& uniform : layer_parameters(options)) {
    const std::size_t layer = layers.size();
    SkinField& field = layers.emplace_back();
    for (int p = 0; p < parameter_count; ++p) {
      field[p] = Eigen::VectorXd::Constant(vertices, uniform[p]);
      if (points[p].size() > 0) field[p] = points[p];
      if (own[p].size() > 0) field[p] = own[p].array().isNaN().select(field[p], own[p]);
      refuse_out_of_range(options, layer, p, field[p], points[p].size() > 0);
    }
  }
  for (std::size_t i = 0; i < options.regions.size(); ++i) {
    const Eigen::VectorXd shares = region_shares(options, i);
    for (SkinField& field : layers) apply_region(options, i, field, shares);
  }
  return layers;
}

void TissueFieldMaker::interpolate(const TissueFieldOptions& options, SkinField& field) const {
  std::vector<FieldProblem> problems;
  const auto points = resolve_points(options, landmarks_, problems);
  const face::FaceFrame frame = face::face_frame(landmarks_);
  const auto frontal = [&](const Points& at) {
    Eigen::MatrixX2d out(at.rows(), 2);
    for (Eigen::Index i = 0; i < at.rows(); ++i)
      out.row(i) = frame.local(at.row(i)).head<2>().transpose();
    return out;
  };
  const TissuePreset* preset = find_preset(options.preset);
  std::optional<HarmonicField> harmonic;
  std::vector<std::size_t> solved_for;
  for (int p = 0; p < parameter_count; ++p) {
    const Given given = given_by(points, p);
    if (given.point.empty()) continue;
    if (options.interpolation == Interpolation::linear) {
      Points at(given.value.size(), 3);
      for (std::size_t i = 0; i < given.point.size(); ++i)
        at.row(Eigen::Index(i)) = landmarks_.at(points[given.point[i]].landmark).transpose();
      const Eigen::MatrixX2d plane = frontal(at);
      for (Eigen::Index i = 0; i < plane.rows(); ++i)
        for (Eigen::Index j = 0; j < i; ++j)
          if ((plane.row(i) - plane.row(j)).norm() < 1e-4)
            throw FieldError(
                {key_of(points[given.point[i]]),
                 fmt::format("points apart as seen from in front: {} and {} are one",
                             points[given.point[j]].landmark, points[given.point[i]].landmark)});
      field[p] = FrontalField(plane).at(frontal(mesh_.skin.points), given.value);
    } else {
      if (!harmonic || solved_for != given.point) {
        std::vector<PlaceOnMesh> at;
        for (const std::size_t i : given.point)
          at.push_back(
              skin_tree_.query(landmarks_.at(points[i].landmark), margin_of(points[i].landmark)));
        harmonic.emplace(mesh_.skin, joined_, at);
        solved_for = given.point;
      }
      if (const auto [a, b] = harmonic->shared_corner(); a >= 0 && given.value[a] != given.value[b])
        throw FieldError(
            {key_of(points[given.point[b]]),
             fmt::format("points apart on this scan: {} and {} lie in triangles that "
                         "touch",
                         points[given.point[a]].landmark, points[given.point[b]].landmark)});
      field[p] = harmonic->solve(given.value);
    }
    if (preset && preset->factor[p]) field[p] *= *preset->factor[p];
  }
}

Eigen::VectorXd TissueFieldMaker::region_depth(const TissueFieldOptions& options,
                                               std::size_t index) const {
  const TissueRegion& region = options.regions[index];
  if (!region.name.empty()) {
    const bool half = region.name.ends_with("_L") || region.name.ends_with("_R");
    // Both halves are the whole: the middle between them is no border.
    return regions_.value().depth(
        options.mirror && half ? region.name.substr(0, region.name.size() - 2) : region.name);
  }
  std::vector<Vec3> line, twin;
  for (const auto& p : region.scar_points_m) line.emplace_back(p[0], p[1], p[2]);
  for (const std::string& name : region.scar) {
    line.push_back(landmarks_.at(name));
    const auto other = landmarks_.find(anatomy::mirrored_landmark(name));
    twin.push_back(other == landmarks_.end() ? line.back() : other->second);
  }
  for (const Vec3& p : line)
    if (const double far = skin_tree_.query(p, 0).distance_m; far > 0.015)
      throw FieldError(
          {fmt::format("region[{}].scar{}", index, region.scar.empty() ? "_points_mm" : ""),
           fmt::format("points within 15 mm of the scan's surface (one is {:.0f} mm "
                       "from it)",
                       1e3 * far)});
  Eigen::VectorXd depth = band_depth(mesh_.skin, line, region.width_m);
  if (options.mirror && !region.scar.empty())
    depth = depth.cwiseMax(band_depth(mesh_.skin, twin, region.width_m));
  return depth;
}

Eigen::VectorXd TissueFieldMaker::region_shares(const TissueFieldOptions& options,
                                                std::size_t index) const {
  const TissueRegion& region = options.regions[index];
  Eigen::VectorXd shares;
  std::vector<Note> noted;  // when the inputs were read
  if (region.painted.empty())
    shares = region_depth(options, index).unaryExpr([&](double depth) {
      return region_share(depth, region.blend_m);
    });
  else
    shares = on_skin(mesh_, read_paint(region.painted, scan_of(mesh_), noted));
  if (shares.maxCoeff() < 1e-6)
    throw FieldError({fmt::format("region[{}].{}", index,
                                  !region.painted.empty() ? "painted"
                                  : !region.name.empty()  ? "name"
                                  : !region.scar.empty()  ? "scar"
                                                          : "scar_points_mm"),
                      "a region that holds some of this scan's vertices; it is empty"});
  return shares;
}

void TissueFieldMaker::apply_region(const TissueFieldOptions& options, std::size_t index,
                                    SkinField& field, const Eigen::VectorXd& shares) const {
  const TissueRegion& region = options.regions[index];
  const std::string key = fmt::format("region[{}]", index);
  for (int p = 0; p < parameter_count; ++p) {
    if (!region.value[p] && !region.factor[p]) continue;
    for (Eigen::Index v = 0; v < shares.size(); ++v) {
      const double share = shares[v];
      double& u = field[p][v];
      if (region.factor[p])
        u *= 1 + share * (*region.factor[p] - 1);
      else
        u += share * (*region.value[p] - u);
      if (!is_allowed(p, u)) {
        const std::string name = region.factor[p] ? factor_key(p) : parameter_info(p).key;
        throw FieldError({key + "." + name,
                          fmt::format("{} to stay {}; it would be {:.4g}", parameter_info(p).title,
                                      parameter_info(p).allowed, u / parameter_info(p).si)});
      }
    }
  }
}

void TissueFieldMaker::add_volumes(const TissueFieldOptions& options, TissueField& field) const {
  field.skin_volume_ratio = Eigen::VectorXd::Ones(mesh_.skin.points.rows());
  field.volume_ratio.assign(above_.size(), 1);
  std::vector<VolumeOfRegion> given;
  for (std::size_t i = 0; i < options.regions.size(); ++i) {
    const TissueRegion& region = options.regions[i];
    if (region.volume_m3 == 0) continue;
    const Eigen::VectorXd shares = region_shares(options, i);
    VolumeOfRegion one{.region = i,
                       .m3 = (has_two_sides(options, region) ? 2 : 1) * region.volume_m3};
    for (std::size_t t = 0; t < above_.size(); ++t) {
      const double share = above_[t].value(shares);
      one.held_m3 += share * volume_of(mesh_.volume, Eigen::Index(t));
      one.greatest_share = std::max(one.greatest_share, share);
    }
    if (!(one.held_m3 > 0))
      throw FieldError({fmt::format("region[{}].volume_ml", i),
                        "a region that holds tissue; it is smaller than the elements there",
                        fmt::format("{:g}", 1e6 * region.volume_m3)});
    field.added_volume_m3 += one.m3;
    const double growth = one.m3 / one.held_m3;
    field.skin_volume_ratio += growth * shares;
    for (std::size_t t = 0; t < above_.size(); ++t)
      field.volume_ratio[t] += growth * above_[t].value(shares);
    given.push_back(one);
  }
  refuse_extreme_volumes(options, given, field.volume_ratio);
}

}  // namespace hyperex::tissue
