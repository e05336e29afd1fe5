// Preflight: the properties of each mesh, its defects, the questions they affect, and the repairs.
#include <set>

#include "geometry/measures/mesh_laws.h"
#include "questions/bench/defects.h"
#include "questions/bench/law_checks.h"
#include "questions/certificates/parts.h"
#include "questions/core/mesh_roles.h"

namespace meshfolio::certificates {

namespace {

/// The meshes with a defect.
struct Occurrence {
    const Defect* defect;
    std::string where;   // "plane 1, lily 2"; empty: nowhere
    int meshes = 0;
    double count = 0;   // on all meshes together
};

/// Returns "none" or "consistent", with the repairs.
std::string orientation_of(const Preflight& p) {
    if (!p.orientable) return "none";
    std::string orientation = "consistent";
    if (p.flipped_faces > 0) orientation += ", " + words.line("turned", "faces"_a = p.flipped_faces);
    if (p.inside_out_components > 0) orientation += ", " + words.line("turned_outwards", "components"_a = p.inside_out_components);
    return orientation;
}

/// Returns a function from a mesh to a value of its preflight.
auto of(auto value) {
    return [value](const Inspected& mesh) { return std::invoke(value, mesh.counts()); };
}

report::Table connectivity_table(const std::vector<Inspected>& meshes) {
    const report::Column count{.digits = 8};
    return table("certificates_connectivity", words.line("connectivity"), meshes)
        .column("mesh", &Inspected::name)
        .column("V", count, of(&Preflight::vertices_in_use))
        .column("edges", count, of(&Preflight::edges))
        .column("triangles", count, of(&Preflight::triangles))
        .column("components", count, of(&Preflight::components))
        .column("boundary loops", count, of(&Preflight::boundary_loops))
        .column("χ", count, of(&Preflight::euler_characteristic))
        .column("genus", count, of([](auto& p) { return cell_of(p.genus, p.genus >= 0); }))
        .column("manifold", of([](auto& p) { return p.manifold() ? "yes" : "no"; }))
        .column("orientation", of(orientation_of));
}

report::Table geometry_table(const std::vector<Inspected>& meshes) {
    return table("certificates_geometry", words.line("geometry"), meshes)
        .column("mesh", &Inspected::name)
        .column("box diagonal", {.unit = "length", .digits = 4}, [](auto& m) { return m.facts.diagonal; })
        .column("offset", {.unit = "diagonals", .digits = 2}, [](auto& m) { return m.facts.offset; })
        .column("shortest edge", {.unit = "length"}, [](auto& m) { return m.facts.shortest_edge; })
        .column("mean edge", {.unit = "length"}, of(&Preflight::mean_edge))
        .column("longest edge", {.unit = "length"}, [](auto& m) { return m.facts.longest_edge; })
        .column("steps of coordinates", {.unit = "shortest edges", .digits = 2}, [](auto& m) { return m.facts.written_steps; })
        .column("smallest angle", {.unit = "°"}, [](auto& m) { return m.facts.smallest_angle * 180 / pi; })
        .column("area", {.unit = "length²", .digits = 4}, of(&Preflight::area))
        .column("volume", {.unit = "length³", .digits = 4}, of([](auto& p) { return cell_of(p.volume, p.encloses_volume()); }))
        .column("Gauss–Bonnet", {.digits = 2}, [](auto& m) { return cell_of(m.facts.gauss_bonnet_residual, m.counts().manifold()); });
}

/// Returns the meshes of the settings, else the user's own, else one for each role, each file once; a failed check for unusable roles.
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
            add(section, check_near(words.line("check.usable", "role"_a = role.role), 1, 0, 0, error.what()));
        }
    }
    return meshes;
}

void add_checks(report::Section& section, const Inspected& mesh) {
    const std::string on = " on " + mesh.name();
    const PreparedMesh& prepared = *mesh.source->prepared;
    const Preflight& p = mesh.counts();
    const auto add_once = [&](report::Check check) {   // a mesh with a certificate has it already
        if (std::ranges::find(section.checks, check.name, &report::Check::name) == section.checks.end()) add(section, std::move(check));
    };
    if (p.manifold())
        add_once(check_at_most(law("gauss_bonnet", on), gauss_bonnet_tolerance(p.triangles), mesh.facts.gauss_bonnet_residual));
    if (p.manifold() && p.orientable) add_once(check_near(law("half_edges", on), 0, repeated_half_edges(prepared.mesh.F), 0));
    constexpr double larger = 0x1p20, smaller = 0x1p-20;
    add_once(check_at_most(words.line("check.moved", "mesh"_a = mesh.name()), 1e-12,
                           std::max(change_when_moved(prepared, larger), change_when_moved(prepared, smaller)), 0,
                           words.line("check.moved.note")));
}

bool has_dropped(const Inspected& mesh) { return mesh.counts().dropped_degenerate_faces + mesh.counts().dropped_duplicate_faces > 0; }
bool has_turned(const Inspected& mesh) { return mesh.counts().flipped_faces + mesh.counts().inside_out_components > 0; }
bool is_rounded(const Inspected& mesh) { return mesh.facts.is_rounded(); }

