#include "report/numbering.h"

#include <algorithm>
#include <stdexcept>

#include "report/escape.h"

namespace meshfolio::report {

namespace {

/// Returns "q4" for "q4" and for "q4_eq_parseval"; empty for ids that do not begin with a question.
std::string_view question_of(std::string_view id) {
    if (id.size() < 2 || id[0] != 'q') return "";
    const std::size_t end = id.find_first_not_of("0123456789", 1);
    if (end == 1 || (end != std::string_view::npos && id[end] != '_')) return "";
    return id.substr(0, end);
}

}   // namespace

bool is_question(std::string_view section_id) { return !section_id.empty() && question_of(section_id) == section_id; }

std::string question_number(const std::string& id, const std::string& own) { return own.empty() ? id.substr(1) : own; }

std::vector<std::string> section_numbers(const Document& document) {
    std::vector<std::string> numbers;
    char letter = 'A';
    for (const Section& section : document.sections)
        numbers.push_back(!is_shown(section)        ? ""
                          : is_question(section.id) ? safe_text(question_number(section.id, section.number))
                                                    : std::string(1, letter++));
    return numbers;
}

std::string own_page_id(std::size_t place) { return "page-" + std::to_string(place + 1); }

void sort_by_number(Document& document) {
    std::ranges::stable_sort(document.sections, {}, [](const Section& section) {
        if (!is_question(section.id)) return std::pair(std::string::npos, std::string());
        const std::string number = question_number(section.id, section.number);
        return std::pair(std::min(number.find_first_not_of("0123456789"), number.size()), number);   // more digits, larger number
    });
}

Numbering::Numbering(const Document& document, const std::vector<CitedWork>& works) {
    const auto numbers = section_numbers(document);
    for (std::size_t s = 0; s < document.sections.size(); ++s) {
        const Section& section = document.sections[s];
        status_[section.id] = section.status;
        if (is_shown(section)) add(section.id, is_question(section.id) ? "Question " : "Section ", numbers[s]);
        else references_[section.id] = {"", "“" + safe_text(section.title) + "” (not in this report)", "", false, "", false};
        int figures = 0, tables = 0, equations = 0;
        const auto next = [&](int& count) { return numbers[s] + "." + std::to_string(++count); };
        for (const Block& block : section.blocks) {
            if (const auto* figure = std::get_if<Figure>(&block)) add(figure->id, "Figure ", next(figures));
            if (const auto* plot = std::get_if<Plot>(&block)) add(plot->id, "Figure ", next(figures));
            if (const auto* map = std::get_if<Map>(&block)) add(map->id, "Figure ", next(figures));
            if (const auto* diagram = std::get_if<Diagram>(&block)) add(diagram->id, "Figure ", next(figures));
            if (const auto* table = std::get_if<Table>(&block); table && !table->file_only) add(table->id, "Table ", next(tables));
            const auto* formula = std::get_if<Formula>(&block);
            if (formula && !formula->id.empty()) add(formula->id, "Equation ", "(" + next(equations) + ")");
        }
    }
    for (std::size_t p = 0; p < document.pages.size(); ++p) add(own_page_id(p), document.pages[p].title, "");
    for (std::size_t i = 0; i < works.size(); ++i) {
        add(works[i].id, "", "[" + std::to_string(i + 1) + "]");
        references_[works[i].id].anchor = "ref-" + works[i].id;
    }
}

void Numbering::add(const std::string& id, const std::string& kind, const std::string& number) {
    if (id.empty()) throw std::logic_error("report: a block that needs an id has none (" + kind + number + ")");
    if (!references_.emplace(id, Reference{number, kind + number, id}).second)
        throw std::logic_error("report: the id " + id + " is used twice");
}

void Numbering::place_elsewhere(const std::string& id, const std::string& page) {
    const auto it = references_.find(id);
    if (it == references_.end() || !it->second.is_shown) return;
    it->second.elsewhere = true;
    it->second.page = page;
}

Reference Numbering::resolve(const std::string& id) const {
    if (const auto it = references_.find(id); it != references_.end()) return it->second;
    const std::string prefix = id.substr(0, id.find('_'));   // the section of a block "<section>_…"; questions even if they are missing
    const std::string owner = status_.contains(prefix) ? prefix : std::string(question_of(id));
    const auto status = status_.find(owner);
    const bool answered = status != status_.end() && status->second == Status::ok;
    if (owner.empty() || answered) throw std::logic_error("report: nothing has the id " + id + " that a text refers to");
    if (status != status_.end()) return references_.at(owner);
    return {owner.substr(1), "Question " + owner.substr(1), ""};
}

}   // namespace meshfolio::report
