#pragma once

namespace robosim {

/// Size of a figure on paper.
struct FigurePage {
  double width_mm = 180;  ///< [20, 2000]; the height follows from the world's shape, up to √2 times the width
  double font_pt = 8;     ///< size of the text, [3, 72]; the title is a third larger
};

/// One column of a journal with two.
inline constexpr FigurePage kColumnPage{88, 8};

}  // namespace robosim
