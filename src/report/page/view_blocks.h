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

/// Returns {runs}: the pieces of a text, with references resolved and mathematics found in plain words.
nlohmann::json text_view(const Text& text, const Numbering& numbering);
/// Returns {runs}: the pieces of a caption, a name or a heading, with its mathematics found.
nlohmann::json prose_view(const std::string& words);
/// Returns prose_view() with has_mathml false, so that templates print letters and scripts: for outlines and heads of tables.
nlohmann::json letters_view(const std::string& words);

/// Returns id, label ("Table 4.1") and caption of a table, plot, map, diagram or figure.
nlohmann::json captioned_view(const std::string& id, const std::string& caption, const ViewContext& context);

/// Adds the pictures of a figure to its view: in lines, in a matrix or in blocks with six views, with widths, heads and legend.
void enter_pictures(nlohmann::json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// Returns the first picture of a drawn figure that has a legend, with label and legend, for the first page.
nlohmann::json cover_view(const Figure& cover, const ViewContext& context);

/// Returns the large pictures of the first four panels of a figure, with caption and legend, for the first page.
nlohmann::json strip_view(const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// Adds a `separator` to each entry of a list: "; ", empty for the last.
void enter_separators(nlohmann::json& list);

/// Returns heads, rows and cells of a table as people read them. A table longer than `table_rows` has one row in place of its middle, with
/// the number of rows left out.
nlohmann::json table_view(const Table& table, const ViewContext& context);

/// Returns the view of a block of any kind; its is_… tags tell the kind.
/// @param headings  number of headings so far; a heading adds one and takes it as its number
nlohmann::json block_view(const Block& block, const std::string& section_number, int& headings, const ViewContext& context);

}   // namespace meshfolio::report
