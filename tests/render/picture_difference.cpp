#include "render/picture_difference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "color/colormap.h"
#include "color/srgb.h"
#include "render/color_difference.h"

namespace render {

namespace {

void check(const Image& a, const Image& b) {
    const auto size_of = [](const Image& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("picture_difference: pictures of " + size_of(a) + " and " + size_of(b));
}

Image on_white(const Image& image) {
    Image result(image.width, image.height);
    paste(result, image, 0, 0);
    return result;
}

/// Grey of the colour's lightness, compressed to the upper quarter.
Rgba pale(Rgba color) { return rgba_of_lab({72 + 0.2 * lab_of(color).x, 0, 0}); }

}   // namespace

PictureDifference picture_difference(const Image& a, const Image& b, const DifferenceOptions& options) {
    check(a, b);
    const Image one = on_white(a), other = on_white(b);
    const Colormap& magma = colormap_named("magma");
    PictureDifference difference{0, 0, 0, one};
    std::vector<double> distances(one.pixels.size());
    tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
        const Rgba p = one.pixels[i], q = other.pixels[i];
        distances[i] = p == q ? 0 : delta_e_2000(lab_of(p), lab_of(q));
        difference.picture.pixels[i] = distances[i] > options.threshold ? color_at(magma, distances[i] / options.brightest) : pale(p);
    });
    for (const double d : distances) {   // in order, so that the sum does not depend on threads
        difference.mean += d;
        difference.largest = std::max(difference.largest, d);
        difference.share += d > options.threshold ? 1 : 0;
    }
    const auto pixels = static_cast<double>(std::max<std::size_t>(1, distances.size()));
    difference.mean /= pixels, difference.share /= pixels;
    return difference;
}

}   // namespace render
