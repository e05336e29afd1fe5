#include "image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "srgb.h"

namespace render {

namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// source over target (Porter and Duff 1984), in linear light.
Rgba over(Rgba source, Rgba target) {
    if (source.a == 255 || target.a == 0) return source;
    if (source.a == 0) return target;
    LinearColor result = linear_of(source);
    result += (1 - result.a) * linear_of(target);
    return srgb_of(result);
}

/// Which old pixels a new one covers along one axis, and by how much; the weights sum to 1.
struct Footprint {
    int first = 0;
    std::vector<float> weights;
};

std::vector<Footprint> footprints(int old_size, int new_size) {
    std::vector<Footprint> result(index(new_size));
    const double scale = double(old_size) / new_size;
    for (int i = 0; i < new_size; ++i) {
        const double begin = i * scale, end = std::min<double>(old_size, (i + 1) * scale);
        Footprint& f = result[index(i)];
        f.first = static_cast<int>(begin);
        for (int j = f.first; j < end; ++j)
            f.weights.push_back(static_cast<float>((std::min<double>(end, j + 1) - std::max<double>(begin, j)) / (end - begin)));
    }
    return result;
}

/// Adds `weight` times row y of `image`, averaged along x, to `sum`.
void add_row(const Image& image, int y, float weight, const std::vector<Footprint>& columns, std::vector<LinearColor>& sum) {
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const Rgba* pixel = &image.at(columns[x].first, y);
        LinearColor mean;
        for (const float w : columns[x].weights) mean += w * linear_of(*pixel++);
        sum[x] += weight * mean;
    }
}

}   // namespace

void paste(Image& target, const Image& source, int x, int y) {
    const int x0 = std::max(0, -x), x1 = std::min(source.width, target.width - x);
    const int y0 = std::max(0, -y), y1 = std::min(source.height, target.height - y);
    for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u) target.at(x + u, y + v) = over(source.at(u, v), target.at(x + u, y + v));
}

Image shrink(const Image& image, int width, int height) {
    if (width < 1 || height < 1 || width > image.width || height > image.height)
        throw std::invalid_argument("shrink: cannot make " + std::to_string(width) + "x" + std::to_string(height) + " of " +
                                    std::to_string(image.width) + "x" + std::to_string(image.height));
    if (width == image.width && height == image.height) return image;
    const auto columns = footprints(image.width, width), lines = footprints(image.height, height);
    Image result(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        const Footprint& line = lines[index(y)];
        std::vector<LinearColor> sum(index(width));
        for (std::size_t j = 0; j < line.weights.size(); ++j)
            add_row(image, line.first + static_cast<int>(j), line.weights[j], columns, sum);
        for (int x = 0; x < width; ++x) result.at(x, y) = srgb_of(sum[index(x)]);
    });
    return result;
}

}   // namespace render
