#include "run/mark/mark_pages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/joined.h"
#include "base/number_text.h"
#include "output/draw/surface_of.h"
#include "png/png.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_value.h"
#include "report/words.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::run {

using namespace report::literals;

namespace {

using nlohmann::json;

constexpr report::Words words("mark");
constexpr int view_side = 300;   // pixels

/// Returns the sentence of a convention: most keys have their own; operators share one, and so do areas.
std::string sentence_of(const std::string& key) {
    const auto after = [&](std::string_view start) { return key.substr(start.size()); };
    if (key.starts_with("operator_")) {
        const OperatorEntry& entry = operator_entry(operator_named(after("operator_")));
        std::string description(entry.description);   // a sentence, which continues here
        description.erase(description.find_last_not_of('.') + 1);
        return words.line("convention.operator", "operator"_a = entry.title, "description"_a = description);
    }
    if (key.starts_with("area_")) return words.line("convention.area", "area"_a = after("area_"));
    return words.line("convention." + key);
}

std::string in_words(const std::vector<ConventionKeys>& conventions) {
    std::vector<std::string> each;
    for (const ConventionKeys& keys : conventions) {
        std::vector<std::string> sentences;
        std::ranges::transform(keys, std::back_inserter(sentences), sentence_of);
        each.push_back(joined(sentences, "; " + words.line("and") + " "));
    }
    return joined(each, "; " + words.line("or") + " ");
}

const char* verdict_word(Verdict verdict) {
    constexpr const char* in_order[] = {"right", "accepted", "recognised", "wrong", "missing", "unusable"};
    return in_order[static_cast<std::size_t>(verdict)];
}

bool has_all_points(const ItemMark& mark) { return mark.verdict == Verdict::right || mark.verdict == Verdict::accepted; }

std::string points_text(double points) { return plain_text(points, 6); }

/// Draws the difference on the mesh from six sides, as a JPEG; returns "" if there is no difference to draw.
std::string picture_of(const ItemMark& mark) {
    if (mark.difference.size() == 0 || !mark.difference.array().isFinite().any()) return "";
    const std::shared_ptr<const TriangleMesh> mesh(mark.reference->mesh->prepared, &mark.reference->mesh->mesh());
    const bool is_distance = is_of_mesh(mark.item->what);
    const output::ColorRange range =
        output::robust_range({{"", "", mesh, mark.difference}}, is_distance ? "pale" : "diverging",
                             words.line(is_distance ? "picture.distance" : "picture.difference"), "", mark.reference->right.scale * 1e-12);
    render::DrawOptions draw;
    draw.width = draw.height = view_side;
    draw.range = output::value_range(range);
    render::ContactSheet sheet;
    sheet.title = mark.item->title;
    for (const render::View& view : render::six_views) sheet.view_names.emplace_back(view.name);
    sheet.pictures = output::drawn_views(output::surface_of(*mesh, &mark.difference), render::six_views, draw);
    sheet.color_bar = output::color_bar_of(range, !mark.difference.array().isFinite().all(), draw);
    constexpr int quality = 85;
    return render::encode_jpeg(render::compose(sheet), quality);
}

/// Returns words about a wrong answer: the number beside the right one, or the place where the answer is worst.
std::string wrong_text(const ItemMark& mark) {
    const MarkedThing what = mark.item->what;
    const Eigen::Index worst = mark.agreement.where;
    if (what == MarkedThing::number) {
        const auto text = [](double x) { return (x < 0 ? "−" : "") + plain_text(std::abs(x)); };
        const double percent = 100 * std::abs(mark.given - mark.expected) / std::abs(mark.expected);
        return "You wrote " + text(mark.given) + "; right is " + text(mark.expected) +
               (std::isfinite(percent) ? " (" + plain_text(rounded(percent, 2)) + "\u202f% off)." : ".");
    }
    const std::string place = is_of_mesh(what)
                                  ? words.line("place.coordinate", "vertex"_a = worst / 3, "axis"_a = std::string(1, "xyz"[worst % 3]))
                              : what == MarkedThing::eigenvalues ? words.line("place.eigenvalue", "index"_a = worst + 1)
                                                                 : words.line("place.vertex", "vertex"_a = worst);
    return words.line("said.wrong", "share"_a = readable_percent(mark.agreement.share), "tolerance"_a = plain_text(mark.item->tolerance, 3),
                      "place"_a = place, "given"_a = readable(mark.given, 6), "expected"_a = readable(mark.expected, 6));
}

/// Returns the fields that a cell of the class page and the head of an item share.
json mark_view(const ItemMark& mark) {
    return {{"score", points_text(mark.score)},
            {"verdict", words.line("verdict." + std::string(verdict_word(mark.verdict)))},
            {"is_right", has_all_points(mark)},
            {"is_partial", mark.verdict == Verdict::recognised},
            {"is_lost", !has_all_points(mark) && mark.verdict != Verdict::recognised}};
}

json item_view(const ItemMark& mark) {
    const std::string picture = picture_of(mark);
    json view = mark_view(mark);
    view.update({{"id", mark.item->id},
                 {"title", report::safe_text(mark.item->title)},
                 {"points", points_text(mark.item->points)},
                 {"file", report::safe_text(mark.file)},
                 {"has_file", !mark.file.empty()},
                 {"settings", described(*mark.item, mark.settings)},
                 {"said", report::safe_text(explanation_of(mark))},
                 {"has_picture", !picture.empty()},
                 {"picture", base64(picture)}});
    return view;
}

json class_row(const StudentMarks& marks) {
    return {{"student", marks.id},
            {"score", points_text(marks.score())},
            {"is_refused", !marks.refused.empty()},
            {"refused", report::safe_text(marks.refused)},
            {"cells", report::list_of(marks.items, mark_view)}};
}

/// Returns how many students had an item right, and the convention that explains most other answers.
json class_item(const std::vector<StudentMarks>& students, const RubricItem& item, std::size_t index) {
    double sum = 0;
    std::ptrdiff_t right = 0;
    std::map<ConventionKeys, int> counts;
    for (const StudentMarks& marks : students) {
        if (!marks.refused.empty()) continue;
        const ItemMark& mark = marks.items[index];
        sum += mark.score;
        right += has_all_points(mark) ? 1 : 0;
        if (mark.verdict == Verdict::recognised)
            for (const ConventionKeys& keys : mark.conventions) ++counts[keys];
    }
    const auto most = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
    return {{"id", item.id},
            {"title", report::safe_text(item.title)},
            {"points", points_text(item.points)},
            {"average", readable(sum / static_cast<double>(std::max<std::size_t>(1, students.size())))},
            {"right", std::to_string(right)},
            {"has_misconception", most != counts.end()},
            {"misconception", most != counts.end() ? report::safe_text(in_words({most->first})) : ""},
            {"times", most != counts.end() ? std::to_string(most->second) : ""}};
}

std::string page_of(json model, const Rubric& rubric, const report::Templates& templates, const std::string& design) {
    model.update({{"title", report::safe_text(rubric.title)}, {"points", points_text(rubric.points())}});
    report::add_design(model, templates, design);
    return report::render(templates, design + ".html", model, report::xml_escape);
}

}   // namespace

