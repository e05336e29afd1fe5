/// @file
/// The direction and size of a picture, as a user gives them.
#pragma once

#include <optional>

namespace render {

/// The axis of the model that points up.
enum class Up { x, y, z };

/// The place of a camera [degrees]: from the front of the model to its right, and upwards. `roll` turns the camera anticlockwise. The front
/// is +z if x or y is up, and -y if z is up; the right is -y if x is up, else +x.
struct Angles {
    double azimuth = 0, elevation = 0, roll = 0;
    bool operator==(const Angles&) const = default;
};

/// By default a model is seen as hero_view() decides.
struct Sight {
    std::optional<Angles> camera = {};
    std::optional<Up> up = {};   // nothing: y for a camera and for the views along the axes; hero_view() finds its own
    double zoom = 1;             // factor of the size in the picture
    bool operator==(const Sight&) const = default;
};

}   // namespace render
