#include "report/page/view_model.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/number_text.h"
#include "report/escape.h"
#include "report/page/view_blocks.h"
#include "report/page/view_value.h"
#include "report/page/volumes.h"
#include "report/words.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

json names_and_values(const std::map<std::string, std::string>& pairs, const char* name_meaning, const char* value_meaning) {
    json list = list_of(pairs, [&](const auto& pair) {
        return view_of({{"name", name_meaning, prose_view(pair.first)}, {"value", value_meaning, prose_view(pair.second)}});
    });
    enter_separators(list);
    return list;
}

// ---- checks -------------------------------------------------------------------------------------------------------------

json check_view(const Check& check) {
    // Counts stay whole numbers: 2.000 means that four digits agree, 2 that the number is exactly two.
    const bool whole = std::trunc(check.measured) == check.measured && std::abs(check.measured) < 1e9;
    const std::string measured = whole ? readable_integer(check.measured) : readable(check.measured, 4);
    const bool near = check.kind == Check::Kind::near;
    const std::string relation = near || std::isnan(check.expected) ? "" : check.kind == Check::Kind::at_most ? "≤\u202f" : "≥\u202f";
    return view_of({{"name", "what is checked", prose_view(check.name.empty() ? "–" : check.name)},
                    {"expected", "the value it should have, with its relation", relation + brief_text(check.expected, 4)},
                    {"measured", "the value it has", measured},
                    {"tolerance", "how far off it may be", (near && check.tolerance > 0 ? "±\u202f" : "") + brief_text(check.tolerance, 2)},
                    {"passed", "it passed", check.passed()},
                    {"failed", "it failed", check.failed()},
                    {"undecided", "it decides nothing here, for the reason in the note", check.status == Check::Status::undecided},
                    {"note", "what is compared, why it is known to fail, or why nothing is decided", prose_view(check.note)},
                    {"has_note", "there is a note", !check.note.empty()}});
}

/// Returns counts of checks for the opening table and the headings.
json score_view(const Score& score) {
    return view_of({{"passed_count", "checks that passed", std::to_string(score.passed)},
                    {"failed_count", "checks that failed", std::to_string(score.failed)},
                    {"undecided_count", "checks that decide nothing here, which is no failure", std::to_string(score.undecided)},
                    {"total_count", "checks", std::to_string(score.total())},
                    {"has_checks", "there are any", score.total() > 0},
                    {"has_failed", "some check failed", score.failed > 0},
                    {"has_undecided", "some check is undecided", score.undecided > 0},
                    {"all_passed", "all of them passed, none is undecided", score.passed == score.total()}});
}

// ---- sections -----------------------------------------------------------------------------------------------------------

json mesh_view(const std::string& file, const std::string& sha256, bool is_stand_in) {
    return view_of({{"file", "name of the file", safe_text(file)},
                    {"sha256", "of the file", safe_text(sha256)},
                    {"is_stand_in", "a bundled mesh in place of the one asked for", is_stand_in}});
}

json input_view(const Input& input) {
    json view = mesh_view(input.file, input.sha256, input.stand_in);
    enter(view, {{"name", "of the mesh: that of the file without its ending", safe_text(std::filesystem::path(input.file).stem().string())},
                 {"asked", "path in the assignment", safe_text(input.asked)},
                 {"has_asked", "the assignment names it", !input.asked.empty()},
                 {"vertices", "how many", readable_integer(input.vertices)},
                 {"triangles", "how many", readable_integer(input.triangles)}});
    return view;
}

json code_view(const CodeReference& code) {
    return view_of({{"function", "name", safe_text(code.function)},
                    {"file", "source file", safe_text(code.file)},
                    {"purpose", "what it computes", prose_view(code.purpose)},
                    {"line", "of its definition in src.txt", std::to_string(code.line)},
                    {"has_line", "src.txt has the function", code.line > 0}});
}

std::string points_of(const Section& section) { return plain_text(section.points) + (section.points == 1 ? " point" : " points"); }

