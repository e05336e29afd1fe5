/// @file
/// The cost of a chapter as a function of its meshes. Nothing is measured while a report is planned, so that the same input has the same
/// plan.
#pragma once

#include <cmath>
#include <vector>

#include "questions/core/settings.h"

namespace meshfolio {

/// fixed + Σ over the meshes of (linear x + growing x^(3/2)), x in 100,000 vertices: the power is that of a sparse factor.
struct CostModel {
    double fixed, linear, growing = 0;

    /// Returns the share of one mesh. @param work  factor on it
    double per_mesh(double vertices, double work = 1) const {
        const double x = vertices / 1e5;
        return work * (linear * x + growing * x * std::sqrt(x));
    }
};

/// A full setting and the small one of --quick.
struct FullAndSmall {
    CostModel full, small;
};

/// The cost of a chapter, figures included. tests/bench/fit_costs.py measures meshes of 2,000 to 30,000 vertices and prints the rows.
struct ChapterCost {
    FullAndSmall cpu;               // [s]
    FullAndSmall memory;            // [MB], beyond the meshes
    CostModel whole_cpu = {0, 0};   // [s], of work on the whole meshes where the rest works on decimated copies
    /// Default length of a run and default number of runs, full and small. A [[question]] of a settings file that asks for more costs more.
    std::vector<int> QuestionSettings::*lengths = nullptr;
    double length[2] = {1, 1}, runs[2] = {1, 1};

    /// Returns the work that the settings ask for, over that of the defaults.
    double work_of(const QuestionSettings& settings, bool small) const;
};

}   // namespace meshfolio
