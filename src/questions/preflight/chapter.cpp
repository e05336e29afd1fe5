// Preflight: what each mesh of the report is, what is wrong with it, which questions that affects and what was done.
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/bench/law_checks.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/preflight/defects.h"

namespace meshfolio::preflight {

namespace {

using report::check_at_most;
using report::check_near;
using report::ref;

/// One mesh looked over.
struct Inspected {
    std::shared_ptr<const LibraryMesh> source;
    MeshFacts facts;
    std::vector<FoundDefect> defects;

    const std::string& name() const { return source->name; }
    const Preflight& counts() const { return facts.counts; }
    bool gauss_bonnet_holds() const { return facts.gauss_bonnet_residual <= gauss_bonnet_tolerance(counts().triangles); }
};

// ---- the meshes -------------------------------------------------------------------------------------------------------

/// The meshes of the settings, else the user's own, else one a role; each once. One that cannot be read is told and left out: the
/// question that needs it fails by itself.
LibraryMeshes meshes_of_report(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    if (!settings.meshes.empty() || library.has_own_meshes()) return meshes_for(library, settings, {}, section);
    LibraryMeshes meshes;
    std::set<std::string> seen;
    for (const MeshRole& role : mesh_role_list()) {
        try {
            const auto mesh = library.role(std::string(role.role));
            if (!seen.insert(mesh->input.file + mesh->input.sha256).second) continue;
            enter_input(*mesh, section);
            meshes.push_back(mesh);
        } catch (const InputError& error) {
            section.warnings.push_back(error.what());
            section.checks.push_back(check_near("the mesh of role " + std::string(role.role) + " can be used", 1, 0, 0, error.what()));
        }
    }
    return meshes;
}

// ---- results ----------------------------------------------------------------------------------------------------------

std::string orientation_words(const Preflight& p) {
    if (!p.orientable) return "none";
    std::string words = "consistent";
    if (p.flipped_faces > 0) words += ", " + counted(p.flipped_faces, "face") + " turned";
    if (p.inside_out_components > 0) words += ", " + counted(p.inside_out_components, "component") + " turned outwards";
    return words;
}

void add_connectivity_table(report::Section& section, const std::vector<Inspected>& meshes) {
    report::Table table;
    table.id = "preflight_connectivity";
    table.caption =
        "What is connected to what. V: vertices in use; χ = V − edges + triangles; the genus is that of one orientable manifold component.";
    table.columns = {{"mesh", "", 3},           {"V", "", 8}, {"edges", "", 8}, {"triangles", "", 8}, {"components", "", 8},
                     {"boundary loops", "", 8}, {"χ", "", 8}, {"genus", "", 8}, {"manifold", "", 3},  {"orientation", "", 3}};
    for (const Inspected& mesh : meshes) {
        const Preflight& p = mesh.counts();
        table.rows.push_back({mesh.name(), double(p.vertices_in_use), double(p.edges), double(p.triangles), double(p.components),
                              double(p.boundary_loops), double(p.euler_characteristic), cell_of(p.genus, p.genus >= 0),
                              std::string(p.manifold() ? "yes" : "no"), orientation_words(p)});
    }
    section.blocks.push_back(std::move(table));
}

void add_geometry_table(report::Section& section, const std::vector<Inspected>& meshes) {
    report::Table table;
    table.id = "preflight_geometry";
    table.caption =
        "Size, place and shape. Offset: the box centre from the origin, in box diagonals. Gauss–Bonnet: |Σ deficits / 2π − χ|, – "
        "where the mesh is not manifold. No volume (–): the mesh is open.";
    table.columns = {{"mesh", "", 3},
                     {"box diagonal", "length", 4},
                     {"offset", "diagonals", 2},
                     {"shortest edge", "length", 3},
                     {"mean edge", "length", 3},
                     {"longest edge", "length", 3},
                     {"smallest angle", "°", 3},
                     {"area", "length²", 4},
                     {"volume", "length³", 4},
                     {"Gauss–Bonnet", "", 2}};
    for (const Inspected& mesh : meshes) {
        const Preflight& p = mesh.counts();
        table.rows.push_back({mesh.name(), mesh.facts.diagonal, mesh.facts.offset, mesh.facts.shortest_edge, p.mean_edge,
                              mesh.facts.longest_edge, mesh.facts.smallest_angle * 180 / M_PI, p.area, cell_of(p.volume, p.closed()),
                              cell_of(mesh.facts.gauss_bonnet_residual, p.manifold())});
    }
    section.blocks.push_back(std::move(table));
}

/// Where a defect was found, in the order of the meshes: "plane 1, lily 2".
struct Occurrence {
    std::string where;
    int meshes = 0;
    double count = 0;
};
Occurrence occurrence_of(const Defect& defect, const std::vector<Inspected>& meshes) {
    Occurrence all;
    for (const Inspected& mesh : meshes) {
        const int count = defect.count(mesh.facts);
        if (count <= 0) continue;
        all.where += (all.meshes++ == 0 ? "" : ", ") + mesh.name() + " " + std::to_string(count);
        all.count += count;
    }
    return all;
}

int kinds_found(const std::vector<Inspected>& meshes) {
    return static_cast<int>(std::count_if(defect_list().begin(), defect_list().end(),
                                          [&](const Defect& defect) { return occurrence_of(defect, meshes).meshes > 0; }));
}

void add_defect_table(report::Section& section, const std::vector<Inspected>& meshes) {
    if (kinds_found(meshes) == 0) return;
    report::Table table;
    table.id = "preflight_defects";
    table.caption = "What departs from one closed, well-shaped surface, what it affects and what was done about it.";
    table.columns = {{"found"}, {"count", "", 8}, {"where"}, {"affects"}, {"what it breaks"}, {"what was done"}};
    for (const Defect& defect : defect_list()) {
        const Occurrence found = occurrence_of(defect, meshes);
        if (found.meshes == 0) continue;
        table.rows.push_back({std::string(defect.name), found.count, found.where, affected_for_people(defect), std::string(defect.breaks),
                              std::string(defect.done)});
    }
    section.blocks.push_back(std::move(table));
}

void add_search_table(report::Section& section, const std::vector<Inspected>& meshes) {
    report::Table table;
    table.id = "preflight_looked_for";
    table.caption = "All that was looked for, in " + counted(static_cast<int>(meshes.size()), "mesh", "meshes") + ".";
    table.columns = {{"looked for", "", 3}, {"affects", "", 3}, {"meshes with it", "", 8}, {"count in all", "", 10}};
    for (const Defect& defect : defect_list()) {
        const Occurrence found = occurrence_of(defect, meshes);
        table.rows.push_back({std::string(defect.name), affected_for_people(defect), double(found.meshes), found.count});
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const Inspected& mesh) {
    const std::string on = " on " + mesh.name();
    const PreparedMesh& prepared = *mesh.source->prepared;
    const Preflight& p = mesh.counts();
    if (p.manifold()) {
        section.checks.push_back(
            check_at_most(law::gauss_bonnet.name(on), gauss_bonnet_tolerance(p.triangles), mesh.facts.gauss_bonnet_residual));
    }
    if (p.manifold() && p.orientable)
        section.checks.push_back(check_near(law::half_edges.name(on), 0, repeated_half_edges(prepared.mesh.F), 0));
    constexpr double larger = 0x1p20, smaller = 0x1p-20;
    section.checks.push_back(
        check_at_most("place and size: change of C, areas, H and K, moved by 2²⁰ box diagonals and scaled by 2±²⁰" + on, 1e-12,
                      std::max(change_when_moved(prepared, larger), change_when_moved(prepared, smaller)), 0,
                      "relative to the largest; both meshes have the rounded coordinates of the moved one"));
}

// ---- words ------------------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section,
        "Before anything is computed each mesh is read strictly, freed of faces that name a corner twice and of repeated ones, "
        "and oriented: each component agrees with its majority, closed ones with normals outwards. Vertices keep the numbers they "
        "have in the file. All else is counted and left as it is.");
    add_formula(section, "gauss_bonnet", "preflight_eq_gauss_bonnet");
    add_paragraph(section,
                  "Meshes are centred and scaled inside: formulas see differences of positions, lengths times a power of two that "
                  "makes the box about 1, and areas that sum to 1 in eigenproblems; results are given in the units of the file. The checks "
                  "move every mesh far away, at another scale, and compare.");
}

/// What was found and is still there, open boundaries and further components apart: "needle faces (lily 2)".
std::vector<std::string> kept_defects(const std::vector<Inspected>& meshes) {
    const std::set<std::string_view> told_elsewhere = {"dropped_degenerate_faces", "dropped_duplicate_faces", "flipped_faces",
                                                       "inside_out_components",    "boundary_loops",          "further_components"};
    std::vector<std::string> kept;
    for (const Defect& defect : defect_list()) {
        const Occurrence found = occurrence_of(defect, meshes);
        if (found.meshes > 0 && told_elsewhere.count(defect.key) == 0) kept.push_back(std::string(defect.name) + " (" + found.where + ")");
    }
    return kept;
}

constexpr double thin_below = 10;   // [°]

/// The mesh with the smallest angle, and those that say something about λ or noise.
void add_discussion(report::Section& section, const std::vector<Inspected>& meshes) {
    add_heading(section, "Discussion");
    std::vector<std::string> clean, repaired, open;
    for (const Inspected& mesh : meshes) {
        const Preflight& p = mesh.counts();
        if (mesh.defects.empty()) clean.push_back(mesh.name());
        const bool changed = p.dropped_degenerate_faces + p.dropped_duplicate_faces + p.flipped_faces + p.inside_out_components > 0;
        if (changed) repaired.push_back(mesh.name());
        if (!p.closed()) open.push_back(mesh.name());
    }
    report::Text text;
    if (!clean.empty()) report::extend(text, "Nothing was found on ", listed(clean), ". ");
    if (!repaired.empty())
        report::extend(text, "Triangles were dropped or turned on ", listed(repaired), "; all others are as in their files. ");
    if (repaired.empty()) report::extend(text, "No triangle of any mesh had to be dropped or turned. ");
    if (!open.empty()) report::extend(text, "Open, so without curvature on the boundary and without volume: ", listed(open), ".");
    section.blocks.push_back(report::Paragraph{std::move(text)});
    const std::vector<std::string> kept = kept_defects(meshes);
    if (!kept.empty())
        add_paragraph(section, "Found and left as it is: ", listed(kept), "; ", ref("preflight_defects"), " says what each may break.");

    const auto worst = std::min_element(meshes.begin(), meshes.end(), [](const Inspected& a, const Inspected& b) {
        return a.facts.smallest_angle < b.facts.smallest_angle;
    });
    const double degrees = worst->facts.smallest_angle * 180 / M_PI;
    const double stretch = worst->facts.longest_edge / worst->facts.shortest_edge;
    add_paragraph(section, "The smallest angle of all is ", readable(degrees), "° on ", worst->name(), ", where the longest edge is ",
                  readable(stretch), " times the shortest",
                  degrees < thin_below ? ": triangles as thin as that make explicit steps small and residuals large."
                                       : "; no triangle is thin, that is, has an angle below " + readable(thin_below, 2) + "°.");
}

void add_findings(report::Section& section, const std::vector<Inspected>& meshes) {
    int manifold = 0, exact = 0;
    for (const Inspected& mesh : meshes) {
        if (!mesh.counts().manifold()) continue;
        ++manifold;
        exact += mesh.gauss_bonnet_holds() ? 1 : 0;
    }
    const std::string holds = manifold == 0 ? "none of them is manifold"
                                            : "Gauss–Bonnet holds to rounding on " + std::to_string(exact) + " of " +
                                                  counted(manifold, "manifold mesh", "manifold meshes");
    section.findings.push_back(
        {report::text("Preflight of ", counted(static_cast<int>(meshes.size()), "mesh", "meshes"), ": ", holds, ", ",
                      kinds_found(meshes) == 0 ? std::string("nothing was found that breaks an answer")
                                               : counted(kinds_found(meshes), "kind of finding, with what it affects",
                                                         "kinds of finding, each with what it affects"),
                      "."),
         5});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("preflight");
    std::vector<Inspected> meshes;
    for (const auto& source : meshes_of_report(library, settings, section)) {
        progress("preflight of " + source->name);
        Inspected mesh{source, mesh_facts(*source->prepared), {}};
        mesh.defects = defects_of(mesh.facts);
        meshes.push_back(std::move(mesh));
    }
    if (meshes.empty()) throw InputError({}, "no mesh can be used", "see the warnings");
    add_method(section);
    add_heading(section, "Results");
    add_connectivity_table(section, meshes);
    add_geometry_table(section, meshes);
    add_defect_table(section, meshes);
    add_search_table(section, meshes);
    for (const Inspected& mesh : meshes) add_checks(section, mesh);
    add_discussion(section, meshes);
    add_findings(section, meshes);
    section.extent = counted(static_cast<int>(meshes.size()), "mesh", "meshes") + ", " + std::to_string(defect_list().size()) +
                     " kinds of defect looked for, with what each affects and what was done";
    return answer;
}

extern const Chapter chapter{
    .id = "preflight",
    .code = {{"prepare_mesh", "src/mesh/mesh_checks.cpp"},
             {"consistent_orientation", "src/mesh/orientation.cpp"},
             {"defect_list", "src/questions/preflight/defects.cpp"},
             {"change_when_moved", "src/geometry/measures/mesh_facts.cpp"},
             {"answer", "src/questions/preflight/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::preflight
