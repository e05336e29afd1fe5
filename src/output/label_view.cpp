#include "output/label_view.h"

#include <algorithm>

#include "view_label.h"

namespace meshfolio::output {

void label_view(render::Image& picture, std::string_view view) {
    const int side = std::min(picture.width, picture.height);
    if (side < 100) return;
    const double em = std::clamp(0.028 * side, 11.0, 36.0);
    const double x = 0.6 * em + 0.5 * render::view_label_width(view, em),
                 y = picture.height - 0.4 * em - 0.5 * render::view_label_height(em);
    render::draw_view_label(picture, x, y, view, em, {90, 90, 100, 255});
}

}   // namespace meshfolio::output
