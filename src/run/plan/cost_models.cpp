#include "run/plan/cost_models.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meshfolio::run {

namespace {

// The last four of each row are printed by tests/bench/fit_costs.py.
constexpr std::array models{
    SectionModel{"q1", "bumpy_cube lilium sphere plane", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"q2", "", {1, 0}, {1, 0}, {10, 0}, {10, 0}},
    SectionModel{"q3", "lilium plane", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"q4", "armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"q5", "cube plane_ns fandisk_ns", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"q6", "cube plane_ns fandisk_ns", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"q7", "cube fandisk armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"truth", "", {1, 0}, {1, 0}, {10, 0}, {10, 0}},
    SectionModel{"stability", "cube plane_ns fandisk_ns armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"maps", "cube plane_ns", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"modes", "cube plane_ns", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"prediction", "cube lilium", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"methods", "cube armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"operators", "armadillo lilium fandisk_ns", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"reproductions", "armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"claims", "armadillo", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"certificates", "armadillo cube bumpy_cube fandisk lilium", {1, 1}, {1, 1}, {10, 100}, {10, 100}},
    SectionModel{"preflight",
                 "plane lilium armadillo plane_ns fandisk_ns cube cube8 sphere ellipsoid torus bumpy_cube saddle fandisk",
                 {1, 1},
                 {1, 1},
                 {10, 100},
                 {10, 100}},
};

/// By default, in full and in small settings: the eigenvectors of q4, else the iterations; and how many steps and levels of noise.
struct Defaults {
    std::string_view id;
    double steps[2], values[2];
};
constexpr Defaults defaults[] = {{"q4", {300, 60}, {1, 1}}, {"q5", {50, 20}, {1, 1}}, {"q6", {100, 10}, {3, 3}}, {"q7", {48, 16}, {25, 6}}};

}   // namespace

double CostModel::per_mesh(double vertices, double work) const {
    const double x = vertices / 1e5;
    return work * (linear * x + growing * x * std::sqrt(x));
}

std::span<const SectionModel> section_models() { return models; }

double work_of(std::string_view id, const QuestionTable& table, bool small) {
    const auto found = std::ranges::find(defaults, id, &Defaults::id);
    if (found == std::end(defaults)) return 1;
    const auto& steps = id == "q4" ? table.k : table.iterations;
    const auto count = [](const auto& list) { return static_cast<double>(std::max<std::size_t>(list.size(), 1)); };
    double work = 1;
    if (!steps.empty()) work *= *std::ranges::max_element(steps) / found->steps[small];
    if (!table.lambda.empty() || !table.noise.empty()) work *= count(table.lambda) * count(table.noise) / found->values[small];
    return work;
}

}   // namespace meshfolio::run
