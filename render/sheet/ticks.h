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

/// Returns about `wanted` multiples of a round step (1, 2, 2.5 or 5 times a power of ten) in [low, high]; none unless low < high and wanted
/// ≥ 1.
std::vector<double> round_ticks(double low, double high, int wanted);

/// Returns the powers of ten in [low, high], low > 0, and their double and fivefold if the exponents of low and high differ by at most 3.
std::vector<double> decade_ticks(double low, double high);

/// Returns the labels of ascending ticks, with the fewest decimals that write each exactly: "0.0", "0.5", "1.0". Below 10⁻³ and from 10⁵ on
/// a power of ten is taken out: "0", "5" and the power "10⁻⁷" for 0 and 5·10⁻⁷.
TickLabels tick_labels(const std::vector<double>& ticks);

/// Returns a number with at most three digits, for people: "0.05", "2.5 × 10⁻⁷"; "" unless it is finite.
std::string number_text(double x);

/// Returns a share in percent, for people: "1.9 %" for 0.019, "12 %" for 0.12, "< 0.1 %" below 0.001, also for 0.
std::string share_text(double share);

}   // namespace render
