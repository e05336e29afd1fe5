#include "run/batch/report_run.h"

#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/linux_only.h"

namespace meshfolio::run {

std::vector<std::string> report_words(const BatchFlags& flags, const BatchMesh& mesh, const std::vector<std::string>& more) {
    const ReportFlags& report = flags.report;
    std::vector<std::string> words{"report", mesh.file.starts_with('-') ? "./" + mesh.file : mesh.file,
                                   "--out=" + (std::filesystem::path(report.out) / mesh.name).string()};
    for (const auto& [name, value] : word_flags) {
        const bool is_own = value == &ReportFlags::out || value == &ReportFlags::threads;         // of each report
        if (!is_own && !(report.*value).empty()) words.push_back(name + ("=" + report.*value));   // one word: it may begin with a minus
    }
    for (const auto& [name, is_given] : {std::pair{"--quick", report.quick},
                                         {"--views-files", report.view_files},
                                         {"--sheets-only", report.sheets_only},
                                         {"--no-timings", report.no_timings},
                                         {"--no-source", report.no_source},
                                         {"--no-cache", report.no_cache}}) {
        if (is_given) words.emplace_back(name);
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

ChildEnd run_this_program(const std::vector<std::string>& words) {
    ChildTask task;
    task.program = this_program();
    task.arguments = words;
    task.environment["MESHFOLIO_PARENT"] = std::to_string(::getpid());
    task.folder = std::filesystem::current_path();
    task.limit = std::chrono::hours(24 * 20);   // as good as none
    task.tidies_up = true;
    return run_child(task);
}

std::optional<double> planned_vertices(const std::string& output) {
    using nlohmann::json;
    const std::size_t begin = output.starts_with("{\n") ? 0 : output.find("\n{\n");   // behind warnings
    if (begin == std::string::npos) return {};
    const json plan = json::parse(output.begin() + static_cast<std::ptrdiff_t>(begin), output.end(), nullptr, false);
    if (!plan.is_object() || !plan.contains("sections")) return {};
    for (const json& section : plan["sections"]) {
        for (const json& mesh : section.value("meshes", json::array()))
            if (mesh.contains("vertices") && mesh["vertices"].is_number()) return mesh["vertices"].get<double>();
    }
    return 0;   // none of what is asked for needs a mesh
}

std::string failure_of(const ChildEnd& end) {
    constexpr std::string_view program = "meshfolio: ";
    const std::string line = last_line(end);
    if (end.kind != ChildEnd::Kind::exited || !line.starts_with(program)) return "the report " + words_of(end);
    return line.substr(program.size());
}

}   // namespace meshfolio::run
