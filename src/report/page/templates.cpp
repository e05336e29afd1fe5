#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "embedded_templates.h"
#include "report/json/json_line.h"
#include "report/page/template_render.h"
#include "report/words.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

namespace fs = std::filesystem;

/// Refuses syntax errors: HTML and Markdown are Mustache, words are lists of messages, JSON is JSON; style sheets and scripts may be
/// anything.
void require_syntax(const std::string& name, const std::string& text, const std::string& file) {
    if (name.starts_with("words/")) {
        messages_of(text, file);
    } else if (name.ends_with(".html") || name.ends_with(".md")) {
        if (const auto problem = syntax_problem(text))
            throw UsageError("template syntax: " + problem->what, "close the tag or take it out", {file, problem->line});
    } else if (name.ends_with(".json")) {
        if (const auto deep = deeper_than(template_limits::deepest_json, text)) {
            throw UsageError("is nested more than " + std::to_string(template_limits::deepest_json) + " deep", "make it flatter",
                             {file, line_of_byte(text, *deep)});
        }
        try {
            const auto parsed = nlohmann::json::parse(text);
        } catch (const nlohmann::json::parse_error& error) {
            throw UsageError("is not JSON", "correct it, or take it out of the folder", {file, line_of_byte(text, error.byte)});
        }
    }
}

}   // namespace

Templates::Templates(const fs::path& folder) {
    for (const auto& file : meshfolio_embedded::embedded_templates()) text_[std::string(file.name)] = std::string(file.bytes);
    text_["results.schema.json"] = results_schema();
    if (folder.empty()) return;
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        throw UsageError("is not a folder of templates", "make one with meshfolio templates FOLDER", {folder.string(), 0});
    for (const auto& [name, unused] : text_) {
        if (!may_be_there(folder / name)) continue;
        // A folder of templates may come from somebody else and must not show other files.
        std::error_code unknown;
        const fs::path root = fs::canonical(folder, unknown), target = fs::canonical(folder / name, unknown);
        if (!unknown && std::ranges::mismatch(root, target).in1 != root.end())
            throw UsageError("is a link that leads out of the folder of templates", "put a copy of the file in its place",
                             {(folder / name).string(), 0});
        replace(name, folder / name);
    }
}

void Templates::replace(const std::string& name, const fs::path& file) {
    try {
        set(name, read_file(file, template_limits::largest_file), file.string());
    } catch (const InputError& error) {
        throw UsageError(error.what());
    }
}

void Templates::set(const std::string& name, std::string text, const std::string& file) {
    const auto it = text_.find(name);
    if (it == text_.end()) throw UsageError("there is no template " + name, "meshfolio templates DIR writes all");
    std::erase(text, '\r');
    require_syntax(name, text, file);
    it->second = std::move(text);
}

std::vector<std::string> Templates::names() const {
    std::vector<std::string> names;
    for (const auto& [name, text] : text_) names.push_back(name);
    return names;
}

const std::string& Templates::operator[](const std::string& name) const {
    const auto it = text_.find(name);
    if (it == text_.end()) throw UsageError("there is no template " + name, "meshfolio templates DIR writes all");
    return it->second;
}

}   // namespace meshfolio::report
