/// @file
/// What each section of a report costs, as a function of what it is given. Fitted by tests/bench/fit_costs.py, whose rows stand in
/// cost_models.cpp; nothing is measured while a report is planned, so that the same input has the same plan.
#pragma once

#include <span>
#include <string_view>

#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// fixed + Σ over the meshes of (linear x + growing x^(3/2)), x in 100,000 vertices: the power is that of a sparse factor.
struct CostModel {
    double fixed, linear, growing = 0;
    double per_mesh(double vertices, double work = 1) const;
};

struct SectionModel {
    std::string_view id;
    std::string_view roles;                // of the meshes it takes where the user names none; empty: it needs no mesh
    CostModel full_cpu, small_cpu;         // [s], figures included
    CostModel full_memory, small_memory;   // [MB], beyond the meshes
    CostModel whole_cpu = {0, 0};          // [s], what it does on the meshes as they are in both, also where it works on copies
};

std::span<const SectionModel> section_models();
/// How much more than by default the [[question]] of a settings file asks for: eigenvectors, iterations, steps, levels of noise.
double work_of(std::string_view id, const QuestionTable& table, bool small);

/// Beside the sections: the program; reading the meshes; making decimated copies; printing.
inline constexpr CostModel base_cpu{0.2, 0}, reading_cpu{0, 0.25}, copies_cpu{0, 2.3}, printing_cpu{8, 0};   // [s]
inline constexpr CostModel base_memory{60, 0}, reading_memory{0, 25}, copies_memory{0, 80};                  // [MB]

inline constexpr int cores = 2;             // those that a time is promised for
inline constexpr double busy_share = 0.8;   // of the cores, over a whole report
inline constexpr double megabyte = 1e6;     // [bytes]

}   // namespace meshfolio::run
