/// @file
/// A figure as one picture: a title, pictures and words in their places, a colour bar.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/image.h"
#include "sheet/contact_sheet.h"

namespace render {

/// Places are in pixels from the upper left corner of the body, which lies between title and colour bar.
struct FigureSheet {
    struct Picture {
        std::shared_ptr<const Image> image;
        int left = 0, top = 0;
    };
    /// A line in the middle of a box or at its left, perhaps with a small colour bar behind it; the name of one of the six views gets its
    /// tripod.
    struct Words {
        std::string text;
        int left = 0, top = 0, width = 0, height = 0;
        bool is_centred = true;
        std::optional<ColorBar> bar = {};
    };
    std::string title = {}, subtitle = {};
    std::vector<Picture> pictures = {};
    std::vector<Words> words = {};
    std::optional<ColorBar> color_bar = {};
    double em = 16;        // text size
    int least_width = 0;   // of the body
    Rgba background{255, 255, 255, 255};
};

struct ComposedFigure {
    Image image;
    int left = 0, top = 0;   // of the body
};
ComposedFigure compose(const FigureSheet& sheet);

}   // namespace render
