#include "output/draw/finished_picture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel_tasks.h"
#include "png/png.h"
#include "scene/camera.h"
#include "sheet/view_label.h"

namespace meshfolio::output {

namespace {

/// How many pixels of a rectangle differ from the one in the corner of the picture.
int covered(const render::Image& picture, int x0, int y0, int width, int height) {
    int count = 0;
    for (int y = std::max(0, y0); y < std::min(picture.height, y0 + height); ++y)
        for (int x = std::max(0, x0); x < std::min(picture.width, x0 + width); ++x) count += picture.at(x, y) == picture.at(0, 0) ? 0 : 1;
    return count;
}

}   // namespace

void label_view(render::Image& picture, std::string_view view) {
    const int side = std::min(picture.width, picture.height);
    if (side < 100 || view == render::three_quarter_view().name) return;
    const double em = std::clamp(0.028 * side, 11.0, 36.0);
    const int width = static_cast<int>(render::view_label_width(view, em)), height = static_cast<int>(render::view_label_height(em));
    const int left = static_cast<int>(0.6 * em), right = picture.width - left - width;
    const int top = static_cast<int>(0.4 * em), bottom = picture.height - top - height;
    // The corner where it hides least of the surface; the lower left one if there is a choice.
    std::pair<int, int> corner{left, bottom};
    for (const auto& other : {std::pair{right, bottom}, std::pair{left, top}, std::pair{right, top}})
        if (covered(picture, other.first, other.second, width, height) < covered(picture, corner.first, corner.second, width, height))
            corner = other;
    render::draw_view_label(picture, corner.first + width / 2.0, corner.second + height / 2.0, view, em, {90, 90, 100, 255});
}

render::Image part_of(const render::Image& picture, int left, int top, int width, int height) {
    render::Image part(width, height);
    render::paste(part, picture, -left, -top);
    return part;
}

bool cut_pictures(const render::Image& sheet, report::DrawnFigure& figure) {
    constexpr int quality = 80;
    std::vector<report::DrawnPicture*> pictures;
    for (report::DrawnPanel& panel : figure.panels)
        for (report::DrawnPicture& picture : panel.pictures) pictures.push_back(&picture);
    const auto lies_inside = [&](const report::DrawnPicture* p) {
        return p->left >= 0 && p->top >= 0 && p->width > 0 && p->height > 0 && p->width <= sheet.width && p->height <= sheet.height &&
               p->left <= sheet.width - p->width && p->top <= sheet.height - p->height;
    };
    if (!std::all_of(pictures.begin(), pictures.end(), lies_inside)) return false;
    for_each_task(pictures.size(), [&](std::size_t i) {
        report::DrawnPicture& p = *pictures[i];
        p.jpeg = render::encode_jpeg(part_of(sheet, p.left, p.top, p.width, p.height), quality);
    });
    return true;
}

}   // namespace meshfolio::output