std::string explanation_of(const ItemMark& mark) {
    const std::string worst = readable(mark.agreement.worst, 2), tolerance = plain_text(mark.item->tolerance, 3);
    std::string text;
    switch (mark.verdict) {
        case Verdict::unusable: return words.line("said.unusable", "problem"_a = mark.problem);
        case Verdict::right:
            return mark.agreement.worst > 0 ? words.line("said.right", "worst"_a = worst, "tolerance"_a = tolerance)
                                            : words.line("said.exact");
        case Verdict::accepted: text = words.line("said.accepted", "conventions"_a = in_words(mark.conventions)); break;
        case Verdict::recognised:
            text = words.line("said.recognised", "conventions"_a = in_words(mark.conventions),
                              "share"_a = readable_percent(mark.item->recognised, 2));
            break;
        case Verdict::wrong: text = wrong_text(mark); break;
        case Verdict::missing:
            text = mark.item->what == MarkedThing::number ? words.line("said.no_number", "file"_a = answers_file, "id"_a = mark.item->id)
                                                          : words.line("said.missing", "pattern"_a = mark.item->file);
            break;
    }
    return mark.reference->not_unique ? text + " " + words.line("said.not_unique") : text;
}

std::string student_page(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates) {
    const auto remark_view = [](const std::string& remark) -> json { return {{"text", report::safe_text(remark)}}; };
    const auto right = std::ranges::count_if(marks.items, has_all_points);
    const json model{{"student", marks.id},
                     {"source", report::safe_text(marks.source)},
                     {"score", points_text(marks.score())},
                     {"refused", report::safe_text(marks.refused)},
                     {"is_refused", !marks.refused.empty()},
                     {"right_count", std::to_string(right)},
                     {"item_count", std::to_string(rubric.items.size())},
                     {"wrong_count", std::to_string(std::ssize(rubric.items) - right)},
                     {"has_wrong", marks.refused.empty() && right < std::ssize(rubric.items)},
                     {"has_right", right > 0},
                     {"has_remarks", !marks.remarks.empty()},
                     {"remarks", report::list_of(marks.remarks, remark_view)},
                     {"items", report::list_of(marks.items, item_view)}};
    return page_of(model, rubric, templates, "mark");
}

