#include "sheet/ticks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace render {

namespace {

/// Returns m × 10^e, rounded once for ordinary e.
double scaled(double m, int e) { return e < 0 ? m / std::pow(10.0, -e) : m * std::pow(10.0, e); }

struct Step {
    double mantissa;   // 1, 2, 2.5 or 5
    int exponent;

    double value() const { return scaled(mantissa, exponent); }
    /// Returns the number of the first multiple of the step from `low` on, last() of the last up to `high`; an end within rounding of a
    /// multiple counts.
    double first(double low) const { return std::ceil(low / value() - 1e-9); }
    double last(double high) const { return std::floor(high / value() + 1e-9); }
};

/// Returns the step with a number of ticks nearest to `wanted`.
Step best_step(double low, double high, int wanted) {
    const int exponent = static_cast<int>(std::floor(std::log10(high - low)));
    Step best{1, exponent};
    double difference = std::numeric_limits<double>::infinity();
    for (int e = exponent - 2; e <= exponent + 1; ++e)
        for (const double mantissa : {1.0, 2.0, 2.5, 5.0}) {
            const Step step{mantissa, e};
            const double d = std::abs(step.last(high) - step.first(low) + 1 - wanted);
            if (d < difference) best = step, difference = d;
        }
    return best;
}

std::string fixed(double x, int decimals) {
    std::array<char, 512> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, std::chars_format::fixed, decimals);
    std::string text(buffer.data(), end.ptr);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    const std::size_t point = std::min(text.find('.'), text.size()), sign = text.front() == '-' ? 1 : 0;
    if (point - sign == 5) text.insert(point - 3, "\u202f");   // numbers of more digits have a power of ten
    if (text.front() == '-') text.replace(0, 1, is_zero ? "" : "\u2212");
    return text;
}

}   // namespace

std::vector<double> round_ticks(double low, double high, int wanted) {
    if (!(low < high) || !std::isfinite(high - low) || wanted < 1) return {};
    const Step step = best_step(low, high, wanted);
    std::vector<double> ticks;
    const auto last = static_cast<std::int64_t>(step.last(high));
    for (auto i = static_cast<std::int64_t>(step.first(low)); i <= last && ticks.size() < 1000; ++i) {
        const double tick = scaled(static_cast<double>(i) * step.mantissa, step.exponent) + 0.0;   // never −0
        if (tick >= low && tick <= high && (ticks.empty() || tick > ticks.back())) ticks.push_back(tick);
    }
    return ticks;
}

std::vector<double> decade_ticks(double low, double high) {
    const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9)), last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    std::vector<double> ticks;
    for (int exponent = first; exponent <= last; ++exponent)
        for (const double mantissa : {1.0, 2.0, 5.0}) {
            const double tick = scaled(mantissa, exponent);
            if (mantissa > 1 && last - first > 3) continue;
            if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) ticks.push_back(tick);
        }
    return ticks;
}

TickLabels tick_labels(const std::vector<double>& ticks) {
    TickLabels labels;
    if (ticks.empty()) return labels;
    const double largest = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
    const int exponent = largest > 0 ? static_cast<int>(std::floor(std::log10(largest) + 1e-12)) : 0;
    const bool plain = exponent >= -3 && exponent <= 4;
    std::vector<double> mantissas;
    mantissas.reserve(ticks.size());
    for (const double t : ticks) mantissas.push_back(plain ? t : scaled(t, -exponent));
    const double step = mantissas.size() > 1 ? mantissas[1] - mantissas[0] : std::abs(mantissas[0]);
    int decimals = 0;   // as few as write every number exactly, up to rounding noise
    const auto is_exact = [&](double m) {
        return std::abs(m - std::round(m / scaled(1, -decimals)) * scaled(1, -decimals)) <= 1e-3 * step;
    };
    while (decimals < 17 && !std::ranges::all_of(mantissas, is_exact)) ++decimals;
    for (const double m : mantissas) labels.text.push_back(fixed(m, decimals));
    if (plain) return labels;
    static constexpr std::array<const char*, 10> superscript{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    labels.power = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) labels.power += superscript[static_cast<std::size_t>(digit - '0')];
    return labels;
}

std::string number_text(double x) {
    if (x == 0 || !std::isfinite(x)) return x == 0 ? "0" : "";
    const int last = static_cast<int>(std::floor(std::log10(std::abs(x)))) - 2;
    const TickLabels label = tick_labels({scaled(std::round(scaled(x, -last)), last)});
    return label.text.front() + (label.power.empty() ? "" : "\u202f×\u202f" + label.power);
}

std::string share_text(double share) {
    if (share < 0.001) return "<\u202f0.1\u202f%";
    return fixed(100 * share, share < 0.0995 ? 1 : 0) + "\u202f%";
}

}   // namespace render
