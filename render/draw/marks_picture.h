// Lines laid over a picture, and their legend.
#pragma once
#include "render/image/text.h"
#include "render/run/marks.h"

namespace erbs::render {

inline constexpr Ink text_ink{38, 42, 48, 1}, panel{250, 251, 252, 0.80};  // of what is written upon a picture

// unit: px per row of a picture with 720 rows.
void draw_marks(Image& image, const Marks& marks, const View& view, double unit);
// Below a legend that ends at row `top` (px); `margin` in rows of a picture with 720 rows.
void draw_mark_legend(Image& image, const std::vector<MarkRow>& rows, double top, double margin, double unit, const Font& font);

// A colour of a picture as its bytes; the shaders convert the same way.
Ink display(const Vec3& linear);

}  // namespace erbs::render