std::string student_json(const StudentMarks& marks, const Rubric& rubric) {
    nlohmann::ordered_json tests = nlohmann::ordered_json::array();
    for (const ItemMark& mark : marks.items) {
        tests.push_back({{"number", mark.item->id},
                         {"name", report::safe_text(mark.item->title)},
                         {"score", mark.score},
                         {"max_score", mark.item->points},
                         {"status", has_all_points(mark) ? "passed" : "failed"},
                         {"output", report::safe_text(explanation_of(mark))},
                         {"output_format", "text"},
                         {"extra_data", {{"verdict", verdict_word(mark.verdict)}, {"conventions", mark.conventions}}}});
    }
    std::vector<std::string> remarks;
    std::ranges::transform(marks.remarks, std::back_inserter(remarks), report::safe_text);
    const std::string output = marks.refused.empty() ? joined(remarks, "\n") : report::safe_text(marks.refused);
    const nlohmann::ordered_json results{{"score", marks.score()},
                                         {"output", output},
                                         {"output_format", "text"},
                                         {"tests", tests},
                                         {"extra_data", {{"student", marks.id}, {"max_score", rubric.points()}}}};
    return results.dump(2) + "\n";
}

std::string class_csv(const std::vector<StudentMarks>& students, const Rubric& rubric) {
    report::Table table;
    for (const char* name : {"student", "submission", "score", "max_score"}) table.columns.push_back({name});
    for (const RubricItem& item : rubric.items) {
        table.columns.push_back({item.id});
        table.columns.push_back({item.id + "_verdict"});
    }
    table.columns.push_back({"remarks"});
    for (const StudentMarks& marks : students) {
        std::vector<report::Cell> row{marks.id, marks.source, marks.score(), rubric.points()};
        for (std::size_t i = 0; i < rubric.items.size(); ++i) {
            const ItemMark* mark = i < marks.items.size() ? &marks.items[i] : nullptr;
            std::vector<std::string> each;
            if (mark != nullptr)
                for (const ConventionKeys& keys : mark->conventions) each.push_back(joined(keys, " + "));
            row.emplace_back(mark != nullptr ? mark->score : 0.0);
            row.emplace_back(mark == nullptr ? std::string("refused")
                                             : verdict_word(mark->verdict) + (each.empty() ? "" : ": " + joined(each, " | ")));
        }
        row.emplace_back(marks.refused.empty() ? joined(marks.remarks, "; ") : marks.refused);
        table.rows.push_back(std::move(row));
    }
    return report::write_csv(table);
}

std::string class_page(const std::vector<StudentMarks>& students, const Rubric& rubric, const report::Templates& templates) {
    double sum = 0;
    for (const StudentMarks& marks : students) sum += marks.score();
    const auto refused = std::ranges::count_if(students, [](const StudentMarks& marks) { return !marks.refused.empty(); });
    json items = json::array();
    for (std::size_t i = 0; i < rubric.items.size(); ++i) items.push_back(class_item(students, rubric.items[i], i));
    const json model{{"student_count", std::to_string(students.size())},
                     {"is_one", students.size() == 1},
                     {"average", readable(sum / static_cast<double>(std::max<std::size_t>(1, students.size())))},
                     {"refused_count", std::to_string(refused)},
                     {"has_refused", refused > 0},
                     {"column_count", std::to_string(rubric.items.size())},
                     {"items", items},
                     {"students", report::list_of(students, class_row)}};
    return page_of(model, rubric, templates, "class");
}

}   // namespace meshfolio::run
