#include "scene/image.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "color/srgb.h"
#include "rounding.h"

namespace render {

namespace {

/// Composites `source` over `target` (Porter and Duff 1984) in linear light.
Rgba over(Rgba source, Rgba target) {
    if (source.a == 255 || target.a == 0) return source;
    if (source.a == 0) return target;
    LinearColor result = linear_of(source);
    result += (1 - result.a) * linear_of(target);
    return srgb_of(result);
}

/// The old pixels that a new one covers along one axis, with their shares, which sum to 1.
struct Footprint {
    int first = 0;
    std::vector<float> weights;

    int size() const { return static_cast<int>(weights.size()); }
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

/// The old rows that a new one covers, averaged column by column. Stretches of one colour are found by comparing bytes.
class AveragedRows {
public:
    AveragedRows(const Image& image, const Footprint& rows)
        : light_(index(image.width)), one_color_(index((image.width + stretch - 1) / stretch)) {
        for (int x = 0; x < image.width; x += stretch) average(image, rows, x, std::min(stretch, image.width - x));
    }

    /// True if all old pixels in these columns are known to have one colour.
    bool one_color(const Footprint& columns) const {
        const int at = columns.first / stretch;
        return one_color_[index(at)] != 0 && (columns.first + columns.size() - 1) / stretch == at;
    }

    Rgba mean(const Footprint& columns) const {
        LinearColor sum;
        const LinearColor* light = &light_[index(columns.first)];
        for (const float w : columns.weights) sum += w * *light++;
        const bool opaque = sum.a > 1 - 1e-6F;   // weights sum to 1 up to rounding
        return opaque ? Rgba{srgb_of(sum.r), srgb_of(sum.g), srgb_of(sum.b), 255} : srgb_of(sum);
    }

private:
    static constexpr int stretch = 32;

    void average(const Image& image, const Footprint& rows, int x, int count) {
        const Rgba color = image.at(x, rows.first);
        std::uint32_t difference = 0;
        for (int j = 0; difference == 0 && j < rows.size(); ++j) {
            const Rgba* pixels = &image.at(x, rows.first + j);
            for (int i = 0; i < count; ++i) difference |= std::bit_cast<std::uint32_t>(pixels[i]) ^ std::bit_cast<std::uint32_t>(color);
        }
        one_color_[index(x / stretch)] = difference == 0;
        LinearColor* light = &light_[index(x)];
        if (difference == 0) std::fill_n(light, count, linear_of(color));
        for (int j = 0; difference != 0 && j < rows.size(); ++j) {
            const Rgba* pixels = &image.at(x, rows.first + j);
            const float weight = rows.weights[index(j)];
            for (int i = 0; i < count; ++i) light[i] += weight * linear_of(pixels[i]);
        }
    }

    std::vector<LinearColor> light_;
    std::vector<std::uint8_t> one_color_;
};

}   // namespace

Image::Image(int w, int h, Rgba fill) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
    tbb::parallel_for(tbb::blocked_range<Rgba*>(pixels.data(), pixels.data() + pixels.size(), 1 << 17),
                      [fill](const auto& part) { std::fill(part.begin(), part.end(), fill); });
}

void paste(Image& target, const Image& source, int x, int y) {
    const int x0 = std::max(0, -x), x1 = std::min(source.width, target.width - x);
    const int y0 = std::max(0, -y), y1 = std::min(source.height, target.height - y);
    if (x0 >= x1 || y0 >= y1) return;
    tbb::parallel_for(tbb::blocked_range<int>(y0, y1, 64), [&](const auto& rows) {
        for (int v = rows.begin(); v < rows.end(); ++v) {
            const Rgba* from = &source.at(x0, v);
            Rgba* to = &target.at(x + x0, y + v);
            std::uint8_t opacity = 255;
            for (int i = 0; i < x1 - x0; ++i) opacity &= from[i].a;
            if (opacity == 255) std::copy_n(from, x1 - x0, to);
            else std::transform(from, from + (x1 - x0), to, to, over);
        }
    });
}

Image shrink(const Image& image, int width, int height) {
    if (width < 1 || height < 1 || width > image.width || height > image.height)
        throw std::invalid_argument("shrink: cannot make " + std::to_string(width) + "x" + std::to_string(height) + " of " +
                                    std::to_string(image.width) + "x" + std::to_string(image.height));
    if (width == image.width && height == image.height) return image;
    const auto columns = footprints(image.width, width), lines = footprints(image.height, height);
    Image result(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        const Footprint& rows = lines[index(y)];
        const AveragedRows averaged(image, rows);
        for (int x = 0; x < width; ++x) {
            const Footprint& cell = columns[index(x)];
            result.at(x, y) = averaged.one_color(cell) ? image.at(cell.first, rows.first) : averaged.mean(cell);
        }
    });
    return result;
}

}   // namespace render