/// Returns the values that the opening table, the contents list and the section itself have in common.
json section_head(const Section& section, const std::string& number, const ViewContext& context) {
    json checks = json::array();
    for (const Check& check : section.checks) {
        const bool is_listed = context.options.passed_checks || !check.passed();
        if (is_listed && checks.size() < context.options.most_checks) checks.push_back(check_view(check));
    }
    const Reference target = context.numbering.resolve(section.id);
    json head = score_view(score_of(section.checks));
    enter(head, {{"id", "anchor of the section: \"q4\"", safe_text(section.id)},
                 {"href", "link to the section, in this page or that of the other volume", target.page + "#" + url_path(target.anchor)},
                 {"number", "\"4\"; letters for what the answers rest on", number},
                 {"title", "its title", safe_text(section.title)},
                 {"points", "\"8 points\"", points_of(section)},
                 {"has_points", "the question gives some", section.points > 0},
                 {"is_question", "it answers a question of the assignment", is_question(section.id)},
                 {"is_ok", "it was answered", section.status == Status::ok},
                 {"is_failed", "it failed", section.status == Status::failed},
                 {"is_skipped", "it was left out or stopped; `extent` says why", section.status == Status::skipped},
                 {"answer", "in one sentence", text_view(section.answer, context.numbering)},
                 {"has_answer", "there is one", !section.answer.empty()},
                 {"extent", "how far it was achieved", prose_view(section.extent)},
                 {"failure", "why it failed, one line", safe_text(section.failure)},
                 {"has_listed_checks", "its list of checks is not empty", !checks.empty()},
                 {"checks", "what was checked", std::move(checks)}});
    enter_list(head, "code", "functions that answer it", list_of(section.code, code_view));
    return head;
}

bool has_lab(const Section& section, const ViewContext& context) {
    return context.options.lab_questions.find(section.id + " ") != std::string::npos;
}

json own_blocks_view(const std::string& text, const ViewContext& context) {
    int headings = 0;   // none: own_blocks() makes no heading
    return list_of(own_blocks(text), [&](const Block& block) { return block_view(block, "", headings, context); });
}

json section_view(const Section& section, const std::string& number, const ViewContext& context) {
    const auto warning = [](const std::string& words) { return view_of({{"text", "one line", safe_text(words)}}); };
    const auto output = [](const std::string& file) {
        return view_of({{"name", "its path in the report", safe_text(file)}, {"href", "link to the file", url_path(file)}});
    };
    const bool is_further = context.options.volume == Volume::appendix && is_question(section.id);
    const std::span<const Block> shown = blocks_in(section, context.options.volume);
    const auto is_heading = [](const Block& block) { return std::holds_alternative<Heading>(block); };
    int heading = static_cast<int>(std::count_if(section.blocks.data(), shown.data(), is_heading));   // headings of the report come first
    json blocks = json::array(), headings = json::array();
    for (const Block& block : shown) {
        if (const auto* table = std::get_if<Table>(&block); table && table->file_only) continue;
        const json& view = blocks.emplace_back(block_view(block, number, heading, context));
        if (is_heading(block))
            headings.push_back(view_of({{"number", "\"4.2\"", view["number"]},
                                        {"title", "its words", view["title"]},
                                        {"anchor", "of the heading", view["anchor"]}}));
    }
    json view = section_head(section, number, context);
    if (is_further) view["id"] = further_id(section);
    json intro = own_blocks_view(section.intro, context);
    enter(view, {{"asked", "the question in one sentence", prose_view(section.asked)},
                 {"has_asked", "there is one", !section.asked.empty() && intro.empty()},
                 {"is_further", "what a question leaves to the appendix", is_further},
                 {"has_lab", "the page has a mesh of the laboratory for it", has_lab(section, context)}});
    enter_list(view, "intro", "the teacher's introduction in place of the sentence, as `blocks`", std::move(intro));
    enter_list(view, "inputs", "meshes it read", list_of(section.inputs, input_view));
    enter_list(view, "parameters", "its settings", names_and_values(texts_of(section.parameters), "of the setting", "what it is"));
    enter_list(view, "warnings", "what was unusual", list_of(section.warnings, warning));
    enter_list(view, "outputs", "meshes it wrote", list_of(section.output_meshes, output));
    enter_list(view, "headings", "numbered headings within the section", std::move(headings));
    enter(view, {{"blocks", "what is read, in order; one of the is_… is true for each", std::move(blocks)}});
    return view;
}

/// Returns the page as a section without number, answer and checks.
json own_page_view(const OwnPage& page, const std::string& id, const ViewContext& context) {
    Section section;
    section.id = id;
    section.title = page.title;
    json view = section_view(section, "", context);
    view["blocks"] = own_blocks_view(page.text, context);
    view["is_ok"] = false;   // nothing was computed
    return view;
}

