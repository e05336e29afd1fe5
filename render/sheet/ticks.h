/// @file
/// Ticks of a colour bar and their numbers.
#pragma once

#include <string>
#include <vector>

namespace render {

struct TickLabels {
    std::vector<std::string> text;   // one a tick, all with the same number of decimals
    std::string power;               // the common factor, "10⁻⁷"; empty: 1
};

/// Returns about `wanted` multiples of a round step (1, 2, 2.5 or 5 times a power of ten) in [low, high]; none unless low < high.
std::vector<double> round_ticks(double low, double high, int wanted);

/// Returns the powers of ten in [low, high] and, if the range spans at most four decades, their double and fivefold.
std::vector<double> decade_ticks(double low, double high);

/// Returns the labels of ascending ticks.
TickLabels tick_labels(const std::vector<double>& ticks);

/// Returns a number with at most three digits, for people: "0.05", "2.5 × 10⁻⁷".
std::string number_text(double x);

/// Returns a share in percent, for people: "1.9 %" for 0.019, "< 0.1 %" below 0.001.
std::string share_text(double share);

}   // namespace render
