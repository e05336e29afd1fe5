/// @file
/// The parts of the preflight.
#pragma once

#include "geometry/measures/mesh_laws.h"
#include "questions/core/section_tools.h"
#include "questions/preflight/defects.h"

namespace meshfolio::preflight {

inline constexpr report::Words words("preflight");

/// One mesh looked over.
struct Inspected : OnMesh {
    MeshFacts facts;

    const Preflight& counts() const { return facts.counts; }
};

/// Where a defect was found, in the order of the meshes.
struct Occurrence {
    const Defect* defect;
    std::string where;   // "plane 1, lily 2"; empty: nowhere
    int meshes = 0;
    double count = 0;   // in all
};
/// Of every defect in the list.
std::vector<Occurrence> occurrences_in(const std::vector<Inspected>& meshes);
/// Those that are somewhere.
std::vector<Occurrence> found_of(std::vector<Occurrence> occurrences);

report::Table connectivity_table(const std::vector<Inspected>& meshes);
report::Table geometry_table(const std::vector<Inspected>& meshes);
report::Table defect_table(const std::vector<Occurrence>& found);
report::Table search_table(const std::vector<Inspected>& meshes, const std::vector<Occurrence>& occurrences);

}   // namespace meshfolio::preflight