/// Adds the paragraph about the defects found. @param found  those with an occurrence
void add_findings(report::Section& section, const std::vector<Inspected>& meshes, const std::vector<Occurrence>& found) {
    constexpr double thin_below = 10;   // [°]
    static const std::set<std::string_view> mentioned_elsewhere = {
        "dropped_degenerate_faces", "dropped_duplicate_faces", "flipped_faces",
        "inside_out_components",    "boundary_loops",          "further_components"};
    Names kept;   // defects that are still there: "needle faces (lily 2)"
    for (const Occurrence& o : found)
        if (!mentioned_elsewhere.contains(o.defect->key)) kept.push_back(o.defect->name() + " (" + o.where + ")");
    const Names repaired = names_where(meshes, [](const Inspected& mesh) { return has_dropped(mesh) || has_turned(mesh); });
    const Names rounded = names_where(meshes, is_rounded), open = names_where(meshes, [](auto&mesh) { return !mesh.counts().closed(); });
    const Inspected& worst = *std::ranges::min_element(meshes, {}, [](const Inspected& m) { return m.facts.smallest_angle; });
    const double degrees = worst.facts.smallest_angle * 180 / pi;
    double finest = rounded.empty() ? 0 : infinity, coarsest = 0;   // steps of the rounded coordinates [shortest edges]
    for (const Inspected& mesh : meshes)
        if (is_rounded(mesh)) finest = std::min(finest, mesh.facts.written_steps), coarsest = std::max(coarsest, mesh.facts.written_steps);
    add_words(section, words, "preflight.found", "clean"_a = listed(names_where(meshes, &Inspected::is_sound)),
              "repaired"_a = listed(repaired), "others"_a = repaired.size() < meshes.size(),
              "dropped"_a = std::ranges::any_of(meshes, has_dropped), "turned"_a = std::ranges::any_of(meshes, has_turned),
              "open"_a = listed(open), "kept"_a = listed(kept), "found"_a = !found.empty(), "without_angle"_a = !(degrees > 0),
              "thin"_a = degrees > 0 && degrees < thin_below, "even"_a = degrees >= thin_below, "angle"_a = readable(degrees, 2),
              "worst"_a = worst.name(), "rounded"_a = rounded.size(), "steps"_a = span_of(readable(finest, 2), readable(coarsest, 2)));
}

}   // namespace

bool Inspected::is_sound() const { return defects_of(facts).empty(); }

std::vector<Inspected> inspected_meshes(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                        report::Section& section) {
    std::vector<Inspected> meshes;
    for (const auto& source : meshes_of_report(library.limited_to(0), settings, section)) {
        progress("preflight of " + source->name);
        meshes.push_back({{source}, mesh_facts(*source->prepared)});
    }
    if (meshes.empty())
        throw InputError({}, "the preflight found no usable mesh for any role",
                         "`meshfolio inspect FILE` says what is wrong with a mesh of --data");
    return meshes;
}

void add_preflight(report::Section& section, const std::vector<Inspected>& meshes) {
    std::vector<Occurrence> occurrences;
    for (const Defect& defect : defect_list()) {
        Occurrence& o = occurrences.emplace_back(Occurrence{&defect, ""});
        for (const Inspected& mesh : meshes) {
            const int count = defect.count(mesh.facts);
            if (count <= 0) continue;
            o.where += (o.meshes++ == 0 ? "" : ", ") + mesh.name() + " " + std::to_string(count);
            o.count += count;
        }
    }
    std::vector<Occurrence> found = occurrences;
    std::erase_if(found, [](const Occurrence& o) { return o.meshes == 0; });
    add_words(section, words, "preflight", "kinds"_a = occurrences.size());
    add(section, connectivity_table(meshes), geometry_table(meshes));
    if (!found.empty())
        add(section, table("certificates_defects", words.line("defects"), found)
                         .column("found", [](auto& o) { return o.defect->name(); })
                         .column("count", {.digits = 8}, &Occurrence::count)
                         .column("where", &Occurrence::where)
                         .column("affects", [](auto& o) { return affected_for_people(*o.defect); })
                         .column("what it breaks", [](auto& o) { return o.defect->breaks(); })
                         .column("what was done", [](auto& o) { return o.defect->done(); }));
    add(section, table("certificates_looked_for", words.line("looked_for", "meshes"_a = meshes.size()), occurrences)
                     .column("looked for", [](auto& o) { return o.defect->name(); })
                     .column("affects", [](auto& o) { return affected_for_people(*o.defect); })
                     .column("meshes with it", {.digits = 8}, &Occurrence::meshes)
                     .column("count in all", {.digits = 10}, &Occurrence::count)
                     .file_only());
    for (const Inspected& mesh : meshes) add_checks(section, mesh);
    add_findings(section, meshes, found);
}

}   // namespace meshfolio::certificates
