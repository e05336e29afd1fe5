// batch.csv and batch.json.
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "report/batch/batch.h"

namespace meshfolio::report {

namespace {

using OrderedJson = nlohmann::ordered_json;

const char* name_of(BatchRow::State state) {
    constexpr const char* names[] = {"waiting", "ok", "checks failed", "failed"};
    return names[static_cast<std::size_t>(state)];
}

OrderedJson json_of_cell(const Cell& cell) {
    constexpr double exact_below = 9007199254740992.0;   // 2⁵³
    if (const auto* number = std::get_if<double>(&cell)) {
        if (!std::isfinite(*number)) return {};
        if (std::trunc(*number) == *number && std::abs(*number) < exact_below) return static_cast<long long>(*number);
        return *number;
    }
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    return {};
}

OrderedJson json_of_row(const BatchRow& row) {
    OrderedJson json{{"name", row.name}, {"file", row.file}, {"status", name_of(row.state)}};
    if (row.state == BatchRow::State::failed) json["error"] = row.error;
    if (row.report.empty()) return json;
    json["report"] = row.report;
    json["sha256"] = row.sha256;
    for (const BatchFact& fact : batch_facts) json[fact.key] = json_of_cell(row.*fact.cell);
    json["lambda_crit"] = json_of_cell(row.lambda_critical);
    json["defects"] = OrderedJson();
    if (row.defects) {
        json["defects"] = OrderedJson::array();
        for (const auto& [kind, count] : *row.defects) json["defects"].push_back({{"kind", kind}, {"count", json_of_cell(Cell(count))}});
    }
    json["checks"] = {{"passed", row.score.passed}, {"failed", row.score.failed}, {"undecided", row.score.undecided}};
    if (row.worst) {
        json["worst_check"] = {{"id", row.worst->id},
                               {"words", row.worst->words},
                               {"failed", row.worst->failed},
                               {"share_of_limit", json_of_cell(Cell(row.worst->used))}};
    }
    if (row.seconds != Cell()) json["seconds"] = json_of_cell(row.seconds);
    return json;
}

}   // namespace

Table batch_table(const Batch& batch) {
    Table table{.id = "batch", .columns = {{"mesh"}, {"file"}, {"status"}}};
    const auto add = [&](const char* name, const char* unit = "") { table.columns.push_back({name, unit}); };
    for (const BatchFact& fact : batch_facts) add(fact.name);
    add("defects");
    add("λ_crit", "length²");
    for (const char* name : {"checks passed", "checks failed", "checks undecided", "worst check"}) add(name);
    add("worst check", "share of its limit");
    add("report");
    add("error");
    if (batch.timings) add("time", "s");
    for (const BatchRow& row : batch.rows) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{row.name, row.file, name_of(row.state)});
        for (const BatchFact& fact : batch_facts) cells.push_back(row.*fact.cell);
        std::string defects;   // "boundary edges 4, needles 3"
        for (const auto& [kind, count] : row.defects.value_or(BatchRow::Defects()))
            defects += (defects.empty() ? "" : ", ") + kind + " " + plain_text(count, 10);
        cells.push_back(row.defects ? Cell(defects) : Cell());
        cells.push_back(row.lambda_critical);
        for (const std::size_t count : {row.score.passed, row.score.failed, row.score.undecided})
            cells.push_back(row.report.empty() ? Cell() : Cell(double(count)));
        cells.push_back(row.worst ? Cell(row.worst->id) : Cell());
        cells.push_back(row.worst ? Cell(row.worst->used) : Cell());
        for (const std::string& text : {row.report, row.error}) cells.push_back(text.empty() ? Cell() : Cell(text));
        if (batch.timings) cells.push_back(row.seconds);
    }
    return table;
}

std::string write_batch_json(const Batch& batch, const std::string& version) {
    constexpr int batch_version = 1;   // raised when readers of the earlier version would misread a file
    OrderedJson meshes = OrderedJson::array();
    for (const BatchRow& row : batch.rows) meshes.push_back(json_of_row(row));
    OrderedJson units{{"lambda_crit", "length²"}};
    if (batch.timings) units["seconds"] = "s";
    const OrderedJson json{
        {"schema_version", batch_version}, {"program", "meshfolio"}, {"version", version}, {"units", units}, {"meshes", meshes}};
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}   // namespace meshfolio::report
