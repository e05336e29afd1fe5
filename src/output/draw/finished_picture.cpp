#include "output/draw/finished_picture.h"

#include <algorithm>
#include <utility>

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

render::Image with_room_below(const render::Image& picture, int height, const render::ColorBar* bar) {
    render::Image taller(picture.width, height, picture.at(0, 0));
    render::paste(taller, picture, 0, 0);
    if (bar == nullptr) return taller;
    render::ColorBar plain = *bar;
    plain.histogram.clear();   // the sheet has it, and the room is small
    const int room = height - picture.height;
    // As large as fits, a little air included.
    const double em = 0.92 * room / render::color_bar_height(plain, 100) * 100;
    render::draw_color_bar(taller, plain, 0, picture.height, picture.width, em, {27, 27, 31, 255});
    return taller;
}

Preview preview_of(const render::Image& picture, int widest, int jpeg_quality) {
    if (picture.width <= widest) return {render::encode_jpeg(picture, jpeg_quality), picture.width, picture.height};
    const int height = std::max(1, picture.height * widest / picture.width);
    return {render::encode_jpeg(render::shrink(picture, widest, height), jpeg_quality), widest, height};
}

}   // namespace meshfolio::output
