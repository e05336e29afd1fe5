/// @file
/// One axis of a plot: its range, its round ticks, and where a value falls.
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
    /// Covers the finite `values` (on a logarithmic axis the positive ones) with a margin; a single value and no value give a range too.
    /// @param with_zero  a zero among the values of a logarithmic axis has a tick of its own at the low end, apart from the others
    Axis(const std::vector<double>& values, bool logarithmic, bool with_zero = false);
    /// From `low` to `high` without a margin; the default range if the axis cannot show both, or unless low < high.
    static Axis exactly(double low, double high, bool logarithmic);

    /// Whether the axis can show this value at all.
    bool shows(double value) const;
    /// 0 at the low end, 1 at the high end. Only for values the axis shows.
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
