/// @file
/// The list of all settings: where each is given, its limits, and what depends on it. All code that reads, names or hashes settings uses
/// this list. The structured bindings name all members, so that the compiler reports a new one.
#pragma once

#include <concepts>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "color/colormap.h"
#include "questions/core/chapter.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

struct Setting {
    const char* table = "";          // of a settings file; empty: the top level
    const char* key = "";            // in that table; empty: not in files
    const char* flag = "";           // of `meshfolio report`
    const char* variable = "";       // of the environment
    const char* name = "";           // in the provenance; empty: not there
    bool shapes_answers = false;     // its value is a part of the key of a cached answer
    long long least = 0, most = 0;   // of integers
    double smallest = 0;             // of other numbers
    double largest = 0;
    bool is_above_zero = false;   // 0 itself is refused
    const char* unsaid = "";      // the value that the provenance leaves out
    std::vector<std::string> (*choices)() = nullptr;
    enum class Text { line, title, number, markdown } text = Text::line;   // of texts without choices; a title is not blank
};

inline std::vector<std::string> pdf_choices() { return {"auto", "require", "off"}; }

/// Returns the names of the renderer's colour maps.
inline std::vector<std::string> colormap_names() {
    std::vector<std::string> names;
    for (const render::Colormap& map : render::colormap_list()) names.emplace_back(map.name);
    return names;
}

/// Returns the ids of all questions.
inline std::vector<std::string> question_ids() {
    std::vector<std::string> ids = section_ids();
    std::erase_if(ids, [](const std::string& id) { return !report::is_question(id); });
    return ids;
}

/// Calls visit(setting, value) for each setting of a report.
template <class Settings, class Visit>
requires std::same_as<std::remove_const_t<Settings>, ReportSettings>
void for_each_setting(Settings& settings, Visit visit) {
    auto& [meshes, data, out, templates, page, pdf, pdf_browser, title, author, course, colormap, source, size, sight, threads, seed,
           view_files, sheets_only, quick, laboratory, fail_fast, timings, time, efforts, only, questions, pages, base] = settings;
    visit(Setting{.table = "[render]",
                  .key = "size",
                  .flag = "--size",
                  .variable = "MESHFOLIO_SIZE",
                  .name = "size",
                  .shapes_answers = true,
                  .least = limits::smallest_size,
                  .most = limits::largest_size},
          size);
    visit(Setting{.table = "[render]", .key = "camera", .flag = "--camera", .name = "camera", .shapes_answers = true}, sight.camera);
    visit(Setting{.table = "[render]", .key = "up", .flag = "--up", .name = "up", .shapes_answers = true, .choices = axis_names}, sight.up);
    visit(Setting{.table = "[render]",
                  .key = "zoom",
                  .flag = "--zoom",
                  .name = "zoom",
                  .shapes_answers = true,
                  .smallest = smallest_zoom,
                  .largest = largest_zoom,
                  .unsaid = "1"},
          sight.zoom);
    visit(Setting{.table = "[render]", .key = "view_files", .flag = "--views-files", .name = "view files", .shapes_answers = true},
          view_files);
    visit(Setting{.flag = "--sheets-only", .name = "sheets only", .shapes_answers = true}, sheets_only);
    visit(Setting{.key = "threads", .flag = "--threads", .variable = "MESHFOLIO_THREADS", .most = limits::largest_threads}, threads);
    visit(Setting{.flag = "--pdf", .variable = "MESHFOLIO_PDF", .choices = pdf_choices}, pdf);
    visit(Setting{.flag = "--pdf-browser"}, pdf_browser);
    visit(Setting{.flag = "--data", .variable = "MESHFOLIO_DATA"}, data);
    visit(Setting{.flag = "--out", .variable = "MESHFOLIO_OUT"}, out);
    visit(Setting{.flag = "--templates"}, templates);
    visit(Setting{.flag = "MESH", .name = "meshes"}, meshes);
    visit(Setting{.flag = "--quick", .name = "quick", .shapes_answers = true}, quick);
    visit(Setting{.flag = "--time", .name = "time", .shapes_answers = true, .largest = 1e7, .is_above_zero = true}, time);
    visit(Setting{.flag = "--fail-fast"}, fail_fast);
    visit(Setting{.flag = "--no-timings"}, timings);
    visit(Setting{.key = "seed", .shapes_answers = true, .most = largest_seed}, seed);
    visit(Setting{.key = "laboratory", .name = "laboratory", .shapes_answers = true}, laboratory);
    visit(Setting{.table = "[report]", .key = "title", .flag = "--title", .text = Setting::Text::title}, title);
    visit(Setting{.table = "[report]", .key = "author", .flag = "--author"}, author);
    visit(Setting{.table = "[report]", .key = "course", .flag = "--course"}, course);
    visit(Setting{.table = "[report]", .key = "source", .flag = "--no-source"}, source);
    visit(Setting{.table = "[report]", .key = "template"}, page);
    visit(Setting{.table = "[report]", .key = "sections", .flag = "--only", .name = "only", .choices = section_ids}, only);
    visit(Setting{.table = "[render]", .key = "colormap", .name = "colormap", .shapes_answers = true, .choices = colormap_names}, colormap);
    // Not single settings.
    static_cast<void>(std::tie(efforts, questions, pages, base));
}

/// Calls visit(setting, value) for each setting of a [[question]].
template <class Table, class Visit>
requires std::same_as<std::remove_const_t<Table>, QuestionTable>
void for_each_setting(Table& table, Visit visit) {
    auto& [title, number, intro, points, meshes, k, iterations, lambda, noise, seed, threads, output] = table;
    visit(Setting{.key = "title", .text = Setting::Text::title}, title);
    visit(Setting{.key = "number", .text = Setting::Text::number}, number);
    visit(Setting{.key = "intro", .text = Setting::Text::markdown}, intro);
    visit(Setting{.key = "points", .largest = limits::largest_points}, points);
    visit(Setting{.key = "mesh", .shapes_answers = true}, meshes);
    visit(Setting{.key = "k", .name = "k", .shapes_answers = true, .least = 1, .most = limits::largest_k}, k);
    visit(Setting{.key = "lambda", .name = "lambda", .shapes_answers = true, .largest = limits::largest_lambda, .is_above_zero = true},
          lambda);
    visit(Setting{.key = "iterations", .name = "iterations", .shapes_answers = true, .least = 1, .most = limits::largest_iterations},
          iterations);
    visit(Setting{.key = "noise", .name = "noise", .shapes_answers = true, .largest = limits::largest_noise}, noise);
    visit(Setting{.key = "seed", .name = "seed", .shapes_answers = true, .most = largest_seed}, seed);
    visit(Setting{.key = "threads", .most = limits::largest_threads}, threads);
    visit(Setting{.key = "output", .name = "output", .shapes_answers = true}, output);
}

/// Calls visit(setting, value) for each setting of a [[page]].
template <class Visit> void for_each_setting(report::OwnPage& page, Visit visit) {
    auto& [title, text, before] = page;
    visit(Setting{.key = "title", .text = Setting::Text::title}, title);
    visit(Setting{.key = "text", .text = Setting::Text::markdown}, text);
    visit(Setting{.key = "before", .choices = question_ids}, before);
}

}   // namespace meshfolio::run
