#include "run/plan/cost_models.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meshfolio::run {

namespace {

// A SectionModel a row. Its last four, each {fixed, linear, growing}: from runs of each section on meshes of 2,000 to 25,000 vertices
// (small settings of q1, q3 and the preflight to 97,000, of q6 to 173,000), rounded. What took more than five seconds there is carried on
// from smaller meshes: q3 and modes in full settings are estimates. tests/bench/fit_costs.py prints better ones.
constexpr std::array models_of_sections{
    SectionModel{"q1", "bumpy_cube lilium sphere plane", {1.7, 2}, {1.5, 0.5, 0.8}, {40, 42}, {10, 42}},
    SectionModel{"q2", "", {0.15, 0}, {0.04, 0}, {9, 0}, {1, 0}},
    SectionModel{"q3", "lilium plane", {1.6, 1, 2.6}, {1.5, 0, 2.6}, {40, 42}, {9, 42}},
    SectionModel{"q4", "armadillo", {1.8, 22, 10}, {0.3, 7.6}, {42, 1000, 230}, {6, 430}},
    SectionModel{"q5", "cube plane_ns fandisk_ns", {0.3, 24, 0}, {0.05, 17.8}, {13, 250}, {6, 180}},
    SectionModel{"q6", "cube plane_ns fandisk_ns", {0.05, 25, 30}, {0.2, 8, 14}, {16, 300}, {6, 250}},
    SectionModel{"q7", "cube fandisk armadillo", {0.2, 50, 20}, {0.3, 9, 8.5}, {14, 250}, {10, 250}},
    SectionModel{"truth", "", {3.4, 0}, {0.9, 0}, {3, 0}, {2, 0}},
    SectionModel{"stability", "cube plane_ns fandisk_ns armadillo", {0.2, 22, 75}, {0.17, 10, 45}, {18, 350}, {3, 175}},
    SectionModel{"modes", "cube plane_ns lilium", {0.2, 32, 40}, {0.15, 14}, {12, 400}, {3, 230}},
    SectionModel{"methods", "cube armadillo", {0.9, 0.2}, {0.05, 0.2}, {7, 25}, {4, 5}},
    SectionModel{"operators", "armadillo lilium fandisk_ns", {0.45, 0, 34}, {0.2, 3.5}, {7, 180}, {4, 25}},
    SectionModel{"certificates",
                 "plane lilium armadillo plane_ns fandisk_ns cube cube8 sphere ellipsoid torus bumpy_cube saddle fandisk",
                 {0.6, 0, 12},
                 {0.5, 3.2},
                 {2, 125},
                 {3, 55},
                 {0, 1.2}},
    SectionModel{"reproductions", "armadillo", {0.8, 40}, {0.2, 22}, {36, 125}, {10, 75}},
    SectionModel{"claims", "armadillo", {1.5, 0.2}, {0.3, 0.2}, {7, 6}, {1, 6}},
};

/// By default, in full and in small settings: the eigenvectors of q4, else the iterations; and how many steps and levels of noise.
struct Defaults {
    std::string_view id;
    double steps[2], values[2];
};
constexpr Defaults defaults[] = {{"q4", {300, 60}, {1, 1}}, {"q5", {50, 20}, {1, 1}}, {"q6", {100, 10}, {3, 3}}, {"q7", {32, 16}, {20, 6}}};

}   // namespace

double CostModel::per_mesh(double vertices, double work) const {
    const double x = vertices / 1e5;
    return work * (linear * x + growing * x * std::sqrt(x));
}

std::span<const SectionModel> section_models() { return models_of_sections; }

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
