#include "report/page/view_model.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/number_text.h"
#include "report/brief_number.h"
#include "report/escape.h"
#include "report/page/view_blocks.h"
#include "report/page/view_extent.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

constexpr std::size_t findings_shown = 5;

json names_and_values(const std::map<std::string, std::string>& pairs) {
    json list = json::array();
    for (const auto& [name, value] : pairs) {
        list.push_back(
            {{"name", prose_view(name)}, {"value", prose_view(value)}, {"separator", list.size() + 1 < pairs.size() ? "; " : ""}});
    }
    return list;
}

// ---- checks -------------------------------------------------------------------------------------------------------------

/// Counts stay whole numbers; 2.000 says that four digits agree, 2 that it is exactly two.
std::string measured_text(const Check& check) {
    const bool whole = std::trunc(check.measured) == check.measured && std::abs(check.measured) < 1e9;
    return whole ? readable_integer(check.measured) : readable(check.measured, 4);
}

json check_view(const Check& check) {
    const bool near = check.kind == Check::Kind::near;
    const std::string relation = near || std::isnan(check.expected) ? "" : check.kind == Check::Kind::at_most ? "≤\u202f" : "≥\u202f";
    return {{"name", prose_view(check.name.empty() ? "–" : check.name)},
            {"expected", relation + brief(check.expected, 4)},
            {"measured", measured_text(check)},
            {"tolerance", (near && check.tolerance > 0 ? "±\u202f" : "") + brief(check.tolerance, 2)},
            {"passed", check.passed()},
            {"failed", check.failed()},
            {"undecided", check.status == Check::Status::undecided},
            {"note", prose_view(check.note)},
            {"has_note", !check.note.empty()}};
}

/// Counts of checks, as the opening table and the headings print them.
json score_view(const Score& score) {
    return {{"passed_count", std::to_string(score.passed)},
            {"failed_count", std::to_string(score.failed)},
            {"undecided_count", std::to_string(score.undecided)},
            {"total_count", std::to_string(score.total())},
            {"has_checks", score.total() > 0},
            {"has_failed", score.failed > 0},
            {"has_undecided", score.undecided > 0},
            {"all_passed", score.passed == score.total()}};
}

// ---- sections -----------------------------------------------------------------------------------------------------------

template <class Kind>
std::size_t count_of(const Section& section) {
    const auto is_kind = [](const Block& block) { return std::holds_alternative<Kind>(block); };
    return static_cast<std::size_t>(std::count_if(section.blocks.begin(), section.blocks.end(), is_kind));
}

json input_view(const Input& input) {
    return {{"role", safe_text(input.role)},
            {"asked", safe_text(input.asked)},
            {"has_asked", !input.asked.empty()},
            {"file", safe_text(input.file)},
            {"is_stand_in", input.stand_in},
            {"sha256", safe_text(input.sha256)},
            {"vertices", readable_integer(input.vertices)},
            {"triangles", readable_integer(input.triangles)}};
}

json code_view(const CodeReference& code) {
    return {{"function", safe_text(code.function)},
            {"file", safe_text(code.file)},
            {"purpose", prose_view(code.purpose)},
            {"line", std::to_string(code.line)},
            {"has_line", code.line > 0}};
}

json links_view(const std::vector<std::string>& files) {
    json list = json::array();
    for (const std::string& file : files) list.push_back({{"name", safe_text(file)}, {"href", url_path(file)}});
    return list;
}

template <class Item, class View>
json list_of(const std::vector<Item>& items, View view) {
    json list = json::array();
    for (const Item& item : items) list.push_back(view(item));
    return list;
}

/// What the opening table, the contents list and the section itself have in common.
json section_head(const Section& section, const std::string& number, const ViewOptions& options) {
    json head = score_view(score_of(section.checks));
    head["id"] = safe_text(section.id);
    head["number"] = number;
    head["title"] = safe_text(section.title);
    head["is_ok"] = section.status == Status::ok;
    head["is_failed"] = section.status == Status::failed;
    head["is_skipped"] = section.status == Status::skipped;
    head["extent"] = prose_view(section.extent);
    head["has_extent"] = !section.extent.empty();
    head["failure"] = safe_text(section.failure);
    head["figure_count"] = std::to_string(count_of<Figure>(section) + count_of<Plot>(section) + count_of<Map>(section));
    head["table_count"] = std::to_string(count_of<Table>(section));
    head["checks"] = json::array();
    for (const Check& check : section.checks)
        if (options.passed_checks || !check.passed()) head["checks"].push_back(check_view(check));
    head["has_listed_checks"] = !head["checks"].empty();
    return head;
}

