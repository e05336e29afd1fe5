#include "mesh/io/warning_tally.h"

#include <algorithm>

namespace meshfolio {

void WarningTally::add(long line, std::string_view one, std::string_view many, const std::string& example) {
    const auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.many == many; });
    if (kind != kinds_.end()) {
        ++kind->count;
    } else {
        kinds_.push_back({one, many, example, line, 1});
    }
}

std::vector<MeshWarning> WarningTally::warnings() const {
    std::vector<MeshWarning> warnings;
    for (const Kind& kind : kinds_) {
        std::string message = kind.count == 1 ? std::string(kind.one) : std::to_string(kind.count) + " " + std::string(kind.many);
        if (!kind.example.empty()) message += kind.count == 1 ? " (" + kind.example + ")" : " (first " + kind.example + ")";
        warnings.push_back({std::move(message), kind.line});
    }
    return warnings;
}

}   // namespace meshfolio
