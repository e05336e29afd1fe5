/// @file
/// Numbers all parts of a document: "Figure 1.3", "Table 4.1", "Equation (2.2)", "Claim A.3", "Question 5", "[4]".
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/bibliography.h"
#include "report/document.h"

namespace meshfolio::report {

struct Reference {
    std::string number;       // "1.3"
    std::string label;        // "Figure 1.3"
    std::string anchor;       // of the element in the page; empty: there is none
    bool elsewhere = false;   // in the other volume,
    std::string page = {};    // in this file; empty: without a link
    bool is_shown = true;     // false: its section is in neither volume
};

class Numbering {
public:
    /// Numbers plots, maps, diagrams and figures in one sequence, and equations that have an id.
    /// @throws std::logic_error with an id that is used twice
    Numbering(const Document& document, const std::vector<CitedWork>& works);

    /// Returns number, label and link of a figure, table, plot, map, diagram, formula, entry, section or cited work. A part of a section
    /// that failed or was skipped, or of a missing question, has the reference of its section, so that one failure does not break other
    /// sections. A section that is not shown has its title as label, without a link.
    /// @throws std::logic_error with an id that nothing has
    Reference resolve(const std::string& id) const;

    /// Marks an id as a part of the volume that is not written now; unknown ids are ignored. @param page  its file; empty: no links
    void place_elsewhere(const std::string& id, const std::string& page);

private:
    void add(const std::string& id, const std::string& kind, const std::string& number);   // "q1_errors", "Table ", "1.1"
    std::map<std::string, Reference> references_;
    std::map<std::string, Status> status_;   // of the sections in the document
};

/// True for ids such as "q4"; all other sections support the answers.
bool is_question(std::string_view section_id);
/// Returns the number of each section, in their order: that of the section, else "1" for "q1", letters from "A" for sections that are no
/// question; empty for sections that are not shown.
std::vector<std::string> section_numbers(const Document& document);
/// Returns the number of a question: its own, or that of its id if that is empty.
std::string question_number(const std::string& id, const std::string& own);
/// Returns the id of a page of the user's own by its place among them: "page-1".
std::string own_page_id(std::size_t place);
/// Sorts the questions by their numbers, "2" before "10" before "10b"; other sections stay behind them.
void sort_by_number(Document& document);

}   // namespace meshfolio::report