/// The numbered headings within a section, for the contents list.
json headings_view(const json& blocks) {
    json list = json::array();
    for (const json& block : blocks)
        if (block["is_heading"].get<bool>())
            list.push_back({{"number", block["number"]}, {"title", block["title"]}, {"anchor", block["anchor"]}});
    return list;
}

json section_view(const Section& section, const std::string& number, const ViewContext& context) {
    json view = section_head(section, number, context.options);
    view["asked"] = prose_view(section.asked);
    view["has_asked"] = !section.asked.empty();
    view["inputs"] = list_of(section.inputs, input_view);
    view["has_inputs"] = !section.inputs.empty();
    view["parameters"] = names_and_values(section.parameters);
    view["has_parameters"] = !section.parameters.empty();
    view["code"] = list_of(section.code, code_view);
    view["has_code"] = !section.code.empty();
    view["warnings"] = list_of(section.warnings, [](const std::string& w) { return json{{"text", safe_text(w)}}; });
    view["has_warnings"] = !section.warnings.empty();
    view["outputs"] = links_view(section.output_meshes);
    view["has_outputs"] = !section.output_meshes.empty();
    view["own_findings"] = list_of(section.findings, [&](const Finding& f) {
        return json{{"runs", text_view(f.text, context.numbering)}};
    });
    view["has_own_findings"] = !section.findings.empty();
    view["is_brief"] = is_brief(section, context.options.extent);
    int headings = 0;
    view["blocks"] = json::array();
    const std::set<const Block*> told = blocks_told(section, context.options.extent);
    for (const Block& block : section.blocks) {
        if (told.contains(&block)) view["blocks"].push_back(block_view(block, number, headings, context));
    }
    view["headings"] = headings_view(view["blocks"]);
    view["has_headings"] = !view["headings"].empty();
    return view;
}

// ---- the document -------------------------------------------------------------------------------------------------------

json findings_view(const Document& document, const std::vector<std::string>& numbers, const Numbering& numbering) {
    struct Ranked {
        const Finding* finding;
        std::size_t section;
    };
    std::vector<Ranked> ranked;
    for (std::size_t s = 0; s < document.sections.size(); ++s) {
        for (const Finding& finding : document.sections[s].findings) ranked.push_back({&finding, s});
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.finding->weight > b.finding->weight; });
    if (ranked.size() > findings_shown) ranked.resize(findings_shown);
    json list = json::array();
    for (const Ranked& r : ranked) {
        list.push_back({{"runs", text_view(r.finding->text, numbering)},
                        {"href", "#" + url_path(document.sections[r.section].id)},
                        {"label", numbering.resolve(document.sections[r.section].id).label},
                        {"section_number", numbers[r.section]}});
    }
    return list;
}

json provenance_view(const Document& document) {
    const Provenance& p = document.provenance;
    std::set<std::tuple<std::string, std::string, bool>> meshes;
    for (const Section& section : document.sections) {
        for (const Input& input : section.inputs) meshes.emplace(input.file, input.sha256, input.stand_in);
    }
    json inputs = json::array();
    for (const auto& [file, sha256, stand_in] : meshes) {
        inputs.push_back({{"file", safe_text(file)}, {"sha256", safe_text(sha256)}, {"is_stand_in", stand_in}});
    }
    return {{"version", safe_text(p.version)},
            {"commit", safe_text(p.commit)},
            {"has_commit", !p.commit.empty()},
            {"compiler", safe_text(p.compiler)},
            {"build_type", safe_text(p.build_type)},
            {"seed", std::to_string(p.seed)},
            {"libraries", names_and_values(p.libraries)},
            {"has_libraries", !p.libraries.empty()},
            {"settings", names_and_values(p.settings)},
            {"has_settings", !p.settings.empty()},
            {"has_meshes", !inputs.empty()},
            {"meshes", std::move(inputs)}};
}

