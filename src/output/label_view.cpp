#include "output/label_view.h"

#include <algorithm>
#include <string>

#include "text.h"

namespace meshfolio::output {

void label_view(render::Image& picture, std::string_view view) {
    const int side = std::min(picture.width, picture.height);
    if (side < 100) return;
    std::string name(view);
    if (name.starts_with('-')) name.replace(0, 1, "\u2212");
    const double size = std::clamp(0.03 * side, 12.0, 40.0);
    render::draw_text(picture, 0.7 * size, picture.height - 0.7 * size, name, {.size = size, .color = {90, 90, 100, 255}});
}

}   // namespace meshfolio::output
