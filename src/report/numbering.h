/// @file
/// Labels of everything in a document: "Figure 1.3", "Table 4.1", "Equation (2.2)", "Claim A.3", "Question 5", "[4]".
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
    std::string anchor;       // of the element in the page; empty: no page holds it
    bool elsewhere = false;   // it is in the other volume,
    std::string page = {};    // in this file; empty: no link leads there
};

class Numbering {
public:
    /// Plots, maps and figures share one count. Equations count when they have an id.
    /// @throws std::logic_error naming an id that is used twice
    Numbering(const Document& document, const std::vector<CitedWork>& works);

    /// Of a figure, table, plot, map, formula, entry, question or cited work. "t:q1_errors" means "q1_errors".
    /// A part of a section that failed or was not asked for resolves to that section, without an anchor: one failure must not break
    /// the other sections.
    /// @throws std::logic_error naming the id if nothing has it
    Reference resolve(const std::string& id) const;

    /// Marks an id as part of the other volume. @param page  its file; empty: no link leads there
    void place_elsewhere(const std::string& id, const std::string& page);

private:
    void add(const std::string& id, const std::string& kind, const std::string& number);
    std::string owner_of(const std::string& id) const;
    std::map<std::string, Reference> references_;
    std::map<std::string, Status> status_;   // of the sections in the document
};

/// "q4" and the like; other sections support the answers.
bool is_question(std::string_view section_id);
/// "1" for the section "q1"; letters for sections that are no question.
std::vector<std::string> section_numbers(const Document& document);

}   // namespace meshfolio::report
