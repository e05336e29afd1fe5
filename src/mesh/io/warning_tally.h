/// @file
/// Warnings of a reader: a file with 20 000 odd faces gives one line, not 20 000.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/mesh_files.h"

namespace meshfolio {

class WarningTally {
public:
    /// `one` is the whole message of a single case; of several it is "N `many`". The first one's line is kept, and its `example`
    /// stands in brackets. Cases of the same `many` are one kind.
    void add(long line, std::string_view one, std::string_view many, const std::string& example = "");

    /// One warning a kind, in the order of their first cases.
    std::vector<MeshWarning> warnings() const;

private:
    struct Kind {
        std::string_view one, many;   // string literals
        std::string example;
        long line;
        long long count;
    };
    std::vector<Kind> kinds_;
};

}   // namespace meshfolio
