// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/pictures.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/ct/head_slices.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/render/side_marks.hpp"

namespace hyperex::ct {
namespace {

constexpr render::Colour kSkullColour{0.87, 0.84, 0.74}, kMandibleColour{0.55, 0.68, 0.86};
constexpr render::Colour kBehindBone{0.62, 0.60, 0.57};
constexpr double kSkinShare = 0.38;  // of the skin's picture, over bone

struct View {
  Vec3 to_viewer;
  const char* caption;
};
const std::vector<View> kViews = {{{-0.85, 0.1, 0.75}, "from the right"},
                                  {{0, 0, 1}, "from the front"},
                                  {{0.85, 0.1, 0.75}, "from the left"}};

/// Where bone is, it shines through the skin. `bone` was drawn before kBehindBone, whose colour is
/// near that of the skin, so that no bright seam runs along the bone's outline.
render::Image through(const render::Image& skin, const render::Image& bone) {
  render::Image out = skin;
  const render::Image empty(1, 1, kBehindBone);
  for (std::size_t p = 0; p < out.rgb.size(); p += 3) {
    const bool is_bone =
        !std::equal(empty.rgb.begin(), empty.rgb.end(), bone.rgb.begin() + std::ptrdiff_t(p));
    for (std::size_t c = 0; is_bone && c < 3; ++c)
      out.rgb[p + c] = std::uint8_t(
          std::lround(kSkinShare * skin.rgb[p + c] + (1 - kSkinShare) * bone.rgb[p + c]));
  }
  return out;
}

/// The height of a landmark, or a share of the head's height.
double height_of(const CtFace& face, const HeadSlices& slices, const char* name, double share) {
  const auto at = face.points.skin.find(name);
  return at != face.points.skin.end() ? at->second.y()
                                      : std::lerp(slices.low_m(1), slices.high_m(1), share);
}

}  // namespace

render::Image draw_slices(const CtFace& face) {
  const HeadSlices slices(face.series.volume, face.skin, face.bones);
  render::ContactSheet sheet;
  sheet.title = "Slices, with the surfaces drawn from them";
  sheet.note = "skin: yellow; skull: blue; mandible: pink; lengths as in the outputs";
  sheet.columns = 3;
  const auto add = [&](int axis, double place_m) {
    sheet.pictures.push_back(
        {slices.picture(axis, place_m), HeadSlices::caption(axis, place_m), {}});
  };
  const double nose = height_of(face, slices, "pronasale", 0.5),
               lip = height_of(face, slices, "subnasale", 0.42),
               chin = height_of(face, slices, "pogonion", 0.25);
  for (const double y : {nose, (lip + chin) / 2, chin}) add(1, y);
  const auto at = face.points.skin.find("pronasale");
  add(0, at != face.points.skin.end() ? at->second.x() : slices.middle_m().x());
  for (const double share : {0.75, 0.55})
    add(2, std::lerp(slices.low_m(2), slices.high_m(2), share));
  return render::contact_sheet(sheet);
}

render::Image draw_bones_through_skin(const CtFace& face) {
  render::ContactSheet sheet;
  sheet.title = "The bones through the skin";
  sheet.note = face.separated ? "skull: ivory; mandible: blue" : "skull and mandible in one piece";
  sheet.columns = 3;
  const render::RenderOptions options{.width_px = 420, .height_px = 560};
  std::vector<render::Surface> bones;
  if (face.bones.skull.triangles.rows() > 0)
    bones.push_back({.mesh = face.bones.skull, .plain = kSkullColour});
  if (face.bones.mandible.triangles.rows() > 0)
    bones.push_back({.mesh = face.bones.mandible, .plain = kMandibleColour});
  for (const View& view : kViews) {
    const render::Camera camera = render::framing(face.skin.points, view.to_viewer,
                                                  double(options.width_px) / options.height_px);
    const render::Image skin = render::render({{.mesh = face.skin}}, camera, options);
    render::RenderOptions of_bones = options;
    of_bones.background = kBehindBone;
    sheet.pictures.push_back(
        {bones.empty() ? skin : through(skin, render::render(bones, camera, of_bones)),
         view.caption, render::side_marks(camera)});
  }
  return render::contact_sheet(sheet);
}

render::Image draw_thickness(const CtFace& face) {
  const Eigen::VectorXd mm = 1e3 * face.thickness.shortest_m;
  std::vector<double> known;
  for (const double t : mm)
    if (!std::isnan(t)) known.push_back(t);
  double top = 20;
  if (!known.empty()) {
    const auto at = known.begin() + std::ptrdiff_t(0.98 * double(known.size() - 1));
    std::nth_element(known.begin(), at, known.end());
    top = std::max(5.0, 5 * std::ceil(*at / 5));
  }
  const render::Range range{0, top};
  render::ContactSheet sheet;
  sheet.title = "Thickness of the soft tissue: shortest distance to bone";
  sheet.note = face.separated ? "in front of the mandible's back and above the lower edge of the "
                                "jaw; elsewhere plain"
                              : "in front of the middle of the skull; elsewhere plain";
  sheet.columns = 3;
  sheet.bar = render::ColourBar{range, "mm", true};
  const render::RenderOptions options{.width_px = 420, .height_px = 560};
  for (const View& view : kViews) {
    const render::Camera camera = render::framing(face.skin.points, view.to_viewer,
                                                  double(options.width_px) / options.height_px);
    render::Surface surface{.mesh = face.skin, .scalar = mm.cast<float>(), .range = range};
    sheet.pictures.push_back(
        {render::render({surface}, camera, options), view.caption, render::side_marks(camera)});
  }
  return render::contact_sheet(sheet);
}

}  // namespace hyperex::ct
