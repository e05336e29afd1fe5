/// @file
/// The defects of meshes, with the questions they affect and their repairs, for `inspect` and the preflight of the report.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/measures/mesh_facts.h"

namespace meshfolio {

struct Defect {
    std::string_view key;         // "needle_faces", for programs
    std::string_view questions;   // affected: "q3,q4,q5"
    int (*count)(const MeshFacts& facts);

    std::string name() const;     // "needle faces, smallest angle below 1°"
    std::string breaks() const;   // the consequence, as a sentence
    std::string done() const;     // the repair, as a sentence
};

/// Returns all defects that are searched for; repaired ones first.
std::span<const Defect> defect_list();

struct FoundDefect {
    const Defect* defect;
    int count;   // at least 1
};
/// Returns the defects with a count above 0, in the order of defect_list().
std::vector<FoundDefect> defects_of(const MeshFacts& facts);

/// Returns the ids of the affected questions: {"q3", "q4"}.
std::vector<std::string> affected_questions(const Defect& defect);
/// Returns the affected questions as text: "Q3, Q4".
std::string affected_for_people(const Defect& defect);

}   // namespace meshfolio
