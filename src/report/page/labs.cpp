#include "report/writers.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

// As in report.html and lab.html.
constexpr std::string_view tag_begin = "<script type=\"application/x-meshfolio-lab\" data-questions=\"", tag_middle = "\">",
                           tag_end = "</script>";

/// The text between `before` and `after`, searched from `at`, which moves behind it; empty if not found.
std::string_view between(std::string_view page, std::string_view before, std::string_view after, std::size_t& at) {
    const std::size_t from = page.find(before, at);
    const std::size_t to = from == page.npos ? from : page.find(after, from + before.size());
    at = to;
    return to == page.npos ? std::string_view() : page.substr(from + before.size(), to - from - before.size());
}

bool is_of(std::string_view text, std::string_view more) {
    return std::ranges::all_of(text, [&](char c) { return is_alphanumeric(c) || more.find(c) != more.npos; });
}

}   // namespace

Lab lab_of(std::string questions, std::string_view bytes) { return {std::move(questions), packed(bytes)}; }

std::vector<Lab> labs_in(std::string_view page) {
    std::vector<Lab> labs;
    for (std::size_t at = 0; at != page.npos;) {
        const std::string_view questions = between(page, tag_begin, tag_middle, at);
        const std::string_view data = between(page, tag_middle, tag_end, at);
        if (!data.empty() && is_of(questions, " ") && is_of(data, "+/=")) labs.push_back({std::string(questions), std::string(data)});
    }
    return labs;
}

std::string write_lab_page(const std::string& title, const Lab& lab, const Templates& templates, std::string_view viewer) {
    nlohmann::json model = view_of({{"title", "name of the mesh (lab.html only)", safe_text(title)}});
    add_design(model, templates, "lab", {false, viewer, {lab}});
    return render(templates, "lab.html", model, xml_escape);
}

}   // namespace meshfolio::report