// ---- the document -------------------------------------------------------------------------------------------------------

/// Returns the first panels of the first drawn figure of the first question with a laboratory; false if there is none.
json series_view(const Document& document, const ViewContext& context) {
    for (const Section& section : document.sections) {
        if (!has_lab(section, context)) continue;
        for (const Block& block : blocks_in(section, Volume::report)) {
            const auto* figure = std::get_if<Figure>(&block);
            const auto drawn = figure ? context.figures.find(figure->id) : context.figures.end();
            if (drawn != context.figures.end() && !drawn->second.panels.empty()) return strip_view(*figure, drawn->second, context);
        }
    }
    return false;
}

json provenance_view(const Document& document) {
    const Provenance& p = document.provenance;
    std::set<std::tuple<std::string, std::string, bool>> meshes;
    for (const Section& section : document.sections)
        for (const Input& input : section.inputs) meshes.emplace(input.file, input.sha256, input.stand_in);
    json view = view_of({{"version", "of meshfolio", safe_text(p.version)},
                         {"commit", "it was built from", safe_text(p.commit)},
                         {"has_commit", "that is known", !p.commit.empty()},
                         {"compiler", "that built it", safe_text(p.compiler)},
                         {"build_type", "how", safe_text(p.build_type)},
                         {"seed", "of all random numbers", std::to_string(p.seed)}});
    enter_list(view, "libraries", "in use", names_and_values(p.libraries, "of the library", "its version"));
    enter_list(view, "settings", "as given", names_and_values(p.settings, "of the setting", "what it is"));
    enter_list(view, "meshes", "every input", list_of(meshes, [](const auto& mesh) { return std::apply(mesh_view, mesh); }));
    return view;
}

/// Returns the input meshes of the questions, each once.
json meshes_used(const Document& document) {
    std::set<std::pair<std::string, std::string>> shown;   // file and content
    std::size_t stand_ins = 0;
    json list = json::array();
    for (const Section& section : document.sections) {
        if (!is_question(section.id)) continue;
        for (const Input& input : section.inputs) {
            if (!shown.emplace(input.file, input.sha256).second) continue;
            list.push_back(input_view(input));
            stand_ins += input.stand_in ? 1 : 0;
        }
    }
    json view = view_of({{"mesh_count", "how many", std::to_string(list.size())},
                         {"noun", "\"mesh\" or \"meshes\"", list.size() == 1 ? "mesh" : "meshes"},
                         {"stand_in_count", "how many of them stand in", std::to_string(stand_ins)},
                         {"has_stand_ins", "some are bundled meshes in place of those asked for", stand_ins > 0}});
    enter_list(view, "meshes", "each once, in the order in which questions ask for them", std::move(list));
    return view;
}

/// Returns counts of the questions that were asked for and answered.
json answered_view(const Document& document) {
    std::size_t asked = 0, answered = 0;
    for (const Section& section : document.sections) {
        if (!is_question(section.id) || section.status == Status::skipped) continue;
        ++asked;
        answered += section.status == Status::ok ? 1 : 0;
    }
    return view_of({{"asked_count", "questions that were asked for", std::to_string(asked)},
                    {"answered_count", "questions that were answered", std::to_string(answered)},
                    {"has_questions", "any question was asked for", asked > 0},
                    {"all_answered", "all that were asked", asked == answered}});
}

json work_view(const CitedWork& work, const Numbering& numbering) {
    const Reference reference = numbering.resolve(work.id);
    return view_of({{"number", "\"[3]\"", reference.number},
                    {"anchor", "of its entry", reference.anchor},
                    {"authors", "who", safe_text(work.authors)},
                    {"year", "when", safe_text(work.year)},
                    {"title", "what", safe_text(work.title)},
                    {"where", "journal or book", safe_text(work.where)}});
}

json timings_view(const Document& document, const Numbering& numbering) {
    json list = json::array();
    const auto add = [&](const std::string& where, const Timing& timing) {
        list.push_back(view_of({{"where", "section, or the run", where},
                                {"what", "which step", safe_text(timing.what)},
                                {"seconds", "how long", readable(timing.seconds, 3)},
                                {"value", "seconds with all digits, for sorting", exact_text(timing.seconds)}}));
    };
    for (const Section& section : document.sections)
        for (const Timing& timing : section.timings) add(numbering.resolve(section.id).label, timing);
    for (const Timing& timing : document.timings) add("The run", timing);
    return list;
}

}   // namespace

