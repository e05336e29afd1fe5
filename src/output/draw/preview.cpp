#include "output/draw/preview.h"

#include <algorithm>

#include "png/png.h"

namespace meshfolio::output {

Preview preview_of(const render::Image& picture, int widest, int jpeg_quality) {
    if (picture.width <= widest) return {render::encode_jpeg(picture, jpeg_quality), picture.width, picture.height};
    const int height = std::max(1, picture.height * widest / picture.width);
    return {render::encode_jpeg(render::shrink(picture, widest, height), jpeg_quality), widest, height};
}

}   // namespace meshfolio::output
