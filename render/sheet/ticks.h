/// @file
/// The numbers along a colour bar.
#pragma once

#include <string>
#include <vector>

namespace render {

struct TickLabels {
    std::vector<std::string> text;   // one a tick, all with the same decimals
    std::string power;               // "10⁻⁷", by which all are to be multiplied; empty: 1
};

/// The powers of ten in [low, high], and twice and five times them where they are four or fewer.
std::vector<double> decade_ticks(double low, double high);

/// @param ticks  ascending, as round_ticks and decade_ticks make them
TickLabels tick_labels(const std::vector<double>& ticks);

/// A number for people, with at most three digits: "0.05", "2.5 × 10⁻⁷".
std::string number_text(double x);

/// A share for people: "1.9 %", "< 0.1 %".
std::string share_text(double share);

}   // namespace render
