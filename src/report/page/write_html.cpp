// index.html, appendix.html and the page of a laboratory: each is one file without others, for HTML and XML parsers alike.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/lower_case.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_model.h"
#include "report/page/view_value.h"
#include "report/page/volumes.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

// The tags of laboratories in report.html and lab.html.
constexpr std::string_view tag_begin = "<script type=\"application/x-meshfolio-lab\" data-questions=\"", tag_middle = "\">",
                           tag_end = "</script>";

/// Returns the text between `before` and `after`, searched from `at` on, and moves `at` to its end; empty if there is none.
std::string_view between(std::string_view page, std::string_view before, std::string_view after, std::size_t& at) {
    const std::size_t from = page.find(before, at);
    const std::size_t to = from == page.npos ? from : page.find(after, from + before.size());
    at = to;
    return to == page.npos ? std::string_view() : page.substr(from + before.size(), to - from - before.size());
}

}   // namespace

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    const bool can_turn = options.design == "report" && !options.viewer.empty();
    ViewOptions view{.volume = options.volume,
                     .other_page = page_file(other_of(options.volume)),
                     .timings = options.timings,
                     .paper = options.paper,
                     .plot_files = options.plot_files,
                     .models = can_turn};
    const std::vector<Lab> labs = can_turn && options.volume == Volume::report ? options.labs : std::vector<Lab>();
    for (const Lab& lab : labs) view.lab_questions += lab.questions + " ";
    nlohmann::json model = view_model(document, figures, templates, view);
    const bool has_models = std::ranges::any_of(figures_in(document, options.volume), [&](const std::string& id) {
        const auto figure = figures.find(id);
        return figure != figures.end() && !figure->second.models.empty();
    });
    add_design(model, templates, options.design, {has_models, options.viewer, labs});
    return render(templates, options.design + ".html", model, xml_escape);
}

Lab lab_of(std::string questions, std::string_view bytes) { return {std::move(questions), packed(bytes)}; }

std::vector<Lab> labs_in(std::string_view page) {
    const auto consists_of = [](std::string_view text, std::string_view others) {
        return std::ranges::all_of(text, [&](char c) { return is_alphanumeric(c) || others.find(c) != others.npos; });
    };
    std::vector<Lab> labs;
    for (std::size_t at = 0; at != page.npos;) {
        const std::string_view questions = between(page, tag_begin, tag_middle, at);
        const std::string_view data = between(page, tag_middle, tag_end, at);
        if (!data.empty() && consists_of(questions, " ") && consists_of(data, "+/="))
            labs.push_back({std::string(questions), std::string(data)});
    }
    return labs;
}

std::string write_lab_page(const std::string& title, const Lab& lab, const Templates& templates, std::string_view viewer) {
    nlohmann::json model = view_of({{"title", "name of the mesh (lab.html only)", safe_text(title)}});
    add_design(model, templates, "lab", {false, viewer, {lab}});
    return render(templates, "lab.html", model, xml_escape);
}

}   // namespace meshfolio::report
