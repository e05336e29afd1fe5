/// @file
/// The settings of chapters. Defaults are those of data/report.toml.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meshfolio {

/// The settings of one question; empty lists mean the question's own choice.
struct QuestionSettings {
    std::vector<std::string> meshes;   // paths as in the settings file; empty: the question's roles
    std::filesystem::path base;        // folder of the settings file
    std::vector<int> k;                // modes (q4)
    std::vector<double> lambda;        // raw steps [length²]
    std::vector<int> iterations;
    std::vector<double> noise;   // σ as a fraction of the bounding-box diagonal (q7)
    std::uint64_t seed = 1;
    bool quick = false;              // small settings for a first look
    bool laboratory = false;         // the whole grid where the report itself takes a part that fits its budget
    std::string colormap = "pale";   // for unsigned quantities
};

/// Limits of settings; messages about a value beyond a limit name it.
namespace limits {
inline constexpr long long smallest_size = 16, largest_size = 4096;   // pixels of one view
inline constexpr long long largest_k = 100000;                        // modes
inline constexpr long long largest_iterations = 100000;
inline constexpr double largest_lambda = 1e100;      // [length²]
inline constexpr double largest_noise = 10;          // box diagonals
inline constexpr long long largest_threads = 1024;   // 0: all
inline constexpr long long largest_list = 100;       // values of one list
inline constexpr long long longest_text = 200;       // bytes of a title or author
inline constexpr long long longest_page = 20'000;    // bytes of a text in Markdown
inline constexpr double largest_points = 1e6;        // of a question
}   // namespace limits

/// Returns the text of a settings file of data/reports as compiled in, by its name without ending; empty if there is none.
std::string_view bundled_report_text(const std::string& name);
/// Returns the names that bundled_report_text() knows, sorted.
std::vector<std::string> bundled_report_names();

/// Returns the default settings: the text of data/report.toml as compiled in.
std::string_view default_settings_text();

}   // namespace meshfolio
