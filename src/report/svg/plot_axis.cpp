#include "report/svg/plot_axis.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"

namespace meshfolio::report {

namespace {

constexpr double wanted_ticks = 6;

/// Returns the smallest of 1, 2 or 5 times a power of ten that is at least x.
double round_step(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= x * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

std::vector<Tick> linear_ticks(double low, double high) {
    const double step = round_step((high - low) / wanted_ticks);
    std::vector<Tick> ticks;
    const double first = std::ceil(low / step - 1e-9);
    for (int i = 0; i <= 2 * wanted_ticks; ++i) {   // fewer, unless the range is too narrow for its numbers to differ
        const double value = (first + i) * step;
        if (!(value <= high + 1e-9 * step)) break;
        // Enough digits to distinguish neighbouring ticks.
        const double decade = value == 0 ? 0 : std::floor(std::log10(std::abs(value)) + 1e-9);
        const int digits = static_cast<int>(decade - std::floor(std::log10(step) + 1e-9)) + 1;
        ticks.push_back({value, value == 0 ? "0" : readable(value, std::clamp(digits, 1, 15))});
    }
    return ticks;
}

/// Returns ticks at decades, labelled at every second or third if there are many, and at 1, 2, 5 if there are few.
std::vector<Tick> logarithmic_ticks(double low, double high) {
    const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9)), last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
    const double decades = std::log10(high) - std::log10(low);
    if (decades < 0.7) return linear_ticks(low, high);
    const int stride = static_cast<int>(std::ceil(decades / 8));
    std::vector<Tick> ticks;
    for (int exponent = first; exponent <= last; ++exponent) {
        for (const int factor : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
            const double value = factor * std::pow(10, exponent);
            if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
            const bool between = decades <= 2.2 && (factor == 2 || factor == 5);
            std::string label;
            const bool is_plain = exponent >= -2 && exponent <= 3;
            if (factor == 1 && exponent % stride == 0) label = is_plain ? readable(std::pow(10, exponent), 1) : power_of_ten(exponent);
            if (between) label = readable(value, 1);
            if (!label.empty() || (stride == 1 && decades <= 6)) ticks.push_back({value, label});
        }
    }
    return ticks;
}

}   // namespace

Axis::Axis(const std::vector<double>& values, bool logarithmic, bool with_zero) : logarithmic_(logarithmic) {
    double low = INFINITY, high = -INFINITY;
    for (const double value : values) {
        if (!shows(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (!(low <= high)) {
        low_ = logarithmic ? 0.1 : 0;
        high_ = logarithmic ? 10 : 1;
    } else if (logarithmic) {
        const double margin = low == high ? 2 : std::exp(0.03 * (std::log(high) - std::log(low)));   // the quotient may overflow
        low_ = std::max(low / margin, 1e-307);
        high_ = std::min(high * margin, 1e307);
    } else {
        // A constant stands in the middle, and so do values that differ by rounding alone.
        const double magnitude = std::max(std::abs(low), std::abs(high));
        const double spread = high - low;
        const bool constant = spread <= 1e-12 * magnitude;
        const double margin = constant ? (magnitude > 0 ? 0.1 * magnitude : 1) : 0.04 * spread;
        low_ = low >= 0 && low <= 0.3 * high ? 0 : low - margin;
        high_ = high <= 0 && high >= 0.3 * low && low < 0 ? 0 : high + margin;
    }
    ticks_ = logarithmic ? logarithmic_ticks(low_, high_) : linear_ticks(low_, high_);
    zero_apart_ = with_zero && logarithmic && low <= high && std::find(values.begin(), values.end(), 0) != values.end();
    if (zero_apart_) ticks_.insert(ticks_.begin(), {0, "0"});
}

Axis Axis::exactly(double low, double high, bool logarithmic) {
    Axis axis(logarithmic);
    if (!(axis.shows(low) && axis.shows(high) && low < high)) return {std::vector<double>{}, logarithmic};
    axis.low_ = low;
    axis.high_ = high;
    axis.ticks_ = logarithmic ? logarithmic_ticks(low, high) : linear_ticks(low, high);
    return axis;
}

bool Axis::shows(double value) const {
    return std::isfinite(value) && (!logarithmic_ || value > 0 || (zero_apart_ && value == 0)) && std::abs(value) < 1e300;
}

double Axis::position(double value) const {
    if (logarithmic_) {
        if (value == 0) return 0.2 * zero_share;
        const double share = (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_));
        return zero_apart_ ? zero_share + (1 - zero_share) * share : share;
    }
    return (value - low_) / (high_ - low_);
}

}   // namespace meshfolio::report
