// index.html of many meshes: one file that needs nothing else, and no script to be read.
#include <cmath>

#include "base/base64.h"
#include "base/number_text.h"
#include "report/batch/batch.h"
#include "report/brief_number.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

/// A number as text and as sort key; "–" if there is none.
json number_view(const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    const bool whole = number != nullptr && std::trunc(*number) == *number && std::abs(*number) < 1e9;
    const std::string value = number != nullptr ? exact_text(*number) : "";
    return view_of({{"text", "for people",
                     value.empty() ? "–"
                     : whole       ? readable_integer(*number)
                                   : readable(*number)},
                    {"value", "with all digits, to sort by", value},
                    {"has_value", "there is one", !value.empty()}});
}

std::string words_in(const Cell& cell) {
    const auto* words = std::get_if<std::string>(&cell);
    return words != nullptr ? safe_text(*words) : "–";
}

json picture_view(const BatchRow& row) {
    const BatchRow::Picture picture = row.picture.value_or(BatchRow::Picture());
    return view_of({{"is_drawn", "there is one", row.picture.has_value()},
                    {"source", "its bytes", "data:image/jpeg;base64," + base64(picture.jpeg)},
                    {"alt", "what is to be seen", safe_text(picture.alt)},
                    {"width", "pixels", std::to_string(picture.width)},
                    {"height", "pixels", std::to_string(picture.height)}});
}

json worst_view(const BatchRow& row) {
    const WorstCheck worst = row.worst.value_or(WorstCheck());
    const bool has_share = row.worst && std::isfinite(worst.used);
    return view_of({{"is_there", "there is any check", row.worst.has_value()},
                    {"words", "its name and what was measured", safe_text(worst.words)},
                    {"failed", "it failed", worst.failed},
                    {"value", "share of what it allows, to sort by; beyond any limit 1e308", exact_text(has_share ? worst.used : 1e308)},
                    {"share", "of what it allows", has_share ? readable_percent(worst.used, 3) : "∞"}});
}

json defect_view(const std::pair<std::string, double>& defect) {
    return view_of({{"kind", "what is wrong", safe_text(defect.first)}, {"count", "how often", readable_integer(defect.second)}});
}

json row_view(const BatchRow& row) {
    using State = BatchRow::State;
    const std::vector<std::pair<std::string, double>> defects = row.defects.value_or(std::vector<std::pair<std::string, double>>());
    double in_all = 0;
    for (const auto& [kind, count] : defects) in_all += count;
    json view = view_of({{"name", "of the mesh and its folder", safe_text(row.name)},
                         {"file", "as it was named", safe_text(row.file)},
                         {"has_report", "there is one", !row.report.empty()},
                         {"report", "its page", url_path(row.report)},
                         {"picture", "from three quarters", picture_view(row)},
                         {"is_waiting", "it has not been worked on", row.state == State::waiting},
                         {"is_good", "nothing failed", row.state == State::good},
                         {"is_bad", "its report has a failure", row.state == State::bad},
                         {"is_failed", "there is no report", row.state == State::failed},
                         {"error", "why, in one line", safe_text(row.error)},
                         {"vertices", "how many", number_view(row.vertices)},
                         {"triangles", "how many", number_view(row.triangles)},
                         {"components", "how many", number_view(row.components)},
                         {"boundary_loops", "how many", number_view(row.boundary_loops)},
                         {"genus", "of one closed manifold component", number_view(row.genus)},
                         {"manifold", "yes or no", words_in(row.manifold)},
                         {"defects_in_all", "their number", number_view(row.defects ? Cell(in_all) : Cell())},
                         {"lambda_critical", "largest stable step of explicit smoothing", number_view(row.lambda_critical)},
                         {"passed", "checks that did", number_view(row.report.empty() ? Cell() : Cell(double(row.score.passed)))},
                         {"checks_failed", "checks that did", number_view(row.report.empty() ? Cell() : Cell(double(row.score.failed)))},
                         {"undecided_count", "checks that decide nothing", std::to_string(row.score.undecided)},
                         {"has_undecided", "there are any", row.score.undecided > 0},
                         {"worst", "the check with the least room", worst_view(row)},
                         {"seconds", "that the report took", number_view(row.seconds)}});
    enter_list(view, "defects", "by kind", list_of(defects, defect_view));
    return view;
}

}   // namespace

json batch_view(const Batch& batch) {
    using State = BatchRow::State;
    const auto count = [&](State state) { return std::to_string(count_of(batch, state)); };
    Score score;
    for (const BatchRow& row : batch.rows) score += row.score;
    json view = view_of({{"mesh_count", "how many", std::to_string(batch.rows.size())},
                         {"good_count", "meshes without a failure", count(State::good)},
                         {"bad_count", "meshes whose report has one", count(State::bad)},
                         {"failed_count", "meshes without a report", count(State::failed)},
                         {"waiting_count", "meshes not yet worked on", count(State::waiting)},
                         {"has_bad", "there are any", count_of(batch, State::bad) > 0},
                         {"has_failed", "there are any", count_of(batch, State::failed) > 0},
                         {"has_waiting", "there are any", count_of(batch, State::waiting) > 0},
                         {"score", "all checks", safe_text(words_of(score))},
                         {"has_timings", "it is known how long each took", batch.timings}});
    enter_list(view, "rows", "a mesh each", list_of(batch.rows, row_view));
    return view;
}

std::string write_batch_page(const Batch& batch, const std::string& version, const Templates& templates) {
    json model = view_of({{"batch", "meshes with a report each (batch.html only)", batch_view(batch)},
                          {"version", "of the program (batch.html only)", version}});
    add_design(model, templates, "batch");
    return render(templates, "batch.html", model, xml_escape);
}

}   // namespace meshfolio::report
