#include <tbb/task_arena.h>
#include <Eigen/Core>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "cli/commands.h"
#include "report/pdf/pdf_engine.h"
#include "report/writers.h"
#include "run/console.h"
#include "run/provenance.h"
#include "run/section_cache.h"

namespace meshfolio::cli {

namespace {

/// Returns the folder of the cache with its size, or the reason why there is none.
nlohmann::ordered_json cache_found() try {
    const auto folder = output::default_cache_folder();
    if (!folder) return {{"folder", "none: neither XDG_CACHE_HOME nor HOME names a folder"}};
    const std::uintmax_t limit = cache_limit();
    return {
        {"folder", printable(folder->string())}, {"used_bytes", output::ResultCache(*folder, limit).size().bytes}, {"limit_bytes", limit}};
} catch (const OutputError& error) {
    return {{"folder", std::string("none: ") + error.what()}};
}

nlohmann::ordered_json findings() {
    nlohmann::ordered_json json;
    const report::Provenance provenance = provenance_of({}, 0);
    json["version"] = provenance.version;
    json["commit"] = provenance.commit;
    json["compiler"] = provenance.compiler;
    json["threads"] = tbb::this_task_arena::max_concurrency();
    json["fonts"] = "TeX Gyre Pagella, Inter and DejaVu Sans Mono, compiled in";
    json["viewer"] = report::viewer_program().empty() ? "not built in" : "three.js, compiled in";
    json["libraries"] = provenance.libraries;
    json["cache"] = cache_found();
    const report::EngineFinding finding = report::find_pdf_engine(report::engine_search());
    json["pdf_engine"] = nullptr;
    if (finding.engine)
        json["pdf_engine"] = {{"program", printable(finding.engine->program.string())}, {"version", finding.engine->version}};
    json["pdf_engines_refused"] = finding.refused;
    json["missing"] = nlohmann::ordered_json::array();
    if (!finding.engine) json["missing"].push_back("a PDF engine: apt install chromium-headless-shell");
    if (report::viewer_program().empty()) json["missing"].push_back("the viewer of models: apt install npm, then build again");
    return json;
}

std::string doctor_text(const nlohmann::ordered_json& json) {
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        text += key + std::string(key.size() < 26 ? 26 - key.size() : 1, ' ') + value + "\n";
    };
    const std::map<std::string, std::string> group{{"libraries", "library "}, {"cache", "cache, "}, {"pdf_engine", "PDF engine, "}};
    constexpr std::string_view unit = "_bytes";
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            for (const auto& [name, detail] : value.items()) {
                if (detail.is_string()) line(group.at(key) + name, detail.get<std::string>());
                else line(group.at(key) + name.substr(0, name.size() - unit.size()), plain_text(detail.get<double>() / 1e6, 4) + " MB");
            }
        } else if (value.is_array()) {
            for (const auto& entry : value) line(key == "missing" ? key : "PDF engine refused", entry.get<std::string>());
        } else if (!value.is_null()) {
            line(key, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
    return text;
}

/// Returns "Ready: everything found", or "Works, without …" with each missing part and its remedy.
std::string verdict_of(const nlohmann::ordered_json& missing) {
    if (missing.empty()) return inked(Ink::green, "Ready: everything found") + "\n";
    std::string text;
    for (const auto& entry : missing) text += (text.empty() ? "Works, without " : "; without ") + entry.get<std::string>();
    return for_terminal(inked(Ink::yellow, text)) + "\n";
}

}   // namespace

Command doctor_command(CLI::App& parent) {
    const auto json = std::make_shared<bool>(false);
    CommandOptions app(parent, "doctor", "What was found on this machine, and what is missing");
    app.flag("--json", *json, "for programs");
    app.footer("Example: meshfolio doctor");
    return {app, [json] {
                const auto all = findings();
                print(*json ? all.dump(2) + "\n" : for_terminal(doctor_text(all)) + verdict_of(all["missing"]));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
