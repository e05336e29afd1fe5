// The order of src.txt: the files that compute the answers come first, formulas before the chapters that use them.
#include <algorithm>
#include <map>

#include "submission/source_listing.h"

namespace meshfolio::submission {

namespace {

std::string module_of(std::string_view path) { return std::string(path.substr(0, path.rfind('.'))); }

bool is_chapter(std::string_view path) { return path.starts_with("src/questions/q"); }

bool may_answer(std::string_view path) {
    const auto begins = [&](std::string_view beginning) { return path.starts_with(beginning); };
    return is_chapter(path) || begins("src/geometry/") || (begins("src/mesh/") && !begins("src/mesh/io/")) ||
           begins("src/questions/bench/");
}

/// The files of a module, the modules that they include, and their length.
struct Module {
    std::vector<std::string> files, includes;
    int lines = 0;
};

std::map<std::string, Module> modules_of(const std::vector<SourceFile>& files, int lines_a_file) {
    constexpr std::string_view directive = "#include \"";
    std::map<std::string, Module> modules;
    for (const auto& [path, bytes] : files) {
        if (!may_answer(path)) continue;
        Module& module = modules[module_of(path)];
        module.files.push_back(path);
        for (std::size_t at = bytes.find(directive); at != std::string_view::npos; at = bytes.find(directive, at + 1)) {
            const std::size_t begin = at + directive.size();
            module.includes.push_back(module_of("src/" + std::string(bytes.substr(begin, bytes.find('"', begin) - begin))));
        }
        module.lines += lines_a_file + static_cast<int>(std::ranges::count(bytes, '\n'));
    }
    return modules;
}

}   // namespace

const std::vector<ReadingPart>& reading_parts() {
    static const std::vector<ReadingPart> list{
        {"The formulas: Laplacians", true, {"src/geometry/operators/"}},
        {"The formulas: curvatures", true, {"src/geometry/curvature/"}},
        {"The formulas: spectra", true, {"src/geometry/spectrum/"}},
        {"The formulas: smoothing", true, {"src/geometry/smoothing/"}},
        {"The formulas: denoising, and what is measured", true, {"src/geometry/denoising/", "src/geometry/measures/"}},
        {"The formulas: sparse matrices", true, {"src/geometry/"}},
        {"The meshes", true, {"src/mesh/"}},
        {"The questions", true, {"src/questions/q"}},
        {"What the questions measure", true, {"src/questions/"}},
        {"The rest of the mathematics", false, {"src/geometry/"}},
        {"The rest of the meshes, and their files", false, {"src/mesh/"}},
        {"What questions share, and the sections that support them", false, {"src/questions/"}},
        {"The report and its writers", false, {"src/report/"}},
        {"Drawing and publishing", false, {"src/output/"}},
        {"The submission", false, {"src/submission/"}},
        {"The command line", false, {"src/main.cpp", "src/cli/", "src/run/", "src/python/"}},
        {"The base of all", false, {"src/"}},
        {"The renderer", false, {""}},
    };
    return list;
}

std::set<std::string> answering_files(const std::vector<SourceFile>& files, const std::vector<std::string>& cited, int most_lines,
                                      int lines_a_file) {
    const std::map<std::string, Module> modules = modules_of(files, lines_a_file);
    std::set<std::string> chosen, known, ring;   // the ring: modules equally far from the questions
    for (const auto& [name, module] : modules)
        if (is_chapter(name)) ring.insert(name);
    int left = most_lines;
    for (bool first = true; !ring.empty(); first = false) {
        std::set<std::string> next;
        if (first)
            for (const std::string& file : cited) next.insert(module_of(file));
        for (const std::string& name : ring) {
            known.insert(name);
            const auto module = modules.find(name);
            if (module == modules.end() || module->second.lines > left) continue;
            left -= module->second.lines;
            chosen.insert(module->second.files.begin(), module->second.files.end());
            next.insert(module->second.includes.begin(), module->second.includes.end());
        }
        std::erase_if(next, [&](const std::string& name) { return known.contains(name); });
        ring = std::move(next);
    }
    return chosen;
}

ReadingPlace reading_place(const std::string& path, bool answers) {
    const auto begins = [&](std::string_view beginning) { return path.starts_with(beginning); };
    const auto holds = [&](const ReadingPart& part) { return part.answers == answers && std::ranges::any_of(part.beginnings, begins); };
    const auto part = static_cast<std::size_t>(std::ranges::find_if(reading_parts(), holds) - reading_parts().begin());
    return {part, module_of(path), !path.ends_with(".h")};
}

}   // namespace meshfolio::submission
