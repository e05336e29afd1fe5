#include "questions/preflight/parts.h"

namespace meshfolio::preflight {

namespace {

std::string orientation_of(const Preflight& p) {
    if (!p.orientable) return "none";
    std::string orientation = "consistent";
    if (p.flipped_faces > 0) orientation += ", " + words.line("turned", "faces"_a = p.flipped_faces);
    if (p.inside_out_components > 0) orientation += ", " + words.line("turned_outwards", "components"_a = p.inside_out_components);
    return orientation;
}

/// Of the counts of a mesh.
auto of(auto value) {
    return [value](const Inspected& mesh) { return std::invoke(value, mesh.counts()); };
}

}   // namespace

report::Table connectivity_table(const std::vector<Inspected>& meshes) {
    const report::Column count{.digits = 8};
    return table("preflight_connectivity", words.line("connectivity"), meshes)
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
    return table("preflight_geometry", words.line("geometry"), meshes)
        .column("mesh", &Inspected::name)
        .column("box diagonal", {.unit = "length", .digits = 4}, [](auto& m) { return m.facts.diagonal; })
        .column("offset", {.unit = "diagonals", .digits = 2}, [](auto& m) { return m.facts.offset; })
        .column("shortest edge", {.unit = "length"}, [](auto& m) { return m.facts.shortest_edge; })
        .column("mean edge", {.unit = "length"}, of(&Preflight::mean_edge))
        .column("longest edge", {.unit = "length"}, [](auto& m) { return m.facts.longest_edge; })
        .column("smallest angle", {.unit = "°"}, [](auto& m) { return m.facts.smallest_angle * 180 / pi; })
        .column("area", {.unit = "length²", .digits = 4}, of(&Preflight::area))
        .column("volume", {.unit = "length³", .digits = 4}, of([](auto& p) { return cell_of(p.volume, p.closed()); }))
        .column("Gauss–Bonnet", {.digits = 2}, [](auto& m) { return cell_of(m.facts.gauss_bonnet_residual, m.counts().manifold()); });
}

report::Table defect_table(const std::vector<Occurrence>& found) {
    return table("preflight_defects", words.line("defects"), found)
        .column("found", [](auto& o) { return o.defect->name(); })
        .column("count", {.digits = 8}, &Occurrence::count)
        .column("where", &Occurrence::where)
        .column("affects", [](auto& o) { return affected_for_people(*o.defect); })
        .column("what it breaks", [](auto& o) { return o.defect->breaks(); })
        .column("what was done", [](auto& o) { return o.defect->done(); });
}

report::Table search_table(const std::vector<Inspected>& meshes, const std::vector<Occurrence>& occurrences) {
    return table("preflight_looked_for", words.line("looked_for", "meshes"_a = meshes.size()), occurrences)
        .column("looked for", [](auto& o) { return o.defect->name(); })
        .column("affects", [](auto& o) { return affected_for_people(*o.defect); })
        .column("meshes with it", {.digits = 8}, &Occurrence::meshes)
        .column("count in all", {.digits = 10}, &Occurrence::count);
}

}   // namespace meshfolio::preflight
