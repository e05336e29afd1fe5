#include "submission/source_tree.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "embedded_data.h"
#include "embedded_reports.h"
#include "embedded_source.h"

namespace meshfolio::submission {

std::vector<SourceFile> source_tree() {
    std::vector<SourceFile> files;
    const auto add = [&](const std::string& folder, const auto& embedded) {
        for (const auto& file : embedded) files.push_back({folder + std::string(file.name), file.bytes});
    };
    add("", meshfolio_embedded::embedded_source());
    add("data/", meshfolio_embedded::embedded_data());
    add("data/reports/", meshfolio_embedded::embedded_reports());
    std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

std::vector<std::string> build_packages(std::string_view setup_script) {
    constexpr std::string_view opening = "build_packages=\"";
    const std::size_t begin = setup_script.find(opening);
    const std::size_t end = begin == std::string_view::npos ? begin : setup_script.find('"', begin + opening.size());
    if (end == std::string_view::npos) throw std::logic_error("tests/setup.sh has no list build_packages");
    std::istringstream words(std::string(setup_script.substr(begin + opening.size(), end - begin - opening.size())));
    std::vector<std::string> packages;
    for (std::string word; words >> word;) packages.push_back(word);
    return packages;
}

}   // namespace meshfolio::submission
