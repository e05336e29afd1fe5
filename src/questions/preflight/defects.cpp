#include "questions/preflight/defects.h"

#include <algorithm>
#include <array>

namespace meshfolio::preflight {

namespace {

/// Beyond this many box diagonals from the origin, more than three of the sixteen digits of a coordinate say only where the mesh is.
constexpr double far_away = 1000;
/// Sizes of a box whose areas and their inverses stay within what other programs assume.
constexpr double smallest_usual = 1e-6, largest_usual = 1e6;   // [length]

constexpr std::array<Defect, 16> defects{{
    {"dropped_degenerate_faces", "faces that name a corner twice", "q1,q3,q4,q5,q6,q7", "they have no area, no normal and no angles",
     "dropped", [](const MeshFacts& f) { return f.counts.dropped_degenerate_faces; }},
    {"dropped_duplicate_faces", "repeated faces", "q1,q3,q4,q5,q6,q7",
     "weights and areas would count twice, and their edges would not be manifold", "dropped, the first of each kept",
     [](const MeshFacts& f) { return f.counts.dropped_duplicate_faces; }},
    {"flipped_faces", "faces the wrong way round", "q1,q3,q7", "the sign of H, volume and normal angles around them",
     "turned to agree with the majority of their component", [](const MeshFacts& f) { return f.counts.flipped_faces; }},
    {"inside_out_components", "closed components inside out", "q1,q3,q5,q6", "the sign of H on all of the component, and of its volume",
     "turned as a whole, so that normals point outwards", [](const MeshFacts& f) { return f.counts.inside_out_components; }},
    {"not_orientable", "no consistent orientation", "q1,q3,q7", "H has no sign there, whatever its size", "left as it is; read |H| only",
     [](const MeshFacts& f) { return f.counts.orientable ? 0 : 1; }},
    {"unreferenced_vertices", "vertices no triangle uses", "q1,q3,q4,q5,q6,q7",
     "they have no area: M would be singular, curvature is not defined", "left out of all operators, kept where they are in meshes written",
     [](const MeshFacts& f) { return f.unreferenced_vertices; }},
    {"nonmanifold_edges", "edges of more than two faces", "q1,q3,q4,q5,q6", "curvature and Gauss–Bonnet are not defined there",
     "curvature left empty at their ends; C sums the cotangents of all their faces",
     [](const MeshFacts& f) { return f.counts.nonmanifold_edges; }},
    {"nonmanifold_vertices", "vertices whose faces are no single fan", "q1,q3", "the angle sum mixes sheets: K and H are not defined",
     "curvature left empty", [](const MeshFacts& f) { return f.counts.nonmanifold_vertices; }},
    {"boundary_loops", "boundary loops", "q1,q3,q4,q5,q6,q7",
     "no curvature on the boundary; modes obey Neumann conditions; smoothing pulls the boundary in; no volume",
     "curvature left empty there, volume left empty, the boundary left free", [](const MeshFacts& f) { return f.counts.boundary_loops; }},
    {"further_components", "components beyond the first", "q4,q5,q6,q7", "each has a zero eigenvalue, and shrinks towards its own centre",
     "zero eigenvalues are expected to be as many as components", [](const MeshFacts& f) { return f.counts.components - 1; }},
    {"duplicated_positions", "vertices exactly on an earlier one", "q1,q3,q4,q5,q6,q7",
     "what looks closed may be a seam, where smoothing tears the surface open", "not welded, so that vertex numbers stay those of the file",
     [](const MeshFacts& f) { return f.counts.duplicated_positions; }},
    {"zero_area_faces", "faces without area", "q3,q4,q5,q6,q7", "their cotangents are infinite: no explicit step would be stable",
     "kept, without stiffness or mass; flip their longest edges, or take the intrinsic Delaunay operator",
     [](const MeshFacts& f) { return f.counts.zero_area_faces; }},
    {"needle_faces", "needle faces, smallest angle below 1°", "q3,q4,q5,q7",
     "H is noisy around them, residuals meet rounding, and one of them may set the largest stable step",
     "kept; their effect stands in the checks of residuals and in λ_crit", [](const MeshFacts& f) { return f.counts.needle_faces; }},
    {"far_from_origin", "farther than 1000 box diagonals from the origin", "q1,q3,q4,q5,q6,q7",
     "the file itself holds fewer digits of the shape", "differences are taken about the mesh, so that no further digit is lost",
     [](const MeshFacts& f) { return f.offset > far_away ? 1 : 0; }},
    {"coarse_coordinates", "coordinates coarser than 10⁻⁸ of the shortest edge", "q1,q3,q4,q5,q6,q7",
     "second differences magnify the rounding of the file: expect noise in H and K", "nothing can be; reported",
     [](const MeshFacts& f) { return f.coordinate_rounding > 1e-8 ? 1 : 0; }},
    {"unusual_scale", "box diagonal below 10⁻⁶ or above 10⁶", "q3,q4,q5,q6,q7",
     "raw λ and μ are areas and inverse areas of that size; fixed tolerances would fail",
     "scaled to about 1 inside, results given in the units of the file",
     [](const MeshFacts& f) { return f.diagonal < smallest_usual || f.diagonal > largest_usual ? 1 : 0; }},
}};

}   // namespace

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

}   // namespace meshfolio::preflight
