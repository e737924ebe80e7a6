// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/render/canvas.hpp"
#include "hyperex/render/image.hpp"
#include "hyperex/render/side_marks.hpp"

namespace hyperex::render {

struct SheetPicture {
  Image image;
  std::string caption;   ///< under the picture; may be empty
  SideMarks marks = {};  ///< over the picture, at its upper corners
};

/// Pictures side by side under one title, with one colour bar for all of them.
struct ContactSheet {
  std::string title = {};
  std::string note = {};                    ///< one line under the title; may be empty
  std::vector<SheetPicture> pictures = {};  ///< row by row; cells are as large as the largest
  int columns = 2;
  std::optional<ColourBar> bar = {};
};

/// Throws std::invalid_argument where there is no picture or no column.
Image contact_sheet(const ContactSheet& sheet);

}  // namespace hyperex::render
