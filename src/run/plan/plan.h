/// @file
/// The cost of a report, and the settings scaled down so that it ends in the time that is asked for or promised. Nothing here depends on
/// the machine: times are for two cores like those of the cost models (questions/core/cost.h).
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/available_memory.h"
#include "questions/core/chapter.h"
#include "questions/core/mesh_library.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

inline constexpr int cores = 2;             // that a time is promised for
inline constexpr double busy_share = 0.8;   // of the cores, over a whole report
inline constexpr double megabyte = 1e6;     // [bytes]
inline constexpr double base_memory = 60;   // of the program itself [MB]

struct PlannedMesh {
    std::string file;
    double vertices = 0;   // or half its triangles, where these are more

    /// Of the copy that is worked on. @param most  0: the mesh itself
    double within(int most) const { return most > 0 ? std::min<double>(vertices, most) : vertices; }
};

struct PlannedSection {
    const Chapter* chapter;
    std::vector<PlannedMesh> meshes;
    double work_full = 1, work_small = 1;   // ChapterCost::work_of()
    std::size_t rung = 0;                   // of its ladder, from the top

    Effort effort() const;         // with its cost
    double memory() const;         // beyond the meshes [bytes]
    double largest_mesh() const;   // vertices; 0: none
    bool works_on_copies() const;
};

struct Plan {
    std::vector<PlannedSection> sections;   // those asked for
    std::map<std::string, Effort> others;   // of the whole report, of which these are a part; without their costs
    std::vector<PlannedMesh> meshes;        // each once
    bool printed = false;                   // a PDF may be made
    double time = 0;                        // asked for or promised [s]

    double rest_cpu() const;                         // beside the sections [s]
    double cpu_seconds() const;                      // of everything
    double seconds() const;                          // on two cores
    double memory(int at_a_time = cores) const;      // at the peak, so many sections being worked on [bytes]
    std::map<std::string, Effort> efforts() const;   // of the others as well: parts of a report say the same
};

/// What is asked for has the time for itself (alone); or is done as in the whole report, to which it may be added. What the whole one
/// leaves out is done nevertheless, where `only` names it; not in a part, which is joined to the bytes of the whole one.
enum class Scope { alone, report, part };

/// Seconds on two cores that a report of so many triangles is promised in.
double promised_seconds(double triangles, bool quick);

/// From the most that a section may do, one step at a time: the one that saves most, half as gladly where a question is answered, until
/// the time is kept. The steps do not depend on the time, so that more of it never gives less. Questions are always answered.
Plan plan_of(const ReportSettings& settings, const MeshLibrary& meshes, Scope scope);
/// The same of meshes of these sizes, each given to every section. For tests, and to say what would fit.
Plan plan_for(const ReportSettings& settings, const std::vector<PlannedMesh>& meshes);

/// For people: a line for each section, then the total.
std::string text_of(const Plan& plan);
/// For programs; "alone" is what a report of that section only takes.
std::string json_of(const Plan& plan);

/// @throws InputError if the report needs more memory than is available, saying what would fit
void require_memory(const Plan& plan, const ReportSettings& settings, const AvailableMemory& available);

}   // namespace meshfolio::run
