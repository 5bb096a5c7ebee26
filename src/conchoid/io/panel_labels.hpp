#pragma once

#include <string>
#include <vector>

#include "conchoid/io/picture.hpp"

namespace conchoid {

/// Columns [left, right) and rows [top, bottom) of an image.
struct PixelArea {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Range of the colour map: over all panels whose legend has the same name.
Vec2 value_range(const std::vector<PicturePanel>& panels, const std::string& name);

/// Height that the texts of a panel need above and below the picture [pixel].
/// @param size  height of the title's capital letters [pixel]
Vec2 label_room(const PicturePanel& panel, double size);

/// Title, caption and, where a mesh shows values, the legend, over a part of the image.
void draw_labels(Image& image, const PicturePanel& panel, const PixelArea& area, const Vec2& range,
                 double size);

}  // namespace conchoid
