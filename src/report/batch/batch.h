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

/// The check of a report that worst_check() chooses.
struct WorstCheck {
    std::string id, words;   // words: its name and the measured number
    bool failed = false;
    double used = 0;         // see used_share()
    double beyond = 0;       // `used` minus the usual share
    bool is_usual = false;   // passed, and beyond the usual share by less than 0.01
};

/// Returns the share of its allowance that a check uses, above 1 or ∞ if it fails: |error| / tolerance, measured / limit for at_most, limit
/// / measured for at_least; the limit includes the tolerance. If `expected` of a limit is a whole number other than 0, from a theorem or a
/// count: excess / tolerance (1 + excess if nothing is tolerated), 0 without an excess.
double used_share(const Check& check);

/// Returns the check that exceeds its usual share most, failed checks before passed ones; if no passed one exceeds it by 0.01, the one of
/// largest used_share(). Empty without decided checks.
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

/// Returns the row of a mesh from its report, without its link and picture; its state is bad if a section or a check failed, else good.
/// @param timings  with the time of the run
BatchRow batch_row(std::string name, std::string file, const Document& document, bool timings, const BatchSources& sources);

struct Batch {
    std::vector<BatchRow> rows;   // in the order of the page
    bool timings = true;
};

/// Returns the number of rows in this state.
std::size_t count_of(const Batch& batch, BatchRow::State state);
/// Returns the sums, over all rows, of the checks that passed, failed and were undecided.
Score score_of(const Batch& batch);
/// Returns for each check, by its id without the name of the mesh, the lower median of its finite used_share() over the meshes.
std::map<std::string, double> usual_shares(const Batch& batch);

/// Returns the table of batch.csv, a row for each mesh: name, file, state, batch_facts, defects, λ_crit, checks, worst check, report,
/// error, time.
Table batch_table(const Batch& batch);
/// Returns batch.json, an object for each mesh; undefined values are null. @param version  of the program
std::string write_batch_json(const Batch& batch, const std::string& version);
/// Returns JUnit XML: a suite for each mesh, a case for each check, an error for a mesh without a report.
std::string write_batch_junit(const Batch& batch);
/// Returns index.html of the batch. @throws UsageError for a template with an unknown tag
std::string write_batch_page(const Batch& batch, const std::string& version, const Templates& templates);

/// Returns the view model of batch.html: counts over the batch, and `rows`, one for each mesh.
nlohmann::json batch_view(const Batch& batch);

}   // namespace meshfolio::report
