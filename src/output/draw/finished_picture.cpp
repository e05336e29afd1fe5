#include "output/draw/finished_picture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel_tasks.h"
#include "png/png.h"
#include "scene/camera.h"
#include "sheet/view_label.h"

namespace meshfolio::output {

void label_view(render::Image& picture, std::string_view view, const render::Sight& sight) {
    const int side = std::min(picture.width, picture.height);
    if (side < 100 || !render::is_name_of_six(view)) return;
    const double em = std::clamp(0.028 * side, 11.0, 36.0);
    const int width = static_cast<int>(render::view_label_width(view, em)), height = static_cast<int>(render::view_label_height(em));
    const int left = static_cast<int>(0.6 * em), right = picture.width - left - width;
    const int top = static_cast<int>(0.4 * em), bottom = picture.height - top - height;
    const auto hidden = [&](const std::pair<int, int>& corner) {   // pixels that differ from the background
        int count = 0;
        for (int y = std::max(0, corner.second); y < std::min(picture.height, corner.second + height); ++y)
            for (int x = std::max(0, corner.first); x < std::min(picture.width, corner.first + width); ++x)
                count += picture.at(x, y) == picture.at(0, 0) ? 0 : 1;
        return count;
    };
    const auto [x, y] = std::ranges::min({std::pair{left, bottom}, std::pair{right, bottom}, std::pair{left, top}, std::pair{right, top}},
                                         {}, hidden);   // the first on a tie
    render::Drawing label;
    render::add_view_label(label, x + width / 2.0, y + height / 2.0, view, em, {90, 90, 100, 255}, sight.up.value_or(render::Up::y));
    render::paint(picture, label);
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
    if (!std::ranges::all_of(pictures, lies_inside)) return false;
    for_each_task(pictures.size(), [&](std::size_t i) {
        report::DrawnPicture& p = *pictures[i];
        p.jpeg = render::encode_jpeg(part_of(sheet, p.left, p.top, p.width, p.height), quality);
    });
    return true;
}

}   // namespace meshfolio::output
