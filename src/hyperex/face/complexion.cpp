// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/complexion.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/paint.hpp"

namespace hyperex::face {
namespace {

/// Twice as fine shows no more of the hair of a brow, since screens show a face with fewer pixels.
constexpr int kFineSize_px = 1024;
/// A pixel is 0.9 mm, less than the vertices of most scans are apart.
constexpr int kSoftSize_px = 256;

/// Tones of skin: its own, where blood shows, of the lips and of the hair.
struct Tone {
  Rgb base, flush, lip, hair;
};
constexpr Tone tone_of(SkinTone tone) {
  switch (tone) {
    case SkinTone::medium:
      return {{193, 139, 109}, {176, 98, 78}, {148, 80, 73}, {34, 25, 20}};
    case SkinTone::dark:
      return {{118, 80, 60}, {112, 60, 46}, {108, 60, 56}, {20, 15, 13}};
    case SkinTone::light:
      break;
  }
  return {{229, 184, 162}, {214, 128, 112}, {184, 98, 94}, {70, 48, 36}};
}

// Outlines on the canonical face, vertices as the package's own drawing names them. Right side; the
// left side is its mirror image.
constexpr std::array kOuterLips = {61,  146, 91,  181, 84,  17, 314, 405, 321, 375,
                                   291, 409, 270, 269, 267, 0,  37,  39,  40,  185};
constexpr std::array kBrowUpper = {107, 66, 105, 63, 70};  // from the middle outwards
constexpr std::array kBrowLower = {55, 65, 52, 53, 46};

class Painter {
 public:
  Painter(const Tone& tone, SkinDetail detail)
      : face_(canonical_face()),
        tone_(tone),
        fine_(detail == SkinDetail::full),
        size_px_(fine_ ? kFineSize_px : kSoftSize_px),
        canvas_(size_px_, tone.base) {}

  SkinPicture paint() {
    variation();
    flush();
    lids();
    lips();
    for (const bool left : {false, true}) brow(left);
    return {size_px_, canvas_.bytes()};
  }

 private:
  Place at(int vertex) const { return {face_.uv(vertex, 0), face_.uv(vertex, 1)}; }
  Place at(const char* landmark) const {
    Place mean = Place::Zero();
    const std::vector<int>& vertices = face_.landmarks.at(landmark);
    for (const int v : vertices) mean += at(v) / double(vertices.size());
    return mean;
  }
  template <class Vertices>
  std::vector<Place> places(const Vertices& vertices, bool left = false) const {
    std::vector<Place> out;
    for (const int v : vertices) out.push_back(at(left ? mirrored_vertices()[std::size_t(v)] : v));
    return out;
  }

  /// Skin is nowhere of one colour: broad patches, and a fine grain.
  void variation() {
    canvas_.each([&](Place p, Rgb& colour) {
      const double broad = noise(14 * p) + 0.5 * noise(31 * p), grain = noise(420 * p);
      colour = scaled(colour, 1 + 0.01 * broad + 0.022 * grain);
      colour = mixed(colour, tone_.flush, 0.04 * (1 + noise(22 * p + Place(7, 3))));
    });
  }

  void flush() {
    const auto blush = [&](Place p, double across_mm, double down_mm, double share) {
      canvas_.blend_spot(p, across_mm, down_mm, tone_.flush, share);
    };
    for (const char* cheek : {"cheek_R", "cheek_L"})
      blush(at(cheek) - Place(0, 0.02), 36, 26, 0.24);
    blush(at("pronasale"), 15, 12, 0.24);
    for (const char* wing : {"alare_R", "alare_L"}) blush(at(wing), 9, 9, 0.26);
    blush(at("ibug68_8") - Place(0, 0.05), 16, 11, 0.2);
    blush(at("glabella"), 10, 12, 0.08);
    // The forehead has less blood in it than the cheeks.
    canvas_.blend_spot(at("glabella") - Place(0, 0.12), 48, 22,
                       mixed(tone_.base, {255, 236, 200}, 0.3), 0.4);
    // Nostrils: the canonical face has none to look into.
    for (const auto& [inner, outer] : {std::pair{97, 98}, std::pair{326, 327}})
      canvas_.blend_spot(
          0.5 * (at(inner) + at(outer)) + Place(inner == 97 ? 0.004 : -0.004, -0.017), 4.6, 2.6,
          scaled(tone_.flush, 0.28), 0.75);
  }

  void lids() {
    const Rgb shade = mixed(scaled(tone_.base, 0.72), scaled(tone_.flush, 0.7), 0.5);
    for (const auto* contour : {&right_eye_contour(), &left_eye_contour()}) {
      const std::vector<Place> rim = smooth_loop(places(*contour), 8);
      canvas_.blend_near(rim, 8.0, shade, 0.34);
      if (!fine_) continue;
      canvas_.blend_near(rim, 2.2, mixed(tone_.flush, shade, 0.4), 0.5);
      // Lashes, which are dense where they leave the upper lid.
      const auto [first, last] = std::minmax_element(
          rim.begin(), rim.end(), [](const Place& a, const Place& b) { return a.x() < b.x(); });
      const Place a = *first, b = *last;
      const std::size_t count = rim.size();
      for (std::size_t i = 0; i < count; ++i) {
        const Place p = rim[i], q = rim[(i + 1) % count];
        const double share = (p.x() - a.x()) / (b.x() - a.x());
        const bool upper = p.y() < a.y() + share * (b.y() - a.y());
        canvas_.stroke({p, q}, upper ? 1.3 : 0.7, tone_.hair, upper ? 0.75 : 0.3);
      }
    }
  }

