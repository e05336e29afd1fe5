/// @file
/// Many meshes with a report each: one row a mesh, and the index of them as page, JSON, CSV and JUnit XML. Pure functions; what runs the
/// reports is run/batch.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/document.h"
#include "report/writers.h"

namespace meshfolio::report {

/// The worst check: a failed one if there is any, else the one nearest to its limit.
struct WorstCheck {
    std::string id, words;   // words: its name and what was measured
    bool failed = false;
    double used = 0;         // share of the allowance: above 1 fails; ∞ if nothing is allowed
    double beyond = 0;       // how much more that is than usual
    bool is_usual = false;   // by no more than a percent
};

/// The share of a check's allowance that the measured number uses. A limit that is a whole number other than 0 comes from a theorem or a
/// count and is no allowance: the share is 0 up to it, and counts against the tolerance beyond it.
double used_share(const Check& check);
/// @param usual  see usual_shares(): where none failed, the one farthest beyond its usual share is taken @param mesh  name of the row
std::optional<WorstCheck> worst_check(const std::vector<Section>& sections, const std::map<std::string, double>& usual = {},
                                      const std::string& mesh = "");

struct BatchRow {
    enum class State { waiting, good, bad, failed };   // bad: its report has a failure; failed: there is no report
    std::string name;                                  // of its folder and its suite
    std::string file;                                  // of the mesh, as it was named
    State state = State::waiting;
    std::string error = {};    // why it failed, in one line
    std::string report = {};   // its page: "bunny/index.html"; empty: none
    struct Picture {
        std::string jpeg, alt;
        int width = 0, height = 0;
    };
    std::optional<Picture> picture = {};
    std::string sha256 = {};
    /// From sections of the report; empty if it has no such section.
    Cell vertices = {}, edges = {}, triangles = {}, components = {}, boundary_loops = {}, euler_characteristic = {}, genus = {};
    Cell manifold = {}, orientation = {};                                      // words
    Cell lambda_critical = {};                                                 // [length²]
    std::optional<std::vector<std::pair<std::string, double>>> defects = {};   // kind and count; none: not looked for
    Score score = {};
    std::optional<WorstCheck> worst = {};
    Cell seconds = {};                    // absent without timings
    std::vector<Section> sections = {};   // checks alone
};

/// A cell of a row: its key in batch.json, its column in batch.csv, and the column of a report's tables that it comes from; empty: from the
/// section's input.
struct BatchFact {
    Cell BatchRow::*cell;
    const char *key, *name, *source;
};
inline constexpr BatchFact batch_facts[] = {
    {&BatchRow::vertices, "vertices", "vertices", ""},
    {&BatchRow::edges, "edges", "edges", "certificates_connectivity-edges"},
    {&BatchRow::triangles, "triangles", "triangles", ""},
    {&BatchRow::components, "components", "components", "certificates_connectivity-components"},
    {&BatchRow::boundary_loops, "boundary_loops", "boundary loops", "certificates_connectivity-boundary-loops"},
    {&BatchRow::euler_characteristic, "euler_characteristic", "Euler characteristic", "certificates_connectivity-chi"},
    {&BatchRow::genus, "genus", "genus", "certificates_connectivity-genus"},
    {&BatchRow::manifold, "manifold", "manifold", "certificates_connectivity-manifold"},
    {&BatchRow::orientation, "orientation", "orientation", "certificates_connectivity-orientation"}};

/// The row of a mesh, from its report. @param timings  include the time it took
BatchRow batch_row(std::string name, std::string file, const Document& document, bool timings);

struct Batch {
    std::vector<BatchRow> rows;   // as they are shown
    bool timings = true;
};

std::size_t count_of(const Batch& batch, BatchRow::State state);
Score score_of(const Batch& batch);
/// By the id of the check without the name of the mesh, the median over the meshes of the share that each uses.
std::map<std::string, double> usual_shares(const Batch& batch);

Table batch_table(const Batch& batch);   // for write_csv()
std::string write_batch_json(const Batch& batch, const std::string& version);
/// One suite per mesh, one case per check.
std::string write_batch_junit(const Batch& batch);
/// @throws UsageError for a template with an unknown tag
std::string write_batch_page(const Batch& batch, const std::string& version, const Templates& templates);

/// What batch.html prints, for the list of tags.
nlohmann::json batch_view(const Batch& batch);

}   // namespace meshfolio::report
