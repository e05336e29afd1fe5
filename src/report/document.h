/// @file
/// The report as plain data. Questions fill sections; the writers turn a document into HTML, Markdown, JSON and CSV and compute nothing.
/// Ids are unique in the document and made of [a-z0-9_]; by convention they begin with the question: "q1_…".
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "report/diagram.h"
#include "report/text.h"

namespace meshfolio::report {

// ---- blocks of a section ---------------------------------------------------------------------------------------------

struct Heading {
    std::string title;   // "Method", "Results", "Discussion"
    bool operator==(const Heading&) const = default;
};

struct Paragraph {
    Text text;
    bool operator==(const Paragraph&) const = default;
};

struct BulletList {
    std::vector<Text> items;
    bool operator==(const BulletList&) const = default;
};

/// A displayed equation by its name in templates/formulas.json, which has it as TeX and plain text.
struct Formula {
    std::string name;   // "cotangent_laplacian"
    std::string id;     // for references; empty: not numbered
    bool operator==(const Formula&) const = default;
};

struct Range {
    double low, high;
    bool operator==(const Range&) const = default;
};

/// An empty cell means "undefined"; it is never a zero.
using Cell = std::variant<std::monostate, double, std::string>;

struct Column {
    std::string name = {};                                           // "L2 error of H"
    std::string unit = {};                                           // "1/length"; empty: none
    int digits = 3;                                                  // significant digits for people; files get all
    enum class Best { none, smallest, largest } best = Best::none;   // value to be marked
    /// Rounding for people: bounds outwards, orders of convergence to tenths whatever `digits`. Files get all digits.
    enum class Rounding { nearest, down, up, tenths } rounding = Rounding::nearest;
    using Heat = Range;
    std::optional<Heat> heat = {};   // shades cells on a logarithmic scale: not at all up to `low`, fully from `high` on
    bool filter = false;             // readers may filter the rows by a value of this column
    bool reference = false;          // texts are ids: people see "Figure 1.3" with a link, files keep the id
    bool operator==(const Column&) const = default;
};

struct Table {
    std::string id = {};   // tables/<id>.csv
    std::string caption = {};
    std::vector<Column> columns = {};
    std::vector<std::vector<Cell>> rows = {};   // each as long as `columns`
    bool sortable = false;                      // readers of the page may sort it by any column
    bool file_only = false;                     // only in tables/ and results.json: neither numbered nor printed
    bool operator==(const Table&) const = default;
};

struct Series {
    std::string name = {};
    std::vector<double> x = {}, y = {};            // equally long; NaN leaves a gap
    std::vector<double> y_low = {}, y_high = {};   // error band; empty: none
    enum class Style { line, points, line_and_points, dashed } style = Style::line;
    /// Number of the colour, and of the dashes and point shape; −1: by the place of the series in its plot. For equal looks in several
    /// plots, or to distinguish series by two properties.
    int color = -1, pattern = -1;
    /// Series of one panel share a small plot of that name; all panels have common axes. For more than five series. Empty: one plot.
    std::string panel = {};
    bool operator==(const Series&) const = default;
};

struct Marker {
    double x = 0, y = 0;
    std::string label;        // "minimum, iteration 17"
    std::string panel = {};   // of its series
    bool operator==(const Marker&) const = default;
};

struct Plot {
    std::string id = {};   // tables/<id>.csv holds its data
    std::string caption = {};
    std::string alt = {};                     // the picture in words and numbers
    std::string x_label = {}, y_label = {};   // with units: "iteration", "rms error [length]"
    bool log_x = false, log_y = false;
    std::vector<Series> series = {};
    std::vector<Marker> markers = {};
    struct VerticalLine {
        double x;
        std::string label;
        bool operator==(const VerticalLine&) const = default;
    };
    std::vector<VerticalLine> vertical_lines = {};   // such as λ_crit
    bool operator==(const Plot&) const = default;
};

/// Values over a plane as coloured cells: one panel or several beside each other, on common axes and one scale of colours.
struct Map {
    std::string id = {};   // tables/<id>.csv holds its data
    std::string caption = {};
    std::string alt = {};                                       // the picture in words and numbers
    std::string x_label = {}, y_label = {}, value_label = {};   // with units
    std::vector<double> x = {}, y = {};                         // centres of the cells, ascending
    bool log_x = false, log_y = false, log_values = false;
    enum class Colours { sequential, diverging } colours = Colours::sequential;
    double middle = 0;   // palest value of a diverging map; a thin line separates the two sides
    using Range = report::Range;
    std::optional<Range> range = {};   // of the colours, whose ends hold for values beyond; empty: all finite values
    std::string undefined = {};        // meaning of the hatched cells: "blew up"
    struct Panel {
        std::string title;
        std::vector<double> values;         // row by row, from y[0]; NaN: undefined
        std::vector<Series> lines = {};     // drawn over the cells: a limit, a prediction
        std::vector<Marker> markers = {};   // labels have one letter or two
        bool operator==(const Panel&) const = default;
    };
    std::vector<Panel> panels = {};
    bool operator==(const Map&) const = default;
};

/// A figure of meshes. Its pictures are drawn from the request with its id (src/output/draw/figure_request.h).
struct Figure {
    std::string id;   // images/<id>_sheet.png and images/<panel>_<view>.png
    std::string caption;
    std::string alt;
    bool operator==(const Figure&) const = default;
};

using Block = std::variant<Heading, Paragraph, BulletList, Formula, Table, Plot, Map, Diagram, Figure>;

// ---- sections and the document --------------------------------------------------------------------------------------

/// A check passes if |measured − expected| ≤ tolerance (kind `near`), measured ≤ expected + tolerance (`at_most`) or
/// measured ≥ expected − tolerance (`at_least`). It is undecided, and no failure, if the number is no evidence, for example because
/// rounding exceeds the margin; the note says why.
struct Check {
    enum class Kind { near, at_most, at_least };
    enum class Status { passed, failed, undecided };
    std::string name;   // "Gauss–Bonnet: Σ deficit / 2π on sphere"
    double expected = 0;
    double measured = 0;
    double tolerance = 0;
    Status status = Status::failed;
    Kind kind = Kind::near;
    std::string note = {};   // the comparison, or the reason of an expected failure or of no decision
    bool passed() const { return status == Status::passed; }
    bool failed() const { return status == Status::failed; }
    bool operator==(const Check&) const = default;
};
/// Returns "measured 2.31, expected 2, tolerance 0.2" or "measured 3, expected at most 1": a tolerance only if above 0, "–" for NaN.
std::string words_of(const Check& check);
/// Return a check of kind near, at_most or at_least, passed or failed by its numbers as Check says; NaN fails.
Check check_near(std::string name, double expected, double measured, double tolerance, std::string note = "");
Check check_at_most(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
Check check_at_least(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
/// Returns the check with status undecided and the reason before its note.
Check undecided(Check check, std::string why);

/// Returns a failed check as undecided if it misses its tolerance by at most `rounding`; any other check unchanged.
Check within_rounding(Check check, double rounding);

/// Numbers of checks that passed, failed, and decided nothing.
struct Score {
    std::size_t passed = 0, failed = 0, undecided = 0;
    std::size_t total() const { return passed + failed + undecided; }
    Score& operator+=(const Score& other);
};
/// Returns the numbers of checks that passed, failed and were undecided.
Score score_of(const std::vector<Check>& checks);
/// Returns "456 of 458 checks passed, 1 failed, 1 undecided", without counts of 0.
std::string words_of(const Score& score);

struct Input {
    std::string role;        // "armadillo"
    std::string asked;       // path in the assignment, "decompose/armadillo.obj"; empty: not in it
    std::string file;        // name of the file, without its folder
    bool stand_in = false;   // a bundled mesh in place of the one asked for
    std::string sha256;
    int vertices = 0, triangles = 0;
    bool operator==(const Input&) const = default;
};

struct CodeReference {
    std::string function;   // "uniform_laplacian"
    std::string file;       // "src/geometry/operators/uniform_laplacian.cpp"
    std::string purpose;    // "Δ with uniform weights"
    int line = 0;           // of the function in src.txt; 0: not cited
    bool operator==(const CodeReference&) const = default;
};

struct Timing {
    std::string what;
    double seconds = 0;
    bool operator==(const Timing&) const = default;
};

/// A setting of a section: the printed words, and for programs a number, a list of numbers, or the words.
struct Parameter {
    std::string text;   // "2 %, 5 % and 10 % of the box diagonal"
    std::variant<std::string, double, std::vector<double>> value;
    std::string unit = {};   // "box diagonal"; empty: none
    Parameter(std::string words = "") : text(words), value(std::move(words)) {}
    Parameter(const char* words) : Parameter(std::string(words)) {}
    Parameter(std::integral auto count) : text(std::to_string(count)), value(static_cast<double>(count)) {}
    Parameter(std::string words, double number, std::string unit_of_it = {})
        : text(std::move(words)), value(number), unit(std::move(unit_of_it)) {}
    template <class Number>
    Parameter(std::string words, const std::vector<Number>& numbers, std::string unit_of_them = {})
        : text(std::move(words)), value(std::vector<double>(numbers.begin(), numbers.end())), unit(std::move(unit_of_them)) {}
    bool operator==(const Parameter&) const = default;
};
using Parameters = std::map<std::string, Parameter>;
/// Returns the printed words of each parameter, by its name.
std::map<std::string, std::string> texts_of(const Parameters& parameters);

enum class Status { ok, failed, skipped };

/// The extent of a skipped section that the user did not ask for. Pages leave it out; results.json has it.
inline constexpr const char* not_asked_for = "not asked for";

struct Section {
    std::string id;   // "q1"
    std::string title;
    std::string asked;         // the question in one sentence
    std::string number = {};   // of a question in the report, "3" or "3b"; empty: that of its id
    double points = 0;         // that a question gives; 0: none
    std::string intro = {};    // Markdown of the teacher (own_blocks() in words.h), shown in place of `asked`
    Status status = Status::ok;
    std::string failure;   // one line, when failed
    std::string extent;    // for the opening table: "H and K on 4 meshes, …"
    std::vector<Input> inputs;
    Parameters parameters;
    std::vector<CodeReference> code;
    Text answer;   // in one sentence, for the opening table and as the first line of the section
    std::vector<Block> blocks;
    /// Number of a question's blocks in the report; the further ones, its long tables and other figures, are in the appendix. −1: all are
    /// in the report.
    int appendix_from = -1;
    std::vector<Check> checks;
    std::vector<std::string> warnings;
    std::vector<std::string> output_meshes;   // "meshes/q4_armadillo_k5.ply"
    std::vector<Timing> timings;
    bool operator==(const Section&) const = default;
};

/// True unless the section was skipped because the user did not ask for it.
inline bool is_shown(const Section& section) { return section.status != Status::skipped || section.extent != not_asked_for; }

/// Returns an id for each column of a table, unique in the document, from the id of the table and the name: "q5_limits-lambda-crit".
std::vector<std::string> column_ids(const Table& table);

/// Returns an id for each check of a section, unique in the document, from the id of the section and the name: "q5-energy-falls-on-cube",
/// "…-2" for a second one.
std::vector<std::string> check_ids(const Section& section);

/// Returns an id for each parameter of a section, in their order: "q7-parameter-lambda".
std::vector<std::string> parameter_ids(const Section& section);

struct Provenance {
    std::string version, commit, compiler, build_type;
    std::map<std::string, std::string> libraries;   // name → version
    std::map<std::string, std::string> settings;    // without threads and paths
    std::uint64_t seed = 0;
    bool operator==(const Provenance&) const = default;
};

/// A page of the user's own text, between the questions.
struct OwnPage {
    std::string title;
    std::string text;     // Markdown, as Section::intro
    std::string before;   // id of the question that follows; empty: after the last
    bool operator==(const OwnPage&) const = default;
};

struct Document {
    std::string title, author, course;
    Provenance provenance;
    std::vector<Section> sections;   // questions in order of their numbers, then the others
    std::vector<OwnPage> pages = {};
    std::vector<Timing> timings;   // of the run as a whole
    bool operator==(const Document&) const = default;
};

/// True if a citation has its line, so that the report has src.txt.
bool cites_source(const Document& document);

}   // namespace meshfolio::report
