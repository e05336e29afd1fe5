/// @file
/// The order in which src.txt is read: what the answers are computed by first, the formulas before the chapters that use them.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::submission {

struct SourceFile {
    std::string path;         // "src/main.cpp"
    std::string_view bytes;   // compiled in
};

/// What the questions' answers are computed by: their chapters, and of the mathematics, the meshes and the studies what they cite and
/// include, then what that includes, and so on, the nearest first, as long as all is at most `most_lines` long with `lines_a_file` for
/// each file. A header and what implements it come together.
std::set<std::string> answering_files(const std::vector<SourceFile>& files, const std::vector<std::string>& cited, int most_lines,
                                      int lines_a_file);

/// Where a file stands in the listing.
struct ReadingPlace {
    std::size_t part = 0;
    std::string module;   // its path without its ending: by module, a header before what implements it
    bool is_implementation = false;
    auto operator<=>(const ReadingPlace&) const = default;
};
ReadingPlace reading_place(const std::string& path, bool answers);
/// "The questions"
std::string_view title_of_part(std::size_t part);
/// Is the part one of files that the answers are computed by?
bool answers(std::size_t part);

}   // namespace meshfolio::submission
