/// @file
/// The index of a batch, which has a report for each of many meshes: one row per mesh, as page, JSON, CSV and JUnit XML. run/batch runs the
/// reports.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/document.h"
#include "report/writers.h"

namespace meshfolio::report {

/// The worst check of a report: a failed one if there is any, else the one nearest to its limit.
struct WorstCheck {
    std::string id, words;   // words: its name and the measured number
    bool failed = false;
    double used = 0;         // see used_share()
    double beyond = 0;       // `used` minus the usual share
    bool is_usual = false;   // passed, and beyond the usual share by less than 0.01
};

/// Returns the share of its allowance that a check uses: 0.5 for an error of half the tolerance, above 1 if it fails, ∞ if nothing is
/// allowed. A limit that is a whole number other than 0 comes from a theorem or a count: up to it the share is 0, beyond it the excess over
/// the tolerance.
double used_share(const Check& check);

/// Returns a failed check if there is any, else the one that exceeds its usual share most; empty without decided checks.
/// @param usual  usual_shares() of the batch; ids that are not in it count as 0
/// @param mesh   name of the row
std::optional<WorstCheck> worst_check(const std::vector<Section>& sections, const std::map<std::string, double>& usual = {},
                                      const std::string& mesh = "");

struct BatchRow {
    enum class State { waiting, good, bad, failed };   // bad: its report has a failure; failed: there is no report
    std::string name;                                  // of its folder and its suite
    std::string file;                                  // of the mesh, as the user named it
    State state = State::waiting;
    std::string error = {};    // reason of a failure, one line
    std::string report = {};   // page of the report: "bunny/index.html"; empty: none
    struct Picture {
        std::string jpeg, alt;
        int width = 0, height = 0;
    };
    std::optional<Picture> picture = {};
    std::string sha256 = {};
    /// Values from sections of the report; empty without such a section.
    Cell vertices = {}, edges = {}, triangles = {}, components = {}, boundary_loops = {}, euler_characteristic = {}, genus = {};
    Cell manifold = {}, orientation = {};   // words
    Cell lambda_critical = {};              // [length²]
    using Defects = std::vector<std::pair<std::string, double>>;
    std::optional<Defects> defects = {};   // kind and count; empty: not looked for
    Score score = {};
    std::optional<WorstCheck> worst = {};
    Cell seconds = {};                    // absent without timings
    std::vector<Section> sections = {};   // checks alone
};

/// A cell of a row: its key in batch.json, and its column in batch.csv.
struct BatchFact {
    Cell BatchRow::*cell;
    const char *key, *name;
};
inline constexpr BatchFact batch_facts[] = {{&BatchRow::vertices, "vertices", "vertices"},
                                            {&BatchRow::edges, "edges", "edges"},
                                            {&BatchRow::triangles, "triangles", "triangles"},
                                            {&BatchRow::components, "components", "components"},
                                            {&BatchRow::boundary_loops, "boundary_loops", "boundary loops"},
                                            {&BatchRow::euler_characteristic, "euler_characteristic", "Euler characteristic"},
                                            {&BatchRow::genus, "genus", "genus"},
                                            {&BatchRow::manifold, "manifold", "manifold"},
                                            {&BatchRow::orientation, "orientation", "orientation"}};

/// Key of a fact, "lambda_critical" or "defects" → the id of the column of the report that it comes from; of the defects, of the table.
using BatchSources = std::map<std::string_view, std::string>;

/// Returns the row of a mesh from its report. @param timings  with the time of the run
BatchRow batch_row(std::string name, std::string file, const Document& document, bool timings, const BatchSources& sources);

struct Batch {
    std::vector<BatchRow> rows;   // in the order of the page
    bool timings = true;
};

/// Returns the number of rows in this state.
std::size_t count_of(const Batch& batch, BatchRow::State state);
/// Returns the counts of the checks of all rows.
Score score_of(const Batch& batch);
/// Returns for each check, by its id without the name of the mesh, the median of used_share() over the meshes.
std::map<std::string, double> usual_shares(const Batch& batch);

/// Returns the rows as a table for write_csv(): batch.csv.
Table batch_table(const Batch& batch);
/// Returns batch.json. @param version  of the program
std::string write_batch_json(const Batch& batch, const std::string& version);
/// Returns JUnit XML: a suite for each mesh, a case for each check.
std::string write_batch_junit(const Batch& batch);
/// Returns index.html of the batch. @throws UsageError for a template with an unknown tag
std::string write_batch_page(const Batch& batch, const std::string& version, const Templates& templates);

/// Returns the values of batch.html, for the list of tags.
nlohmann::json batch_view(const Batch& batch);

}   // namespace meshfolio::report
