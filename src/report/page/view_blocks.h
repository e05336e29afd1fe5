/// @file
/// The blocks of a section as the templates see them (view_model.h).
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "report/numbering.h"
#include "report/page/view_model.h"

namespace meshfolio::report {

/// The data that all views of blocks need.
struct ViewContext {
    const DrawnFigures& figures;
    const Numbering& numbering;
    const std::map<std::string, FormulaForms>& formulas;
    const ViewOptions& options;
};

/// A text: its `runs`, references resolved.
nlohmann::json text_view(const Text& text, const Numbering& numbering);
/// A caption, a name or a heading as text, with its symbols marked.
nlohmann::json prose_view(const std::string& words);
/// The same with formulas as letters and scripts, where what reads a page knows no MathML.
nlohmann::json letters_view(const std::string& words);

/// Label and caption of a table, plot, map or figure.
nlohmann::json captioned_view(const std::string& id, const std::string& caption, const ViewContext& context);

/// Enters what a page needs to show the pictures of a figure: how they are laid out, on screens and on paper alike.
void enter_pictures(nlohmann::json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// The picture of the first page.
nlohmann::json cover_view(const Figure& cover, const ViewContext& context);

/// The large pictures of the first panels of a figure, for the first page.
nlohmann::json strip_view(const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// Enters a `separator` into each item of a list.
void enter_separators(nlohmann::json& list);

nlohmann::json table_view(const Table& table, const ViewContext& context);

/// A heading gets the next of the section's subsection numbers, counted in `headings`.
nlohmann::json block_view(const Block& block, const std::string& section_number, int& headings, const ViewContext& context);

}   // namespace meshfolio::report
