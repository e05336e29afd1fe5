/// @file
/// The cost of a report, and the settings scaled down so that it ends in the time that is asked for or promised. Nothing here depends on
/// the machine: times are for two cores like those of the cost models (questions/core/chapter.h).
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
    double vertices = 0;   // or half the number of triangles if that is larger

    /// Returns the number of vertices of the copy that a section works on. @param most  limit of the copies; 0: none
    double within(int most) const { return most > 0 ? std::min<double>(vertices, most) : vertices; }
};

struct PlannedSection {
    const Chapter* chapter;
    std::vector<PlannedMesh> meshes;
    double work_full = 1, work_small = 1;   // ChapterCost::work_of()
    std::size_t rung = 0;                   // of its ladder, from the top

    Effort effort() const;         // of the rung, with its cost
    double memory() const;         // beyond the meshes [bytes]
    double largest_mesh() const;   // vertices; 0: no mesh
    bool works_on_copies() const;
};

struct Plan {
    std::vector<PlannedSection> sections;   // the sections asked for
    std::map<std::string, Effort> others;   // the other sections of the whole report, without their costs
    std::vector<PlannedMesh> meshes;        // of all sections, each once
    bool printed = false;                   // a PDF may be made
    double time = 0;                        // limit: asked for or promised [s]

    double rest_cpu() const;                         // CPU time of everything but the sections [s]
    double cpu_seconds() const;                      // CPU time of the report [s]
    double seconds() const;                          // wall time on two cores [s]
    double memory(int at_a_time = cores) const;      // peak, with this number of sections at work [bytes]
    std::map<std::string, Effort> efforts() const;   // of all sections of the whole report
};

/// The sections asked for have the time for themselves (alone), or are done as in the whole report. A section that the whole report leaves
/// out is done if `only` names it, except in a part: merged parts equal the whole report.
enum class Scope { alone, report, part };

/// Returns the promised time of a report on two cores [s]: 180 up to 346,000 triangles, then in proportion; quick: 20 up to 100,000, then
/// linear to 60 at a million and on to 180 at 5.5 million.
double promised_seconds(double triangles, bool quick);

/// Plans a report. Every section begins with full settings and whole meshes; until the time is kept, the section that saves most is scaled
/// down one step: small settings, smaller copies, at last left out. Questions are always answered, and their savings count half. The order
/// of steps does not depend on the time, so that a longer time never gives less.
Plan plan_of(const ReportSettings& settings, const MeshLibrary& meshes, Scope scope);
/// Plans a whole report on meshes of these sizes, each given to every section that reads meshes.
Plan plan_for(const ReportSettings& settings, const std::vector<PlannedMesh>& meshes);

/// Returns the plan as text: a line for each section, then the total.
std::string text_of(const Plan& plan);
/// Returns the plan as JSON; "alone" is the cost of a report of one section.
std::string json_of(const Plan& plan);

/// Requires that the report fits into memory.
/// @throws InputError if it needs more than is available, and more than 300 MB; the message names settings or a size that would fit
void require_memory(const Plan& plan, const ReportSettings& settings, const AvailableMemory& available);

}   // namespace meshfolio::run
