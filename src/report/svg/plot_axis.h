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
    /// Covers the finite `values` (on a logarithmic axis the positive ones) with a margin. A single value is widened; no values give 0 to
    /// 1, or 0.1 to 10 if `logarithmic`.
    /// @param with_zero  a zero among the values of a logarithmic axis gets a tick of its own at the low end, apart from the others
    Axis(const std::vector<double>& values, bool logarithmic, bool with_zero = false);
    /// Returns the axis from `low` to `high` without a margin; from 0 to 1 (logarithmic: 0.1 to 10) unless low < high and it can show both.
    static Axis exactly(double low, double high, bool logarithmic);

    /// True if the axis can show this value: below 1e300 in size; on a logarithmic axis positive, or 0 if zero_apart().
    bool shows(double value) const;
    /// Returns the place of a value that the axis shows: 0 at low(), 1 at high(); a zero that is apart is at 0.02, low() then at 0.1.
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
