/// @file
/// The visible difference of two pictures: for golden images, and to compare pictures before and after a change.
#pragma once

#include "scene/image.h"

namespace render {

struct DifferenceOptions {
    double threshold = 1;    // ΔE that counts as seen
    double brightest = 10;   // ΔE at the light end of the picture's colours
};

/// ΔE by CIEDE2000 of each pair of pixels, composited on white.
struct PictureDifference {
    double mean = 0, largest = 0;
    double share = 0;   // of the pixels, above the threshold
    Image picture;      // magma where it is above, over the first picture in pale grey
};

/// @throws std::invalid_argument when the sizes differ
PictureDifference picture_difference(const Image& a, const Image& b, const DifferenceOptions& options = {});

}   // namespace render
