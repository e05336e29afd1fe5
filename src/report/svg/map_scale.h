/// @file
/// Maps values to colours: a few bands of equal width, whose edges look like contour lines.
#pragma once

#include <string>

#include "report/document.h"

namespace meshfolio::report {

class MapScale {
public:
    static constexpr int bands = 16;

    /// Takes the range of the map, else that of its finite values, symmetric about the middle for a diverging map.
    explicit MapScale(const Map& map);

    double low() const { return low_; }
    double high() const { return high_; }
    /// Band 0 to bands − 1 of a finite value; values beyond the ends get the first or the last band.
    int band(double value) const;
    /// "#1f9e89"
    std::string color(int band) const;
    /// Do finite values exceed the ends?
    bool clips_below() const { return clips_below_; }
    bool clips_above() const { return clips_above_; }

private:
    bool logarithmic_, diverging_;
    double low_ = 0, high_ = 1;
    bool clips_below_ = false, clips_above_ = false;
};

/// The edges between cells of these centres, one more than there are: half-way between neighbours (of their logarithms on a logarithmic
/// axis). Empty if the centres do not ascend or the axis cannot show them.
std::vector<double> cell_edges(const std::vector<double>& centres, bool logarithmic);

}   // namespace meshfolio::report