json view_model(const Document& document, const DrawnFigures& figures, const Templates& templates, const ViewOptions& options) {
    std::vector<CitedWork> works = bibliography_of(templates);
    // The works that the report cites have the first numbers.
    const auto in_report = works_cited_in(document, Volume::report, works), cited = works_cited_in(document, options.volume, works);
    std::stable_partition(works.begin(), works.end(), [&](const CitedWork& work) { return in_report.contains(work.id); });
    const auto formulas = formulas_of(templates);
    Numbering numbering(document, works);
    mark_elsewhere(document, options.volume, options.other_page, numbering);
    std::erase_if(works, [&](const CitedWork& work) { return !cited.contains(work.id); });
    const auto numbers = section_numbers(document);
    const ViewContext context{figures, numbering, formulas, options};

    Score total;
    json attempted = json::array(), sections = json::array();
    const auto add_pages = [&](const std::string& before) {
        for (std::size_t p = 0; p < document.pages.size() && options.volume == Volume::report; ++p)
            if (document.pages[p].before == before) sections.push_back(own_page_view(document.pages[p], own_page_id(p), context));
    };
    for (std::size_t s = 0; s < document.sections.size(); ++s) {
        const Section& section = document.sections[s];
        if (!is_shown(section)) continue;
        add_pages(section.id);
        total += score_of(section.checks);
        attempted.push_back(section_head(section, numbers[s], context));
        if (has_section(section, options.volume)) sections.push_back(section_view(section, numbers[s], context));
    }
    add_pages("");
    const bool has_supporting =
        std::ranges::any_of(document.sections, [](const Section& section) { return is_shown(section) && !is_question(section.id); });
    json score = score_view(total);
    enter(score, {{"is_complete", "the lists of checks hold those that passed, too", options.passed_checks},
                  {"lists_checks", "some check is listed", options.passed_checks || total.passed < total.total()}});
    const Figure* cover = options.volume == Volume::report ? cover_figure(document, context.figures) : nullptr;
    json model =
        view_of({{"title", "title of the report", safe_text(document.title)},
                 {"author", "who made it", safe_text(document.author)},
                 {"has_author", "there is an author", !document.author.empty()},
                 {"course", "which course it is for", safe_text(document.course)},
                 {"has_course", "there is a course", !document.course.empty()},
                 {"is_report", "this is the volume of the questions", options.volume == Volume::report},
                 {"is_appendix", "this is the volume of what they rest on", options.volume == Volume::appendix},
                 {"other_page", "file of the other volume", url_path(options.other_page)},
                 {"has_paper", "it is printed as well", options.paper},
                 {"paper", "the file that is printed", pdf_file(options.volume)},
                 {"has_supporting", "there are sections that are no questions", has_supporting},
                 {"has_source", "the report has src.txt, and citations have lines", cites_source(document)},
                 {"series", "a figure of the first question with a laboratory; false: none", series_view(document, context)},
                 {"cover", "picture of the first page; false: none", cover == nullptr ? json(false) : cover_view(*cover, context)},
                 {"provenance", "what made this report", provenance_view(document)},
                 {"score", "checks of the whole report", std::move(score)},
                 {"used", "the meshes, for the first page", meshes_used(document)},
                 {"answers", "how many questions of the assignment were answered", answered_view(document)},
                 {"attempted", "one a section of both volumes, with what `sections` has of heads", std::move(attempted)},
                 {"sections", "of this volume, in order", std::move(sections)},
                 {"has_mathml", "the reader of the page knows MathML", !options.plain_formulas},
                 {"has_page_numbers", "the page is printed with their numbers in the contents (print.html only)", options.page_numbers}});
    enter_list(model, "works", "works that this volume cites",
               list_of(works, [&](const CitedWork& work) { return work_view(work, numbering); }));
    const bool with_timings = options.timings && options.volume == Volume::appendix;
    enter_list(model, "timings", "seconds of each step; empty without timings, and in the report",
               with_timings ? timings_view(document, numbering) : json::array());
    return model;
}

}   // namespace meshfolio::report
