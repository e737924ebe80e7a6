// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/regions.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <limits>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::metrics {
namespace {

using Mask = std::vector<std::uint8_t>;

// The landmarks that define a region: a range of iBUG points and, in addition or instead, named
// ones.
struct Seeds {
  std::vector<Vec3> points;
  int ibug_found = 0, ibug_wanted = 0;
  bool by_names = false;
};

Seeds ibug_seeds(const io::Landmarks& landmarks, int first, int last) {
  Seeds seeds;
  seeds.ibug_wanted = last - first + 1;
  for (int k = first; k <= last; ++k)
    if (const auto found = landmarks.find(face::ibug(k)); found != landmarks.end()) {
      seeds.points.push_back(found->second);
      ++seeds.ibug_found;
    }
  return seeds;
}

void add_names(Seeds& seeds, const io::Landmarks& landmarks,
               const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const auto found = landmarks.find(name); found != landmarks.end())
      seeds.points.push_back(found->second);
}

// The iBUG points if all are given; otherwise those that are given and the named landmarks.
Seeds seeds_of(const io::Landmarks& landmarks, int first, int last,
               const std::vector<std::string>& names) {
  Seeds seeds = ibug_seeds(landmarks, first, last);
  if (seeds.ibug_found == seeds.ibug_wanted) return seeds;
  const size_t before = seeds.points.size();
  add_names(seeds, landmarks, names);
  seeds.by_names = seeds.points.size() > before;
  return seeds;
}

Mask within(const Points& rest, const std::vector<Vec3>& seeds, double radius_m) {
  Mask mask(rest.rows(), 0);
  tbb::parallel_for(Eigen::Index{0}, rest.rows(), [&](Eigen::Index i) {
    const Vec3 p = rest.row(i).transpose();
    for (const Vec3& seed : seeds)
      if ((p - seed).squaredNorm() <= radius_m * radius_m) {
        mask[i] = 1;
        break;
      }
  });
  return mask;
}

Vec3 middle(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Mask without(Mask mask, const Mask& other) {
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = mask[i] && !other[i];
  return mask;
}

class Builder {
 public:
  Builder(const Points& rest, Regions& out) : rest_(rest), out_(out) {}

  // Notes which landmarks define the region. Returns whether it can be defined.
  bool defined(const std::string& name, const Seeds& seeds, size_t needed) {
    if (seeds.points.size() < needed) {
      out_.notes.push_back(
          fmt::format("{}: left out, its landmarks are not there ({} of at least {})", name,
                      seeds.points.size(), needed));
      return false;
    }
    if (seeds.ibug_found < seeds.ibug_wanted)
      out_.notes.push_back(
          fmt::format("{}: taken by {} landmark{} ({} of the {} iBUG points{})", name,
                      seeds.points.size(), seeds.points.size() == 1 ? "" : "s", seeds.ibug_found,
                      seeds.ibug_wanted, seeds.by_names ? ", the others by anatomical name" : ""));
    return true;
  }

  void add(const std::string& name, const Mask& mask) {
    Region region{name, {}};
    for (size_t i = 0; i < mask.size(); ++i)
      if (mask[i]) region.vertices.push_back(static_cast<int>(i));
    if (region.vertices.empty())
      out_.notes.push_back(fmt::format("{}: left out, no vertex lies there", name));
    else
      out_.regions.push_back(std::move(region));
  }

  Mask none() const { return Mask(rest_.rows(), 0); }

 private:
  const Points& rest_;
  Regions& out_;
};

Seeds lip_seeds(const io::Landmarks& landmarks) {
  return seeds_of(landmarks, 48, 67,
                  {"cheilion_L", "cheilion_R", "labiale_superius", "labiale_inferius", "stomion",
                   "crista_philtri_inferior_L", "crista_philtri_inferior_R"});
}

Seeds eye_seeds(const io::Landmarks& landmarks) {
  return seeds_of(landmarks, 36, 47,
                  {"exocanthion_L", "exocanthion_R", "endocanthion_L", "endocanthion_R",
                   "palpebrale_inferius_L", "palpebrale_inferius_R"});
}

// The vertices within 35 mm of the brows and above the nearest of their points.
Mask above_brows(const Points& rest, const std::vector<Vec3>& brows, const Vec3& up) {
  Mask mask = within(rest, brows, 0.035);
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (!mask[i]) continue;
    const Vec3 p = rest.row(i).transpose();
    double least = std::numeric_limits<double>::infinity(), height = 0;
    for (const Vec3& brow : brows)
      if (const double d2 = (p - brow).squaredNorm(); d2 < least) {
        least = d2;
        height = (p - brow).dot(up);
      }
    mask[i] = height > 0;
  }
  return mask;
}

}  // namespace

const Region* Regions::find(const std::string& name) const {
  for (const Region& region : regions)
    if (region.name == name) return &region;
  return nullptr;
}

Regions regions_of(const Points& rest, const io::Landmarks& landmarks) {
  Regions out;
  Builder build(rest, out);
  Seeds face = ibug_seeds(landmarks, 0, 67);
  if (face.ibug_found == 0) {
    for (const auto& [name, point] : landmarks) face.points.push_back(point);
    face.by_names = !face.points.empty();
  }
  Mask whole = build.none();
  if (build.defined("face", face, 1)) build.add("face", whole = within(rest, face.points, 0.040));

  Mask lips = build.none();
  const Seeds lip = lip_seeds(landmarks);
  if (build.defined("lips", lip, 4)) build.add("lips", lips = within(rest, lip.points, 0.015));

  Mask nose = build.none();
  Seeds nasal = seeds_of(landmarks, 27, 35, {"subnasale", "nasion"});
  add_names(nasal, landmarks, {"pronasale", "alare_L", "alare_R"});
  if (build.defined("nose", nasal, 2))
    build.add("nose", nose = without(within(rest, nasal.points, 0.012), lips));

  Seeds cheek;
  add_names(cheek, landmarks, {"cheek_L", "cheek_R"});
  if (build.defined("cheeks", cheek, 1)) {
    if (cheek.points.size() == 1)
      out.notes.push_back("cheeks: one side only, the other landmark is not there");
    build.add("cheeks", without(within(rest, cheek.points, 0.022), lips));
  }

  Mask eyes = build.none();
  const Seeds eye = eye_seeds(landmarks);
  if (build.defined("eyes", eye, 2))
    build.add("eyes", eyes = without(without(within(rest, eye.points, 0.012), lips), nose));

  const Seeds brow = seeds_of(landmarks, 17, 26, {"glabella"});
  if (eye.points.empty() || lip.points.empty()) {
    out.notes.push_back("forehead: left out, no eye or mouth landmarks to tell which way is up");
  } else if (build.defined("forehead", brow, 1)) {
    const Vec3 up = (middle(eye.points) - middle(lip.points)).normalized();
    build.add("forehead",
              without(without(without(above_brows(rest, brow.points, up), lips), nose), eyes));
  }

  const Seeds chin = seeds_of(landmarks, 7, 9, {"pogonion", "gnathion"});
  if (build.defined("chin", chin, 1))
    build.add("chin", without(within(rest, chin.points, 0.020), lips));

  const auto tip = face::find_place(landmarks, "pronasale");
  const auto axes = face::face_frame_of_corners(landmarks);
  if (!tip || !axes) {
    out.notes.push_back("below_eyes: left out, the tip of the nose or the way up is not known");
  } else {
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
      whole[i] = whole[i] && axes->y.dot(rest.row(i).transpose() - *tip) < 0.015;
    build.add("below_eyes", whole);
  }
  return out;
}

}  // namespace hyperex::metrics
