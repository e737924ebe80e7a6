// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/contact_sheet.hpp"

#include <algorithm>
#include <stdexcept>

namespace hyperex::render {

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
    canvas.draw(picture.image, x + (cell_width - picture.image.width) / 2,
                y + (cell_height - picture.image.height) / 2);
    canvas.text(x + cell_width / 2.0, y + cell_height + 16, picture.caption,
                {.size_px = 13, .align = Align::centre});
  }
  if (sheet.bar) {
    const int height = std::clamp(rows * step_y - 60, 60, 420);
    canvas.colour_bar(margin + grid_width + gap, top + (rows * step_y - gap - height) / 2.0, height,
                      *sheet.bar);
  }
  return canvas.image();
}

}  // namespace hyperex::render
