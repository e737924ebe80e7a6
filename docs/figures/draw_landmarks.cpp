// SPDX-License-Identifier: GPL-3.0-or-later
// Draws docs/images/landmarks.png: the embedded face with the names of its landmarks.
#include <algorithm>
#include <iostream>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/render/render.hpp"

using namespace hyperex;

namespace {

constexpr int kFace_px = 640, kHeight_px = 760, kMargin_px = 220;

struct Label {
  std::string text;
  render::Projected at;
};

/// Names in a column beside the face, from top to bottom, a line to each point.
void draw_column(render::Canvas& canvas, std::vector<Label> labels, int face_x, bool left) {
  std::sort(labels.begin(), labels.end(),
            [](const Label& a, const Label& b) { return a.at.y < b.at.y; });
  const double text_x = left ? face_x - 6 : face_x + kFace_px + 6;
  double y = 0;
  for (const auto& label : labels) {
    y = std::max(y + 26, label.at.y);
    canvas.line(text_x, y, face_x + label.at.x, label.at.y, render::palette::ink, 0.7);
    canvas.text(left ? text_x - 4 : text_x + 4, y + 5, label.text,
                {.size_px = 15, .align = left ? render::Align::right : render::Align::left});
    canvas.disc(face_x + label.at.x, label.at.y, 3.5, render::palette::driven);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "draw_landmarks: expected the name of the picture to write\n";
    return 2;
  }
  const auto face = anatomy::embedded_face();
  const double aspect = double(kFace_px) / kHeight_px;
  const render::Camera camera =
      render::framing(face.mesh.points, render::front_view(), aspect, Vec3::UnitY(), 0.03);
  const render::Image picture = render::render({{.mesh = face.mesh}}, camera,
                                               {.width_px = kFace_px, .height_px = kHeight_px});
  render::Canvas canvas(2 * kFace_px + 2 * kMargin_px, kHeight_px);
  const int anatomical_x = kFace_px + kMargin_px;
  canvas.draw(picture, 0, 0);
  canvas.draw(picture, anatomical_x, 0);
  std::vector<Label> right, middle;
  for (const auto& [name, position] : face.landmarks) {
    const auto at = render::project(camera, kFace_px, kHeight_px, position);
    if (name.starts_with("ibug68_")) {
      canvas.disc(at.x, at.y, 3, render::palette::driven);
      const std::string number = name.substr(7);
      // The mouth's outer and inner corners lie side by side.
      const double aside = number == "48" || number == "64" ? -7 : number == "54" ? 9 : 0;
      canvas.text(at.x + aside, at.y - 5, number, {.size_px = 12, .align = render::Align::centre});
    } else if (name.ends_with("_R")) {
      right.push_back({name, at});
    } else if (!name.ends_with("_L")) {
      middle.push_back({name, at});
    }
  }
  draw_column(canvas, right, anatomical_x, true);
  draw_column(canvas, middle, anatomical_x, false);
  render::write_png(argv[1], canvas.image());
}
