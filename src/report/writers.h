/// @file
/// A Document to files. Every writer is a pure function from data to bytes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

/// The script bundled from templates/viewer; empty when the program was built without it.
std::string_view viewer_program();

/// Templates by file name ("report.html"): those compiled in, each replaced by the file of that name in a folder when it is there.
class Templates {
public:
    /// @throws UsageError if `folder` is given and not a folder, or a template in it has a syntax error (named with its line) or is a link
    ///         to what lies outside of it
    explicit Templates(const std::filesystem::path& folder = {});
    const std::string& operator[](const std::string& name) const;   // @throws UsageError for an unknown name
    std::vector<std::string> names() const;
    /// Takes the template `name` from a file.
    /// @throws UsageError for an unknown name, an unreadable file, or a syntax error (named with its line)
    void replace(const std::string& name, const std::filesystem::path& file);
    /// Takes the template `name` from text. @param file  what messages call it
    /// @throws UsageError for an unknown name or a syntax error (named with its line)
    void set(const std::string& name, std::string text, const std::string& file);

private:
    std::map<std::string, std::string> text_;
};

/// What every tag of the templates stands for, by its path in the view model, "sections.blocks.caption". Lists and conditions are named
/// like the values in them.
std::map<std::string, std::string> tag_list();
/// The same list as text, one line a tag.
std::string tag_documentation();

/// The two volumes that a report is published in.
enum class Volume {
    report,    // the questions
    appendix   // what they rest on: the other sections, what questions leave to it, all checks, where everything comes from
};

/// The file of a volume in each format.
inline std::string page_file(Volume volume) { return volume == Volume::report ? "index.html" : "appendix.html"; }
inline std::string markdown_file(Volume volume) { return volume == Volume::report ? "report.md" : "appendix.md"; }
inline std::string pdf_file(Volume volume) { return volume == Volume::report ? "report.pdf" : "appendix.pdf"; }
inline Volume other_of(Volume volume) { return volume == Volume::report ? Volume::appendix : Volume::report; }

/// A mesh of the live laboratory, inside the page as data.
struct Lab {
    std::string questions;   // that open it: "q5 q7"
    std::string data;        // zlib, then base64
};
/// @param bytes  as templates/viewer/lab_math.js reads them
Lab lab_of(std::string questions, std::string_view bytes);
/// The laboratories inside a page that we wrote; anything malformed is skipped.
std::vector<Lab> labs_in(std::string_view page);

struct WriteOptions {
    Volume volume = Volume::report;
    bool timings = true;             // false: nothing that differs from run to run
    bool plot_files = false;         // the caller also writes svg_on_white(svg_of(plot)) to images/<id>.svg; Markdown then shows the plots
    bool paper = false;              // the report is printed as well, and the page links to it
    std::string design = "report";   // of the page: design.html with design.css, of the templates
    std::string_view viewer = viewer_program();   // turns the models of the page; empty: they are only linked to
    std::vector<Lab> labs = {};                   // of the report's page; none without the viewer
};

/// The bundled designs of index.html.
inline constexpr const char* page_designs[] = {"report", "print"};

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options = {});
/// The laboratory of one mesh as a page of its own.
std::string write_lab_page(const std::string& title, const Lab& lab, const Templates& templates,
                           std::string_view viewer = viewer_program());
std::string write_markdown(const Document& document, const DrawnFigures& figures, const Templates& templates,
                           const WriteOptions& options = {});
/// The answers on one page of Markdown, for the summary of a CI job.
std::string write_summary(const Document& document, const Templates& templates);
/// JUnit XML: a suite a section, a case a check (its id), what is undecided as skipped. No clock is read: its times are those of the
/// document.
std::string write_junit(const Document& document, bool timings);
std::string write_json(const Document& document, const DrawnFigures& figures, const WriteOptions& options = {});

/// The JSON schema (draft 7) of results.json, made from the descriptions that write and read it (json/json_fields.h).
const std::string& results_schema();

/// RFC 4180, LF line ends, header `name [unit]`, numbers exact, undefined cells empty. Texts are on one line and no formulas.
std::string write_csv(const Table& table);
std::string write_csv(const Plot& plot);
/// One row a cell; the lines over a panel follow its cells, by their names and without a value.
std::string write_csv(const Map& map);

/// Inline SVG that takes its colours from the page (currentColor and CSS variables), readable in grey.
std::string svg_of(const Plot& plot);
std::string svg_of(const Map& map);
std::string svg_of(const Diagram& diagram);
/// The plot for one column of a paper; empty for one of several panels, which needs the page.
std::string column_svg_of(const Plot& plot);
/// What the colours of a figure mean, in a fixed size, so that its words are as large on a phone as on paper: the quantity with its unit,
/// the histogram of the values over their colours, numbers, and what lies beyond the colours. @param place  unique in a page, for ids
std::string svg_of(const Legend& legend, const std::string& place, bool small = false);

/// The same as a file of its own, which Markdown cannot hold inline: on white, as there is no page to take a colour from.
std::string svg_on_white(std::string svg);

}   // namespace meshfolio::report
