// index.html of a batch: one file, which can be read without its script.
#include <cmath>

#include "base/base64.h"
#include "base/number_text.h"
#include "report/batch/batch.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

std::optional<double> number_in(const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    return number != nullptr ? std::optional(*number) : std::nullopt;
}

/// Returns a number as text and as sort key; "–" for none.
json number_view(std::optional<double> number) {
    const bool whole = number && std::trunc(*number) == *number && std::abs(*number) < 1e9;
    const std::string value = number ? exact_text(*number) : "";
    return view_of({{"text", "for people",
                     value.empty() ? "–"
                     : whole       ? readable_integer(*number)
                                   : readable(*number)},
                    {"value", "with all digits, to sort by", value},
                    {"has_value", "there is one", !value.empty()}});
}

json picture_view(const BatchRow& row) {
    const BatchRow::Picture picture = row.picture.value_or(BatchRow::Picture());
    return view_of({{"is_drawn", "there is one", row.picture.has_value()},
                    {"source", "its bytes", "data:image/jpeg;base64," + base64(picture.jpeg)},
                    {"alt", "what is to be seen", safe_text(picture.alt)},
                    {"width", "pixels", std::to_string(picture.width)},
                    {"height", "pixels", std::to_string(picture.height)}});
}

json worst_view(const std::optional<WorstCheck>& there) {
    const WorstCheck worst = there.value_or(WorstCheck());
    const bool has_share = there && std::isfinite(worst.used);
    return view_of({{"is_there", "there is any check", there.has_value()},
                    {"words", "its name and what was measured", safe_text(worst.words)},
                    {"failed", "it failed", worst.failed},
                    {"is_usual", "on the other meshes, too, it comes as close to its limit", worst.is_usual},
                    {"value", "share of what it allows, to sort by; beyond any limit 1e308", exact_text(has_share ? worst.used : 1e308)},
                    {"share", "of what it allows", has_share ? readable_percent(worst.used, 3) : "∞"}});
}

/// Returns words about the topology of a mesh and its defects: "closed", "genus 0", "2 components", "needles: 3".
json chips_view(const BatchRow& row) {
    json chips = json::array();
    const auto add = [&](const std::string& text, bool is_bad = false) {
        chips.push_back(
            view_of({{"text", "\"closed\", \"genus 0\", a defect and its number", safe_text(text)}, {"is_bad", "it is a defect", is_bad}}));
    };
    const auto add_count = [&](std::optional<double> number, const std::string& thing, double usual, const char* otherwise) {
        if (!number) return;
        if (*number != usual) add(readable_integer(*number) + "\u00a0" + thing + (*number == 1 ? "" : "s"));
        if (*number == usual && *otherwise != '\0') add(otherwise);
    };
    const auto* manifold = std::get_if<std::string>(&row.manifold);
    if (manifold != nullptr && *manifold == "no") add("not manifold", true);
    add_count(number_in(row.boundary_loops), "boundary loop", 0, "closed");
    add_count(number_in(row.components), "component", 1, "");
    if (const auto genus = number_in(row.genus)) add("genus\u00a0" + readable_integer(*genus));
    for (const auto& [kind, count] : row.defects.value_or(BatchRow::Defects())) add(kind + ": " + readable_integer(count), true);
    return chips;
}

json row_view(const BatchRow& row, const std::map<std::string, double>& usual) {
    using State = BatchRow::State;
    double defects = 0;
    for (const auto& [kind, count] : row.defects.value_or(BatchRow::Defects())) defects += count;
    const auto number_if = [](bool is_there, double number) { return is_there ? std::optional(number) : std::nullopt; };
    json view = view_of(
        {{"name", "of the mesh and its folder", safe_text(row.name)},
         {"file", "as it was named", safe_text(row.file)},
         {"has_report", "there is one", !row.report.empty()},
         {"report", "its page", url_path(row.report)},
         {"picture", "from three quarters", picture_view(row)},
         {"is_waiting", "it has not been worked on", row.state == State::waiting},
         {"is_good", "nothing failed", row.state == State::good},
         {"is_bad", "its report has a failure", row.state == State::bad},
         {"is_failed", "there is no report", row.state == State::failed},
         {"error", "why, in one line", safe_text(row.error)},
         {"vertices", "how many", number_view(number_in(row.vertices))},
         {"triangles", "how many", number_view(number_in(row.triangles))},
         {"defects_in_all", "their number", number_view(number_if(row.defects.has_value(), defects))},
         {"lambda_critical", "largest stable step of explicit smoothing", number_view(number_in(row.lambda_critical))},
         {"passed", "checks that did", number_view(number_if(!row.report.empty(), double(row.score.passed)))},
         {"checks_failed", "checks that did", std::to_string(row.score.failed)},
         {"has_checks_failed", "there are any", row.score.failed > 0},
         {"undecided_count", "checks that decide nothing", std::to_string(row.score.undecided)},
         {"has_undecided", "there are any", row.score.undecided > 0},
         {"worst", "a failed check, else the one farthest beyond its usual share", worst_view(worst_check(row.sections, usual, row.name))},
         {"seconds", "that the report took", number_view(number_in(row.seconds))}});
    enter_list(view, "chips", "its kind and its defects, in words", chips_view(row));
    return view;
}

}   // namespace

json batch_view(const Batch& batch) {
    using State = BatchRow::State;
    const auto number = [](std::size_t count) { return readable_count(static_cast<long long>(count)); };
    const auto count = [&](State state) { return number(count_of(batch, state)); };
    const Score score = score_of(batch);
    const std::map<std::string, double> usual = usual_shares(batch);
    double seconds = 0;
    for (const BatchRow& row : batch.rows) seconds += number_in(row.seconds).value_or(0);
    json view = view_of({{"mesh_count", "how many", number(batch.rows.size())},
                         {"report_count", "meshes with a report", number(count_of(batch, State::good) + count_of(batch, State::bad))},
                         {"good_count", "meshes without a failure", count(State::good)},
                         {"bad_count", "meshes whose report has one", count(State::bad)},
                         {"failed_count", "meshes without a report", count(State::failed)},
                         {"waiting_count", "meshes not yet worked on", count(State::waiting)},
                         {"has_bad", "there are any", count_of(batch, State::bad) > 0},
                         {"has_failed", "there are any", count_of(batch, State::failed) > 0},
                         {"has_waiting", "there are any", count_of(batch, State::waiting) > 0},
                         {"passed_count", "checks of all", number(score.passed)},
                         {"checks_failed_count", "checks of all", number(score.failed)},
                         {"has_checks_failed", "there are any", score.failed > 0},
                         {"seconds", "that all reports took", readable(seconds)},
                         {"has_timings", "it is known how long each took", batch.timings}});
    enter_list(view, "rows", "a mesh each", list_of(batch.rows, [&](const BatchRow& row) { return row_view(row, usual); }));
    return view;
}

std::string write_batch_page(const Batch& batch, const std::string& version, const Templates& templates) {
    json model = view_of({{"batch", "meshes with a report each (batch.html only)", batch_view(batch)},
                          {"version", "of the program (batch.html only)", version}});
    add_design(model, templates, "batch");
    return render(templates, "batch.html", model, xml_escape);
}

}   // namespace meshfolio::report
