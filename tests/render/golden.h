/// @file
/// Golden images: pictures that were looked at and found good, against which later ones are held.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>

#include "png/png.h"
#include "render/decode_picture.h"
#include "render/picture_difference.h"
#include "sheet/figure_sheet.h"

namespace render_tests {

/// Tolerances between compilers and processors, in CIEDE2000: nearly equal everywhere, visible at one pixel in five hundred at most.
struct GoldenTolerance {
    double mean = 0.05;
    double seen = 2;   // ΔE
    double share_seen = 0.002;
};

inline void write_picture(const std::filesystem::path& path, const render::Image& image) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << render::encode_png(image);
}

/// Empty when there is no such file or it is no PNG.
inline render::Image read_picture(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width, &height, &channels,
                              4),
        std::free);
    if (!pixels) return {};
    render::Image image(width, height);
    std::memcpy(image.pixels.data(), pixels.get(), 4 * image.pixels.size());
    return image;
}

/// The two pictures and their difference side by side.
inline render::Image review_sheet(const std::string& name, const render::Image& drawn, const render::Image& golden,
                                  const render::PictureDifference& difference) {
    render::ContactSheet sheet{.title = name, .view_names = {"drawn", "golden", "\u0394E 1 to 10"}};
    sheet.pictures = {drawn, golden, difference.picture};
    return render::compose(sheet);
}

/// Holds `drawn` against folder/name.png; the complaint names a sheet in `review` to be looked at. Empty when all is well.
/// With `update` it becomes the golden picture instead.
inline std::string golden_complaint(const std::string& name, const render::Image& drawn, const std::filesystem::path& folder,
                                    const std::filesystem::path& review, bool update, const GoldenTolerance& tolerance = {}) {
    const std::filesystem::path file = folder / (name + ".png"), sheet = review / (name + ".png");
    if (update) {
        write_picture(file, drawn);
        return {};
    }
    const render::Image golden = read_picture(file);
    if (golden.width != drawn.width || golden.height != drawn.height) {
        write_picture(sheet, drawn);
        return "no golden picture of this size in " + file.string() + "; drawn: " + sheet.string() +
               "\nIf it is good, run the test with MESHFOLIO_UPDATE=1.";
    }
    const render::PictureDifference d = render::picture_difference(drawn, golden, {.threshold = tolerance.seen});
    if (d.mean <= tolerance.mean && d.share <= tolerance.share_seen) return {};
    write_picture(sheet, review_sheet(name, drawn, golden, render::picture_difference(drawn, golden)));
    std::ostringstream complaint;
    complaint << name << " differs from its golden picture: mean \u0394E " << d.mean << " (allowed " << tolerance.mean << "), largest "
              << d.largest << ", " << 100 * d.share << " % of the pixels above " << tolerance.seen << " (allowed "
              << 100 * tolerance.share_seen << " %).\nLook at " << sheet.string()
              << "\nIf the new picture is better, run the test with MESHFOLIO_UPDATE=1.";
    return complaint.str();
}

}   // namespace render_tests
