#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "report/batch/batch.h"

namespace meshfolio::report {

namespace {

double share_of(double part, double whole) {
    if (part <= 0) return 0;
    return whole > 0 ? part / whole : std::numeric_limits<double>::infinity();
}

const Table* table_of(const Document& document, const std::string& id) {
    for (const Section& section : document.sections) {
        for (const Block& block : section.blocks) {
            const auto* table = std::get_if<Table>(&block);
            if (table != nullptr && table->id == id) return table;
        }
    }
    return nullptr;
}

/// Returns the cell of the first row in the column with this id, which begins with the id of its table; empty without such a column.
Cell first_cell(const Document& document, const std::string& column) {
    const Table* table = table_of(document, column.substr(0, column.find('-')));
    if (table == nullptr || table->rows.empty()) return {};
    const std::vector<std::string> ids = column_ids(*table);
    const auto id = std::ranges::find(ids, column);
    return id != ids.end() ? table->rows.front().at(static_cast<std::size_t>(id - ids.begin())) : Cell();
}

void take_counts(BatchRow& row, const Document& document, const BatchSources& sources) {
    const auto first = std::ranges::find_if(document.sections, [](const Section& section) { return !section.inputs.empty(); });
    if (first != document.sections.end()) {
        const Input& input = first->inputs.front();
        row.sha256 = input.sha256;
        row.vertices = double(input.vertices);
        row.triangles = double(input.triangles);
    }
    const auto source_of = [&](const char* key) { return sources.contains(key) ? sources.at(key) : ""; };
    for (const BatchFact& fact : batch_facts)
        if (sources.contains(fact.key)) row.*fact.cell = first_cell(document, sources.at(fact.key));
    row.lambda_critical = first_cell(document, source_of("lambda_critical"));
    const std::string table = source_of("defects");
    const auto preflight = std::ranges::find(document.sections, table.substr(0, table.find('_')), &Section::id);
    if (preflight == document.sections.end() || preflight->status != Status::ok) return;
    row.defects.emplace();
    const Table* defects = table_of(document, table);
    if (defects == nullptr) return;   // none were found
    for (const std::vector<Cell>& cells : defects->rows) {
        const auto* kind = cells.size() < 2 ? nullptr : std::get_if<std::string>(&cells[0]);
        const auto* count = cells.size() < 2 ? nullptr : std::get_if<double>(&cells[1]);
        if (kind != nullptr && count != nullptr) row.defects->emplace_back(*kind, *count);
    }
}

template <class Visit> void for_each_check(const std::vector<Section>& sections, const Visit& visit) {
    for (const Section& section : sections) {
        const std::vector<std::string> ids = check_ids(section);
        for (std::size_t i = 0; i < ids.size(); ++i) visit(ids[i], section.checks[i]);
    }
}

/// Returns the id of a check without the name of the mesh, as other meshes have it, too: "q5-bound-on-" for "q5-bound-on-cube8" of cube8.
std::string common_id(std::string id, std::string mesh) {
    std::ranges::replace(mesh, '_', '-');
    const std::size_t at = mesh.empty() ? std::string::npos : ("-" + id + "-").find("-" + mesh + "-");   // a whole word
    return at == std::string::npos ? id : id.erase(at, mesh.size());
}

}   // namespace

double used_share(const Check& check) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const double limit = check.kind == Check::Kind::at_least ? check.expected - check.tolerance : check.expected + check.tolerance;
    if (!std::isfinite(check.measured) || !std::isfinite(limit)) return check.passed() ? 0 : none;
    if (check.kind == Check::Kind::near) return share_of(std::abs(check.measured - check.expected), check.tolerance);
    const double beyond = check.kind == Check::Kind::at_most ? check.measured - check.expected : check.expected - check.measured;
    if (std::trunc(check.expected) == check.expected && check.expected != 0)
        return check.tolerance > 0 || beyond <= 0 ? share_of(beyond, check.tolerance) : 1 + beyond;
    if (limit <= 0) return check.passed() ? 0 : none;   // no scale to measure by
    return check.kind == Check::Kind::at_most ? share_of(check.measured, limit) : share_of(limit, check.measured);
}

std::optional<WorstCheck> worst_check(const std::vector<Section>& sections, const std::map<std::string, double>& usual,
                                      const std::string& mesh) {
    std::optional<WorstCheck> worst;
    // Failed checks first, then those beyond the usual share, then by the share itself.
    const auto rank = [](const WorstCheck& check) { return std::tuple(check.failed, check.is_usual ? 0 : check.beyond, check.used); };
    for_each_check(sections, [&](const std::string& id, const Check& check) {
        if (check.status == Check::Status::undecided) return;
        WorstCheck one{id, check.name + ": " + words_of(check), check.failed(), used_share(check)};
        const auto found = usual.find(common_id(id, mesh));
        one.beyond = found != usual.end() && std::isfinite(one.used) ? one.used - found->second : one.used;
        one.is_usual = !one.failed && one.beyond < 0.01;
        if (!worst || rank(one) > rank(*worst)) worst = one;
    });
    return worst;
}

BatchRow batch_row(std::string name, std::string file, const Document& document, bool timings, const BatchSources& sources) {
    BatchRow row{.name = std::move(name), .file = std::move(file)};
    bool is_good = true;
    for (const Section& section : document.sections) {
        Section& kept = row.sections.emplace_back(section);
        kept.blocks.clear();
        row.score += score_of(section.checks);
        is_good = is_good && section.status != Status::failed;
    }
    row.state = is_good && row.score.failed == 0 ? BatchRow::State::good : BatchRow::State::bad;
    row.worst = worst_check(row.sections);
    if (timings && !document.timings.empty()) row.seconds = document.timings.back().seconds;
    take_counts(row, document, sources);
    return row;
}

Score score_of(const Batch& batch) {
    Score score;
    for (const BatchRow& row : batch.rows) score += row.score;
    return score;
}

std::map<std::string, double> usual_shares(const Batch& batch) {
    std::map<std::string, std::vector<double>> shares;
    for (const BatchRow& row : batch.rows)
        for_each_check(row.sections, [&](const std::string& id, const Check& check) {
            if (std::isfinite(used_share(check))) shares[common_id(id, row.name)].push_back(used_share(check));
        });
    std::map<std::string, double> usual;
    for (auto& [id, values] : shares) {
        const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
        std::ranges::nth_element(values, middle);
        usual[id] = *middle;
    }
    return usual;
}

std::size_t count_of(const Batch& batch, BatchRow::State state) {
    return static_cast<std::size_t>(std::ranges::count(batch.rows, state, &BatchRow::state));
}

}   // namespace meshfolio::report
