/// @file
/// Writers turn a document into the bytes of files. They are pure functions.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

/// Returns the script bundled from templates/viewer; empty if the program was built without it.
std::string_view viewer_program();

/// Templates by file name ("report.html"): the bundled ones, each replaced by the file of that name in a folder, if there is one.
class Templates {
public:
    /// Takes the bundled templates, replaced by files of `folder`; empty: none.
    /// @throws UsageError if `folder` is not a folder, or a template in it cannot be read, has a syntax error or is a link that leads out
    /// of it
    explicit Templates(const std::filesystem::path& folder = {});
    const std::string& operator[](const std::string& name) const;   // @throws UsageError for an unknown name
    std::vector<std::string> names() const;                         // all, sorted
    /// Replaces the template `name` by a file.
    /// @throws UsageError for an unknown name, an unreadable file, or a syntax error
    void replace(const std::string& name, const std::filesystem::path& file);
    /// Replaces the template `name` by a text. @param file  its name in messages
    /// @throws UsageError for an unknown name or a syntax error
    void set(const std::string& name, std::string text, const std::string& file);

private:
    std::map<std::string, std::string> text_;
};

/// Returns the meaning of each tag of the templates by its path in the view model, "sections.blocks.caption".
std::map<std::string, std::string> tag_list();
/// Returns the tags of the templates with their meanings, and the messages of templates/words with their facts, as text for people.
std::string tag_documentation();

/// The two volumes of a report.
enum class Volume {
    report,    // the questions
    appendix   // the other sections, further blocks of questions, all checks, provenance
};

/// Return the file name of a volume as page, Markdown and PDF: "index.html", "report.md", "report.pdf" or "appendix.…".
inline std::string page_file(Volume volume) { return volume == Volume::report ? "index.html" : "appendix.html"; }
inline std::string markdown_file(Volume volume) { return volume == Volume::report ? "report.md" : "appendix.md"; }
inline std::string pdf_file(Volume volume) { return volume == Volume::report ? "report.pdf" : "appendix.pdf"; }
inline Volume other_of(Volume volume) { return volume == Volume::report ? Volume::appendix : Volume::report; }

/// The data of a mesh for the live laboratory of a page.
struct Lab {
    std::string questions;   // ids of questions that open it: "q5 q7"
    std::string data;        // zlib, then base64
};
/// Returns a laboratory whose data are compressed by zlib, as base64. @param bytes  as templates/viewer/lab_math.js reads them
Lab lab_of(std::string questions, std::string_view bytes);
/// Returns the laboratories in an HTML page that this program wrote, in their order; malformed ones are left out.
std::vector<Lab> labs_in(std::string_view page);

struct WriteOptions {
    Volume volume = Volume::report;
    bool timings = true;                          // false: omits times, which differ from run to run
    bool plot_files = false;                      // plots are also images/<id>.svg, which the caller writes and Markdown shows
    bool paper = false;                           // the page links to the PDF
    std::string design = "report";                // of the page: the templates <design>.html and <design>.css
    std::string_view viewer = viewer_program();   // turns the models of the page; empty: the page only links to them
    std::vector<Lab> labs = {};                   // for the page of the report; unused without the viewer
};

/// The bundled designs of index.html.
inline constexpr const char* page_designs[] = {"report", "print"};

/// Returns the page of one volume: index.html or appendix.html.
std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options = {});
/// Returns an HTML page that holds one laboratory and nothing else.
std::string write_lab_page(const std::string& title, const Lab& lab, const Templates& templates,
                           std::string_view viewer = viewer_program());
/// Returns the Markdown of one volume. Tables show 40, 12 or 4 rows, as many as keep it within 256 KiB, which GitHub renders.
std::string write_markdown(const Document& document, const DrawnFigures& figures, const Templates& templates,
                           const WriteOptions& options = {});
/// Returns the answers as Markdown of at most 20,000 bytes, with up to 20 checks a section that did not pass, for the summary of a CI job.
std::string write_summary(const Document& document, const Templates& templates);
/// Returns JUnit XML: a suite for each section, a case for each check, undecided ones as skipped.
/// @param timings  with the time of each section; false: 0 s
std::string write_junit(const Document& document, bool timings);
/// Returns the text of results.json, which read_json() reads; numbers that are not finite are null and listed beside.
std::string write_json(const Document& document, const DrawnFigures& figures, const WriteOptions& options = {});

/// Returns the JSON schema (draft 7) of results.json, from the descriptions that write and read it (json/json_fields.h).
const std::string& results_schema();

/// Returns a table as CSV (RFC 4180, LF line ends): header `name [unit]`, exact numbers, empty undefined cells, texts on one line and no
/// formulas.
std::string write_csv(const Table& table);
/// Returns the data of a plot, a row for each point: panel if there are panels, series, x, y, and the band if there is one.
Table table_of(const Plot& plot);
/// Returns the data of a map: panel, series ("cells" or a line), x, y, value; a row for each cell, then for each point of a line, without a
/// value.
Table table_of(const Map& map);

/// Return a drawing as inline SVG, readable in grey, with colours of the page (currentColor and CSS variables).
std::string svg_of(const Plot& plot);
std::string svg_of(const Map& map);
std::string svg_of(const Diagram& diagram);
/// Returns the plot as inline SVG for one column of a paper; empty for a plot of several panels, which needs the width of the page.
std::string column_svg_of(const Plot& plot);
/// Returns the legend of a figure's colours as SVG: quantity and unit, histogram, colours, numbers, shares beyond the ends. Empty without
/// colours or finite ends.
/// @param place  unique in a page, for ids @param small  in one line: colours and their ends
std::string svg_of(const Legend& legend, const std::string& place, bool small = false);

/// Returns inline SVG as the text of an SVG file, on a white ground.
std::string svg_on_white(std::string svg);

}   // namespace meshfolio::report
