// Which row of the requirements is answered where.
#include <algorithm>
#include <array>
#include <map>

#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

struct RequiredRow {
    int row;
    std::string_view asked;
    std::string_view section;   // the one that answers it, too; empty: experiments alone
    std::string_view remark;
};

constexpr std::array required_rows{
    RequiredRow{7, "Uniform Laplacian and H = ½‖Δx‖", "q1", ""},
    RequiredRow{8, "Sign of H against the normal", "q1", "S0's words contradict its own formula where normals point outwards"},
    RequiredRow{9, "K from the angle deficit, the area named", "q1", ""},
    RequiredRow{10, "Pictures of H and K on the meshes of the reports", "q1",
                "the dragon is not to be had: a stand-in takes its place in the experiments"},
    RequiredRow{11, "Are they good approximations; what happens at the boundary", "q1", ""},
    RequiredRow{12, "Fundamental forms; normal curvature at (a, 0, 0) over the angle", "q2", ""},
    RequiredRow{13, "Cotangent H beside uniform H and K", "q3", ""},
    RequiredRow{14, "Cotangents averaged over n opposite vertices", "operators", ""},
    RequiredRow{15, "Negative cotangent weights clamped to 0", "operators", ""},
    RequiredRow{16, "Symmetric eigenproblem and projection in the inner product of M", "q4", ""},
    RequiredRow{17, "Weights over Aᵢ + Aⱼ, positive ones only, plain projection", "operators", ""},
    RequiredRow{18, "Reconstructions from few and many eigenvectors", "q4", ""},
    RequiredRow{19, "Explicit smoothing of simple and complex meshes; good and too large λ", "q5", ""},
    RequiredRow{20, "S0: bunny, cube and cow, explicit, λ rising", "stability", ""},
    RequiredRow{21, "S1: 100 explicit steps, λ rising, coloured by K; the largest usable λ", "stability", ""},
    RequiredRow{22, "S2: λ = 1.5 for 10 steps; 0.05 and 0.005 for 100 to 1500", "", ""},
    RequiredRow{23, "S3: plane and fandisk, explicit λ sweep and distortion", "", ""},
    RequiredRow{24, "Implicit smoothing, several λ and iterations, against explicit", "q6", ""},
    RequiredRow{25, "S0: bunny, cube and cow, implicit", "", ""},
    RequiredRow{26, "S1: implicit with the parameters of explicit, coloured by K; a very large λ", "", ""},
    RequiredRow{27, "S2: λ = 5e-8 for 50 to 5000 implicit steps", "", ""},
    RequiredRow{28, "S3: implicit sweeps of λ and iterations; λ = 5 is stable", "", ""},
    RequiredRow{29, "S0: error over iterations and its minimum for three levels of noise", "q7", ""},
    RequiredRow{30, "S1: noise of level 1 along the box, 0 to 200 iterations", "", ""},
    RequiredRow{31, "S1: benchmark A, λ rising and noise rising", "", ""},
    RequiredRow{32, "S1: benchmark B, noise of level 20 and a very large λ", "", ""},
    RequiredRow{33, "S2: noisy and denoised pairs, long runs, explicit beside implicit", "", ""},
    RequiredRow{34, "S3: explicit above implicit for each σ; uniform against cotangent", "", ""},
};
static_assert(required_rows.front().row == limits::first_row && required_rows.back().row == limits::last_row);

bool reproduces(const Experiment& experiment, int row) {
    return std::find(experiment.rows.begin(), experiment.rows.end(), row) != experiment.rows.end();
}

/// "S0 (1), S1 (2)": the reports with experiments on a row, and how many.
std::string reports_on(const std::vector<Experiment>& experiments, int row) {
    std::map<std::string, int> counts;
    for (const Experiment& experiment : experiments) {
        if (reproduces(experiment, row)) ++counts[experiment.from];
    }
    std::string words;
    for (const auto& [from, count] : counts) words += (words.empty() ? "" : ", ") + from + " (" + std::to_string(count) + ")";
    return words;
}

report::Cell cell(std::string_view words) { return words.empty() ? report::Cell{} : report::Cell{std::string(words)}; }

/// "Q4" for a question, the title of another section.
std::string section_words(std::string_view id) {
    if (id.empty()) return "";
    const bool numbered = id.size() == 2 && id[0] == 'q';
    return numbered ? "Q" + std::string(id.substr(1)) : chapter_of_id(id).title();
}

}   // namespace

report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& here) {
    report::Table table;
    table.id = "reproductions_coverage";
    table.caption =
        "What the assignment and the four earlier reports show, row by row, and where it is done again: experiments in the bundled "
        "settings, those of them or of the settings given that ran here (as many as in brackets), and the section that answers it besides. "
        "A row with – under both here and section is not answered in this report.";
    table.columns = {{"row", "", 3}, {"what"}, {"experiments of"}, {"here"}, {"section"}, {"remark"}};
    for (const RequiredRow& required : required_rows) {
        table.rows.push_back({double(required.row), std::string(required.asked), cell(reports_on(bundled, required.row)),
                              cell(reports_on(here, required.row)), cell(section_words(required.section)), cell(required.remark)});
    }
    return table;
}

std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments) {
    std::vector<int> rows;
    for (const RequiredRow& required : required_rows) {
        const bool by_experiment =
            std::any_of(experiments.begin(), experiments.end(), [&](const Experiment& e) { return reproduces(e, required.row); });
        if (!by_experiment && required.section.empty()) rows.push_back(required.row);
    }
    return rows;
}

}   // namespace meshfolio::reproductions
