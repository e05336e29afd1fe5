#include "output/draw/comparison_picture.h"

namespace meshfolio::output {

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

}   // namespace meshfolio::output
