#include "questions/bench/defects.h"

#include "report/words.h"

namespace meshfolio {

namespace {

constexpr report::Words defect_words("defects");

/// Farther from the origin, more than three of the sixteen digits of a coordinate only say where the mesh is [box diagonals].
constexpr double far_away = 1000;
/// Rounding of this size is a thousandth of 1/h in H [shortest edges].
constexpr double coarse = 1e-3;
/// Other programs often assume areas, and their inverses, of boxes within these sizes.
constexpr double smallest_usual = 1e-6, largest_usual = 1e6;   // [length]

constexpr std::array<Defect, 16> defects{{
    {"dropped_degenerate_faces", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.dropped_degenerate_faces; }},
    {"dropped_duplicate_faces", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.dropped_duplicate_faces; }},
    {"flipped_faces", "q1,q3,q7", [](const MeshFacts& f) { return f.counts.flipped_faces; }},
    {"inside_out_components", "q1,q3,q5,q6", [](const MeshFacts& f) { return f.counts.inside_out_components; }},
    {"not_orientable", "q1,q3,q7", [](const MeshFacts& f) { return f.counts.orientable ? 0 : 1; }},
    {"unreferenced_vertices", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.unreferenced_vertices; }},
    {"nonmanifold_edges", "q1,q3,q4,q5,q6", [](const MeshFacts& f) { return f.counts.nonmanifold_edges; }},
    {"nonmanifold_vertices", "q1,q3", [](const MeshFacts& f) { return f.counts.nonmanifold_vertices; }},
    {"boundary_loops", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.boundary_loops; }},
    {"further_components", "q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.components - 1; }},
    {"duplicated_positions", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.duplicated_positions; }},
    {"zero_area_faces", "q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.counts.zero_area_faces; }},
    {"needle_faces", "q3,q4,q5,q7", [](const MeshFacts& f) { return f.counts.needle_faces; }},
    {"far_from_origin", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.offset > far_away ? 1 : 0; }},
    {"coarse_coordinates", "q1,q3,q4,q5,q6,q7", [](const MeshFacts& f) { return f.is_rounded() && f.written_steps > coarse ? 1 : 0; }},
    {"unusual_scale", "q3,q4,q5,q6,q7",
     [](const MeshFacts& f) { return f.diagonal < smallest_usual || f.diagonal > largest_usual ? 1 : 0; }},
}};

}   // namespace

std::string Defect::name() const { return defect_words.line(std::string(key)); }
std::string Defect::breaks() const { return defect_words.line(std::string(key) + ".breaks"); }
std::string Defect::done() const { return defect_words.line(std::string(key) + ".done"); }

std::span<const Defect> defect_list() { return defects; }

std::vector<FoundDefect> defects_of(const MeshFacts& facts) {
    std::vector<FoundDefect> found;
    for (const Defect& defect : defects) {
        const int count = defect.count(facts);
        if (count > 0) found.push_back({&defect, count});
    }
    return found;
}

std::vector<std::string> affected_questions(const Defect& defect) {
    std::vector<std::string> ids;
    for (std::size_t at = 0; at < defect.questions.size(); at += 3) ids.emplace_back(defect.questions.substr(at, 2));   // "q1,"
    return ids;
}

std::string affected_for_people(const Defect& defect) {
    std::string list;
    for (const std::string& id : affected_questions(defect)) list += (list.empty() ? "Q" : ", Q") + id.substr(1);
    return list;
}

}   // namespace meshfolio
