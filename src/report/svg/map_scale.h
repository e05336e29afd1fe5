/// @file
/// Maps values to colours, in bands of equal width that look like contour lines.
#pragma once

#include <string>

#include "report/document.h"

namespace meshfolio::report {

class MapScale {
public:
    static constexpr int bands = 16;

    /// Takes the range of the map, else that of its finite values, made symmetric about the middle for a diverging map. A single value is
    /// widened by half of it.
    explicit MapScale(const Map& map);

    double low() const { return low_; }
    double high() const { return high_; }
    /// Returns the band of a finite value, 0 to bands − 1; values beyond the ends are in the first or the last.
    int band(double value) const;
    /// Returns the colour of a band: "#1f9e89".
    std::string color(int band) const;
    /// True if finite values lie below low(), or above high().
    bool clips_below() const { return clips_below_; }
    bool clips_above() const { return clips_above_; }

private:
    bool logarithmic_, diverging_;
    double low_ = 0, high_ = 1;
    bool clips_below_ = false, clips_above_ = false;
};

/// Returns the n + 1 edges of n cells with these centres, half-way between neighbours (of their logarithms if `logarithmic`); the outer
/// cells are symmetric. Empty if the centres do not ascend or the axis cannot show them.
std::vector<double> cell_edges(const std::vector<double>& centres, bool logarithmic);

}   // namespace meshfolio::report
