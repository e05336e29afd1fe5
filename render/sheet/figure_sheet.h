/// @file
/// Figures as one picture: a title, pictures and words in their places, a colour bar.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/image.h"
#include "sheet/color_bar.h"

namespace render {

/// A figure with places in pixels from the upper left corner of its body, which lies between title and colour bar.
struct FigureSheet {
    using Picture = Drawing::Picture;
    /// A line of text in a box, perhaps followed by a small colour bar. The name of one of the six views gets a tripod.
    struct Words {
        std::string text;
        int left = 0, top = 0, width = 0, height = 0;
        bool is_centred = true;   // else at the left
        std::optional<ColorBar> bar = {};
    };
    std::string title = {}, subtitle = {};
    std::vector<Picture> pictures = {};
    std::vector<Words> words = {};
    std::optional<ColorBar> color_bar = {};
    double em = 16;        // text size
    int least_width = 0;   // of the body
    double margin = 1.2;   // around all [em]
    Rgba background{255, 255, 255, 255};
    Up up = Up::y;   // of the named views
};

struct SheetDrawing {
    Drawing drawing;
    int left = 0, top = 0;   // of the body
};
/// Returns a figure as a drawing; its size follows from its contents.
SheetDrawing drawing_of(const FigureSheet& sheet);

/// Views of one mesh with their names below, three in a line; the six views stand 2 × 3, +x +y +z over −x −y −z.
struct ContactSheet {
    std::string title = {};
    std::string subtitle = {};   // mesh, counts, settings
    std::vector<std::string> view_names = {};
    std::vector<Image> pictures = {};   // all of one size
    std::optional<ColorBar> color_bar = {};
    int cell = 0;   // largest side of a picture in the sheet [pixels]; 0: as it is
    Rgba background{255, 255, 255, 255};
    Up up = Up::y;   // of the views
};

/// Draws a contact sheet; its size follows from its contents. @throws std::invalid_argument if the pictures differ in size or are empty
Image compose(const ContactSheet& sheet);

}   // namespace render
