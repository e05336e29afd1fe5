/// @file
/// A drawing with an item of each kind in a cell of its own, and programs that show what its files contain.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "base/child_process.h"
#include "base/file_bytes.h"
#include "png/png.h"
#include "sheet/drawing.h"
#include "temporary_folder.h"

namespace meshfolio::testing_tools {

inline constexpr int cell_width = 320, cell_height = 80, cells = 10, exact_cells = 3;   // pictures and ramp come first
inline constexpr double sample_resolution = 220;

/// Each letter with its accent, words with kerning, Greek: what text_line() has to place.
inline const std::string sample_words = "AVATAR To h\u0304 H\u0304", more_sample_words = "\u03bb = 10\u207b\u2077 (\u03a9)";

inline render::Drawing sample_drawing() {
    using render::Drawing;
    render::Drawing drawing{cell_width, cells * cell_height};
    const auto add = [&](const auto& item) {
        Drawing cell{cell_width, cell_height};
        cell.items.push_back(item);
        drawing.add(cell, 0, static_cast<int>(drawing.items.size()) * cell_height);
    };
    const auto solid = std::make_shared<render::Image>(300, 60), cut_out = std::make_shared<render::Image>(300, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 300; ++x) {
            const auto byte = [](int v) { return static_cast<std::uint8_t>(v); };
            solid->at(x, y) = {byte(x * 5 / 6), byte(y * 4), byte(x * y), 255};
            cut_out->at(x, y) = {byte(y * 4), byte(x * 5 / 6), 90, byte(std::hypot(x - 150, 2 * y - 60) < 55 ? 255 : 0)};
        }
    add(Drawing::Picture{solid, 9, 11});
    add(Drawing::Picture{cut_out, 9, 11});
    add(Drawing::Ramp{&render::colormap_named("viridis"), 10, 20, 310, 50});
    add(Drawing::Text{{10, 50}, sample_words, {.size = 40}});
    add(Drawing::Text{{310, 50},
                      more_sample_words,
                      {.size = 40, .color = {160, 0, 0, 255}, .align = render::Align::right, .weight = render::Weight::bold}});
    add(Drawing::Path{{{20, 50}, {100, 20}, {160, 60}, {220, 20}, {300, 50}}, 6, {20, 80, 160, 255}});
    add(Drawing::Path{{{20, 40}, {300, 40.5}}, 20, {0, 120, 0, 100}});
    add(Drawing::Ring{{100, 40}, 25, 5, {180, 20, 60, 255}});
    add(Drawing::Area{{{115, 6}, {135, 67}, {83, 29}, {147, 29}, {95, 67}}, {20, 20, 20, 255}});
    add(Drawing::Area{{{30, 10}, {200, 10}, {200, 70}, {30, 70}}, {0, 0, 255, 80}});
    return drawing;
}

/// The ink of a cell: what its pixels lack to white, and where its middle is.
struct CellInk {
    double sum = 0;
    glm::dvec2 middle{0};
};

inline CellInk ink_of_cell(const render::Image& image, int cell) {
    CellInk ink;
    for (int y = cell * cell_height; y < (cell + 1) * cell_height; ++y)
        for (int x = 0; x < cell_width; ++x) {
            const render::Rgba p = image.at(x, y);
            const double lack = 3 * 255 - p.r - p.g - p.b;
            ink.sum += lack;
            ink.middle += lack * glm::dvec2(x, y);
        }
    ink.middle /= ink.sum;
    return ink;
}

/// Expects a picture of a file of the sample to show what painted() shows: pixels and ramps within 3 of 255, all else with ink within 4 %
/// and its middle within half a pixel (only painted() fits text to rows of pixels, and browsers round edges).
inline void expect_shows_the_sample(const render::Image& shown) {
    const render::Image wanted = render::painted(sample_drawing());
    ASSERT_EQ(shown.width, wanted.width);
    ASSERT_EQ(shown.height, wanted.height);
    int largest = 0;
    for (int y = 0; y < exact_cells * cell_height; ++y)
        for (int x = 0; x < wanted.width; ++x) {
            const render::Rgba a = wanted.at(x, y), b = shown.at(x, y);
            for (const int difference : {a.r - b.r, a.g - b.g, a.b - b.b}) largest = std::max(largest, std::abs(difference));
        }
    EXPECT_LE(largest, 3);
    for (int cell = exact_cells; cell < cells; ++cell) {
        const CellInk is = ink_of_cell(shown, cell), should = ink_of_cell(wanted, cell);
        EXPECT_NEAR(is.sum / should.sum, 1, 0.04) << "cell " << cell;
        EXPECT_NEAR(is.middle.x, should.middle.x, 0.5) << "cell " << cell;
        EXPECT_NEAR(is.middle.y, should.middle.y, 0.5) << "cell " << cell;
    }
}

/// Returns the end of a command of the shell in a folder; its code is 127 if the program is not installed.
inline ChildEnd run_in(const TemporaryFolder& folder, const std::string& command) {
    return run_child({"/bin/sh", {"-c", command}, {}, folder.path()});
}

}   // namespace meshfolio::testing_tools
