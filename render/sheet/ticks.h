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

/// @param ticks  ascending and equally spaced, as round_ticks makes them
TickLabels tick_labels(const std::vector<double>& ticks);

/// A share for people: "1.9 %", "< 0.1 %".
std::string share_text(double share);

}   // namespace render
