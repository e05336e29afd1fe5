// Which row of the requirements is answered where.
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

/// What it asks is the message "row.<row>".
struct RequiredRow {
    int row;
    std::string_view section;   // the one that answers it, too; empty: experiments alone
    bool remarked = false;      // by "row.<row>.remark"

    std::string key() const { return "row." + std::to_string(row); }
};

constexpr std::array required_rows{
    RequiredRow{7, "q1"},         RequiredRow{8, "q1", true},   RequiredRow{9, "q1"},         RequiredRow{10, "q1", true},
    RequiredRow{11, "q1"},        RequiredRow{12, "q2"},        RequiredRow{13, "q3"},        RequiredRow{14, "operators"},
    RequiredRow{15, "operators"}, RequiredRow{16, "q4"},        RequiredRow{17, "operators"}, RequiredRow{18, "q4"},
    RequiredRow{19, "q5"},        RequiredRow{20, "stability"}, RequiredRow{21, "stability"}, RequiredRow{22, ""},
    RequiredRow{23, ""},          RequiredRow{24, "q6"},        RequiredRow{25, ""},          RequiredRow{26, ""},
    RequiredRow{27, ""},          RequiredRow{28, ""},          RequiredRow{29, "q7"},        RequiredRow{30, ""},
    RequiredRow{31, ""},          RequiredRow{32, ""},          RequiredRow{33, ""},          RequiredRow{34, ""}};
static_assert(required_rows.front().row == limits::first_row && required_rows.back().row == limits::last_row);

bool reproduces(const Experiment& experiment, int row) { return std::ranges::find(experiment.rows, row) != experiment.rows.end(); }

/// "S0 (1), S1 (2)": the reports with experiments on a row, and how many.
std::string reports_on(const std::vector<Experiment>& experiments, int row) {
    std::map<std::string, int> counts;
    for (const Experiment& experiment : experiments)
        if (reproduces(experiment, row)) ++counts[experiment.from];
    Names reports;
    for (const auto& [from, count] : counts) reports.push_back(from + " (" + std::to_string(count) + ")");
    return joined(reports, ", ");
}

report::Cell cell_if_said(const std::string& said) { return said.empty() ? report::Cell() : report::Cell(said); }

/// "Q4" for a question, the title of another section.
std::string section_name(std::string_view id) {
    if (id.empty()) return "";
    return report::is_question(id) ? "Q" + std::string(id.substr(1)) : chapter_of_id(id).title();
}

}   // namespace

report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& here) {
    const auto reports_of = [](const std::vector<Experiment>& experiments) {
        return [&experiments](const RequiredRow& row) { return cell_if_said(reports_on(experiments, row.row)); };
    };
    return table("reproductions_coverage", words.line("coverage"), required_rows)
        .column("row", &RequiredRow::row)
        .column("what", [](const RequiredRow& row) { return words.line(row.key()); })
        .column("experiments of", reports_of(bundled))
        .column("here", reports_of(here))
        .column("section", [](const RequiredRow& row) { return cell_if_said(section_name(row.section)); })
        .column("remark", [](auto& row) { return row.remarked ? report::Cell(words.line(row.key() + ".remark")) : report::Cell(); });
}

std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments) {
    std::vector<int> rows;
    for (const RequiredRow& required : required_rows) {
        const bool by_experiment = std::ranges::any_of(experiments, [&](const Experiment& e) { return reproduces(e, required.row); });
        if (!by_experiment && required.section.empty()) rows.push_back(required.row);
    }
    return rows;
}

}   // namespace meshfolio::reproductions