/// The meshes the questions were answered on, each role once.
json meshes_used(const Document& document) {
    std::set<std::string> told;
    std::size_t stand_ins = 0;
    json list = json::array();
    for (const Section& section : document.sections) {
        if (!is_question(section.id)) continue;
        for (const Input& input : section.inputs) {
            if (!told.insert(input.role).second) continue;
            list.push_back(input_view(input));
            stand_ins += input.stand_in ? 1 : 0;
        }
    }
    return {{"meshes", list},
            {"mesh_count", std::to_string(list.size())},
            {"has_meshes", !list.empty()},
            {"stand_in_count", std::to_string(stand_ins)},
            {"has_stand_ins", stand_ins > 0}};
}

/// How many of the questions asked for are answered: "7 of 7".
json answered_view(const Document& document) {
    std::size_t asked = 0, answered = 0;
    for (const Section& section : document.sections) {
        if (!is_question(section.id) || section.status == Status::skipped) continue;
        ++asked;
        answered += section.status == Status::ok ? 1 : 0;
    }
    return {{"asked_count", std::to_string(asked)},
            {"answered_count", std::to_string(answered)},
            {"has_questions", asked > 0},
            {"all_answered", asked == answered}};
}

json works_view(const std::vector<CitedWork>& works, const Numbering& numbering) {
    json list = json::array();
    for (const CitedWork& work : works) {
        const Reference reference = numbering.resolve(work.id);
        list.push_back({{"number", reference.number},
                        {"anchor", reference.anchor},
                        {"authors", safe_text(work.authors)},
                        {"year", safe_text(work.year)},
                        {"title", safe_text(work.title)},
                        {"where", safe_text(work.where)}});
    }
    return list;
}

json timings_view(const Document& document, const Numbering& numbering) {
    json list = json::array();
    const auto add = [&](const std::string& where, const Timing& timing) {
        list.push_back({{"where", where},
                        {"what", safe_text(timing.what)},
                        {"seconds", readable(timing.seconds, 3)},
                        {"value", exact_text(timing.seconds)}});
    };
    for (const Section& section : document.sections) {
        for (const Timing& timing : section.timings) add(numbering.resolve(section.id).label, timing);
    }
    for (const Timing& timing : document.timings) add("The run", timing);
    return list;
}

}   // namespace

json view_model(const Document& document, const DrawnFigures& figures, const Templates& templates, const ViewOptions& options) {
    const std::vector<CitedWork> works = bibliography_of(templates);
    const auto formulas = formulas_of(templates);
    Numbering numbering(document, works);
    leave_out_untold(document, options.extent, numbering);
    const auto numbers = section_numbers(document);
    const ViewContext context{figures, numbering, formulas, options};

    Score score;
    json attempted = json::array(), sections = json::array();
    for (std::size_t s = 0; s < document.sections.size(); ++s) {
        score += score_of(document.sections[s].checks);
        attempted.push_back(section_head(document.sections[s], numbers[s], options));
        attempted.back()["begins_supporting"] = s > 0 && is_question(document.sections[s - 1].id) && !is_question(document.sections[s].id);
        sections.push_back(section_view(document.sections[s], numbers[s], context));
    }
    json model = {{"title", safe_text(document.title)},
                  {"author", safe_text(document.author)},
                  {"has_author", !document.author.empty()},
                  {"course", safe_text(document.course)},
                  {"has_course", !document.course.empty()},
                  {"provenance", provenance_view(document)},
                  {"score", score_view(score)},
                  {"attempted", std::move(attempted)},
                  {"sections", std::move(sections)},
                  {"findings", findings_view(document, numbers, numbering)},
                  {"works", works_view(works, numbering)},
                  {"timings", options.timings ? timings_view(document, numbering) : json::array()}};
    model["cover"] = document.cover ? picture_view(*document.cover, context) : json(false);
    model["score"]["is_complete"] = options.passed_checks;
    model["score"]["lists_checks"] = options.passed_checks || score.passed < score.total();
    model["used"] = meshes_used(document);
    model["answers"] = answered_view(document);
    model["has_findings"] = !model["findings"].empty();
    model["has_works"] = !model["works"].empty();
    model["has_timings"] = !model["timings"].empty();
    model["has_page_numbers"] = options.page_numbers;
    model["is_brief_report"] = options.extent == Extent::brief;
    return model;
}

}   // namespace meshfolio::report
