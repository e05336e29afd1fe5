#include <tbb/task_arena.h>
#include <Eigen/Core>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/cache_folder.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/provenance.h"
#include "cli/search_path.h"
#include "number_text.h"

namespace meshfolio::cli {

namespace {

constexpr std::array pdf_engines{"chromium-headless-shell", "chrome-headless-shell", "chromium",       "chromium-browser",
                                 "google-chrome-stable",    "google-chrome",         "microsoft-edge", "weasyprint"};

/// "/home/me/.cache/meshfolio, 171 MB of at most 2147 MB"
std::string cache_in_words() try {
    const auto folder = output::default_cache_folder();
    if (!folder) return "none: neither XDG_CACHE_HOME nor HOME names a folder";
    const auto megabytes = [](std::uintmax_t bytes) { return plain_text(static_cast<double>(bytes) / 1e6, 4) + " MB"; };
    const std::uintmax_t limit = cache_limit();
    return printable(folder->string()) + ", " + megabytes(output::ResultCache(*folder, limit).size().bytes) + " of at most " +
           megabytes(limit);
} catch (const OutputError& error) {
    return std::string("none: ") + error.what();
}

nlohmann::ordered_json findings() {
    nlohmann::ordered_json json;
    const report::Provenance provenance = provenance_of({}, 0);
    json["version"] = provenance.version;
    json["commit"] = provenance.commit;
    json["compiler"] = provenance.compiler;
    json["threads"] = tbb::this_task_arena::max_concurrency();
    json["fonts"] = "DejaVu Sans, compiled in";
    json["libraries"] = provenance.libraries;
    json["pdf_engines"] = nlohmann::ordered_json::object();
    for (const char* engine : pdf_engines) {
        if (const auto path = found_on_path(engine)) json["pdf_engines"][engine] = printable(path->string());
    }
    json["cache"] = cache_in_words();
    json["missing"] = nlohmann::ordered_json::array();
    if (json["pdf_engines"].empty()) json["missing"].push_back("a PDF engine: apt install chromium-headless-shell");
    return json;
}

std::string told(const nlohmann::ordered_json& json) {
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        text += key + std::string(key.size() < 26 ? 26 - key.size() : 1, ' ') + value + "\n";
    };
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            for (const auto& [name, detail] : value.items())
                line((key == "libraries" ? "library " : "PDF engine ") + name, detail.get<std::string>());
        } else if (value.is_array()) {
            for (const auto& entry : value) line(key, entry.get<std::string>());
        } else {
            line(key, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
    return text;
}

}   // namespace

Command doctor_command(CLI::App& parent) {
    const auto json = std::make_shared<bool>(false);
    CLI::App* app = parent.add_subcommand("doctor", "What was found on this machine, and what is missing");
    app->add_flag("--json", *json, "for programs");
    app->footer("Example: meshfolio doctor");
    return {app, [json] {
                const auto all = findings();
                print(*json ? all.dump(2) + "\n" : told(all));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