  void lips() {
    const std::vector<Place> outer = smooth_loop(places(kOuterLips), 10);
    const std::vector<Place> inner = smooth_loop(places(lip_contour()), 10);
    const double middle = at("stomion").y();
    canvas_.fill_loop(outer, 1.5, [&](Place p, Rgb colour) {
      // Fine furrows run up and down; the upper lip faces the floor and looks darker.
      const double furrow = noise(Place(260 * p.x(), 26 * p.y()));
      const double tone = (p.y() < middle ? 0.95 : 1.04) * (1 + 0.035 * furrow);
      return mixed(colour, scaled(tone_.lip, tone), 0.68);
    });
    canvas_.blend_near(inner, 1.6, scaled(tone_.lip, 0.62), 0.6);
    for (const char* corner : {"cheilion_R", "cheilion_L"})
      canvas_.blend_spot(at(corner), 3.0, 2.2, scaled(tone_.lip, 0.55), 0.5);
  }

  /// Hair that stands up near the nose and lies along the brow farther out.
  void brow(bool left) {
    constexpr int hairs = 640;
    const std::vector<Place> upper = smooth_line(places(kBrowUpper, left), 12);
    const std::vector<Place> lower = smooth_line(places(kBrowLower, left), 12);
    std::vector<Place> outline = upper;
    outline.insert(outline.end(), lower.rbegin(), lower.rend());
    canvas_.fill_loop(outline, 4.5, [&](Place, Rgb colour) {
      return mixed(colour, tone_.hair, fine_ ? 0.3 : 0.55);
    });
    if (!fine_) return;
    Random random(left ? 2 : 1);
    const double last = double(upper.size() - 1);
    for (int i = 0; i < hairs; ++i) {
      const double along = random.next(), up = 0.02 + 0.8 * random.next();
      const double from = along * last;
      const auto k = std::size_t(std::min(from, last - 1));
      const double rest = from - double(k);
      const auto on = [&](const std::vector<Place>& line) -> Place {
        return line[k] + rest * (line[k + 1] - line[k]);
      };
      const Place out = (upper[k + 1] - upper[k] + lower[k + 1] - lower[k]).normalized();
      const Place rise = (on(upper) - on(lower)).normalized();
      const double angle = (1.15 * std::pow(1 - along, 1.4) + 0.06 + 0.22 * (random.next() - 0.5)) *
                           (1 - 0.9 * up * along);
      const double long_mm = (3.6 + 3.2 * random.next()) * (1 - 0.35 * along);
      const Place root = on(lower) + up * (on(upper) - on(lower));
      const Place lean = std::cos(angle) * out + std::sin(angle) * rise;
      const Place bent = std::cos(0.45 * angle) * out + std::sin(0.45 * angle) * rise;
      const double step = long_mm / kMillimetres / 2;
      canvas_.stroke({root, root + step * lean, root + step * (lean + bent)},
                     0.36 * (1 - 0.3 * along), tone_.hair,
                     (0.22 + 0.24 * random.next()) * std::min(1.0, 0.25 + 5 * along));
    }
  }

  const CanonicalFace& face_;
  Tone tone_;
  bool fine_;
  int size_px_;
  Canvas canvas_;
};

}  // namespace

std::array<std::uint8_t, 3> SkinPicture::at(double u, double v) const {
  const double last = size_px - 1;
  const double x = std::clamp(u * size_px - 0.5, 0.0, last),
               y = std::clamp(v * size_px - 0.5, 0.0, last);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, size_px - 1),
            y1 = std::min(y0 + 1, size_px - 1);
  std::array<std::uint8_t, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto pixel = [&](int px, int py) {
      return double(rgb[3 * (std::size_t(py) * std::size_t(size_px) + std::size_t(px)) + k]);
    };
    const double top = std::lerp(pixel(x0, y0), pixel(x1, y0), x - x0);
    const double bottom = std::lerp(pixel(x0, y1), pixel(x1, y1), x - x0);
    out[k] = static_cast<std::uint8_t>(std::lround(std::lerp(top, bottom, y - y0)));
  }
  return out;
}

std::array<std::uint8_t, 3> tone_colour(SkinTone tone) {
  const Rgb base = tone_of(tone).base;
  return {std::uint8_t(base[0]), std::uint8_t(base[1]), std::uint8_t(base[2])};
}

const SkinPicture& painted_skin(SkinTone tone, SkinDetail detail) {
  constexpr std::size_t tones = words_of(SkinTone{}).size();
  static std::array<SkinPicture, 2 * tones> pictures;
  static std::array<std::once_flag, 2 * tones> once;
  const std::size_t at = 2 * std::size_t(tone) + std::size_t(detail);
  std::call_once(once[at], [&] { pictures[at] = Painter(tone_of(tone), detail).paint(); });
  return pictures[at];
}

}  // namespace hyperex::face
