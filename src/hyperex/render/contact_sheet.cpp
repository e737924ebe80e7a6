// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/contact_sheet.hpp"

#include <algorithm>
#include <stdexcept>

namespace hyperex::render {
namespace {

/// The marks are at the upper edge, where the head leaves room in any view.
void draw_marks(Canvas& canvas, const SheetPicture& picture, int x, int y) {
  constexpr double inset = 12, size_px = 15;
  const double line = y + inset + size_px - 3, right = x + picture.image.width - inset;
  const auto letter = [&](double at, const std::string& text, Align align) {
    if (!text.empty())
      canvas.text(at, line, text, {.size_px = size_px, .align = align, .bold = true});
  };
  letter(x + inset, picture.marks.at_left, Align::left);
  letter((x + inset + right) / 2, picture.marks.in_middle, Align::centre);
  letter(right, picture.marks.at_right, Align::right);
}

/// A long caption is written smaller, so that it does not overlap the next one.
TextStyle caption_style(const Canvas& canvas, const std::string& caption, int width_px) {
  TextStyle style{.size_px = 13, .align = Align::centre};
  const double width = canvas.text_width(caption, style);
  if (width > width_px) style.size_px = std::max(7.0, style.size_px * width_px / width);
  return style;
}

}  // namespace

Image contact_sheet(const ContactSheet& sheet) {
  if (sheet.pictures.empty() || sheet.columns < 1)
    throw std::invalid_argument("contact sheet: at least one picture and one column are needed");
  constexpr int margin = 28, gap = 10;
  int cell_width = 0, cell_height = 0;
  bool captions = false;
  for (const SheetPicture& picture : sheet.pictures) {
    cell_width = std::max(cell_width, picture.image.width);
    cell_height = std::max(cell_height, picture.image.height);
    captions = captions || !picture.caption.empty();
  }
  const int columns = std::min(sheet.columns, static_cast<int>(sheet.pictures.size()));
  const int rows = (static_cast<int>(sheet.pictures.size()) + columns - 1) / columns;
  const int step_x = cell_width + gap, step_y = cell_height + gap + (captions ? 22 : 0);
  const int top = margin + (sheet.title.empty() ? 0 : 30) + (sheet.note.empty() ? 0 : 24);
  const TextStyle title{.size_px = 20, .bold = true};
  const TextStyle note{.size_px = 13, .colour = palette::faint_ink};
  const Canvas measure(1, 1);
  const int text_width = static_cast<int>(
      std::max(measure.text_width(sheet.title, title), measure.text_width(sheet.note, note)));
  int bar_width = 0;
  if (sheet.bar)
    bar_width =
        gap +
        std::max(70, static_cast<int>(measure.text_width(sheet.bar->label, {.size_px = 12})) + 4);
  const int grid_width = columns * step_x - gap;
  Canvas canvas(2 * margin + std::max(grid_width + bar_width, text_width),
                top + rows * step_y - gap + margin);

  if (!sheet.title.empty()) canvas.text(margin, margin + 16, sheet.title, title);
  if (!sheet.note.empty()) canvas.text(margin, top - 14, sheet.note, note);
  for (size_t i = 0; i < sheet.pictures.size(); ++i) {
    const SheetPicture& picture = sheet.pictures[i];
    const int x = margin + static_cast<int>(i) % columns * step_x;
    const int y = top + static_cast<int>(i) / columns * step_y;
    const int left = x + (cell_width - picture.image.width) / 2;
    const int above = y + (cell_height - picture.image.height) / 2;
    canvas.draw(picture.image, left, above);
    draw_marks(canvas, picture, left, above);
    canvas.text(x + cell_width / 2.0, y + cell_height + 16, picture.caption,
                caption_style(canvas, picture.caption, cell_width));
  }
  if (sheet.bar) {
    const int height = std::clamp(rows * step_y - 60, 60, 420);
    canvas.colour_bar(margin + grid_width + gap, top + (rows * step_y - gap - height) / 2.0, height,
                      *sheet.bar);
  }
  return canvas.image();
}

}  // namespace hyperex::render
