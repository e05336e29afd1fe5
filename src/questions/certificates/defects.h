/// @file
/// What can be wrong with a mesh, which questions that affects, and what is done about it: the one place where this is written down.
/// `inspect` and the preflight of the report both read it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/measures/mesh_facts.h"

namespace meshfolio::certificates {

struct Defect {
    std::string_view key;         // "needle_faces", for programs
    std::string_view questions;   // "q3,q4,q5": those whose answers it touches
    int (*count)(const MeshFacts& facts);

    std::string name() const;     // "needle faces, smallest angle below 1°"
    std::string breaks() const;   // what goes wrong there
    std::string done() const;     // what was done about it
};

/// All that is looked for; repairs first.
std::span<const Defect> defect_list();

struct FoundDefect {
    const Defect* defect;
    int count;   // at least 1
};
/// Returns the defects that occur, in the order of the list.
std::vector<FoundDefect> defects_of(const MeshFacts& facts);

/// {"q3", "q4"} and "Q3, Q4".
std::vector<std::string> affected_questions(const Defect& defect);
std::string affected_for_people(const Defect& defect);

}   // namespace meshfolio::certificates
