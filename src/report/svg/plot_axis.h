/// @file
/// One axis of a plot: its range, its round ticks, and the positions of values.
#pragma once

#include <string>
#include <vector>

namespace meshfolio::report {

struct Tick {
    double value;
    std::string label;   // empty: a minor tick
};

class Axis {
public:
    /// Covers the finite `values` (on a logarithmic axis the positive ones) with a margin. One value or none give a range, too.
    /// @param with_zero  a zero among the values of a logarithmic axis gets a tick of its own at the low end, apart from the others
    Axis(const std::vector<double>& values, bool logarithmic, bool with_zero = false);
    /// Returns the axis from `low` to `high` without a margin; the default range unless low < high and the axis can show both.
    static Axis exactly(double low, double high, bool logarithmic);

    /// True if the axis can show this value at all: finite, and positive on a logarithmic axis.
    bool shows(double value) const;
    /// Returns 0 for the low end and 1 for the high end. Only for values that the axis shows.
    double position(double value) const;

    double low() const { return low_; }
    double high() const { return high_; }
    bool zero_apart() const { return zero_apart_; }
    static constexpr double zero_share = 0.1;   // of the axis, for a zero that is apart
    const std::vector<Tick>& ticks() const { return ticks_; }

private:
    explicit Axis(bool logarithmic) : logarithmic_(logarithmic) {}
    bool logarithmic_, zero_apart_ = false;
    double low_ = 0, high_ = 1;
    std::vector<Tick> ticks_;
};

}   // namespace meshfolio::report
