/// @file
/// Builds the view model of the blocks of a section (view_model.h).
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "report/numbering.h"
#include "report/page/view_model.h"

namespace meshfolio::report {

/// The data that the views of all blocks share.
struct ViewContext {
    const DrawnFigures& figures;
    const Numbering& numbering;
    const std::map<std::string, FormulaForms>& formulas;
    const ViewOptions& options;
};

/// Returns a text as its `runs`, with references resolved.
nlohmann::json text_view(const Text& text, const Numbering& numbering);
/// Returns a caption, a name or a heading as `runs`, with its mathematics found.
nlohmann::json prose_view(const std::string& words);
/// Returns prose_view() without MathML, its formulas as letters and scripts, for outlines and heads of tables.
nlohmann::json letters_view(const std::string& words);

/// Returns id, label and caption of a table, plot, map or figure.
nlohmann::json captioned_view(const std::string& id, const std::string& caption, const ViewContext& context);

/// Adds the layout of the pictures of a figure, for screens and for paper.
void enter_pictures(nlohmann::json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// Returns the picture of the first page.
nlohmann::json cover_view(const Figure& cover, const ViewContext& context);

/// Returns the large pictures of the first panels of a figure, for the first page.
nlohmann::json strip_view(const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// Adds a `separator` to each entry of a list.
void enter_separators(nlohmann::json& list);

/// Returns the cells of a table as people read them; long tables have a gap.
nlohmann::json table_view(const Table& table, const ViewContext& context);

/// Returns a block of any kind. @param headings  number of headings so far; a heading adds one and takes it as its number
nlohmann::json block_view(const Block& block, const std::string& section_number, int& headings, const ViewContext& context);

}   // namespace meshfolio::report
