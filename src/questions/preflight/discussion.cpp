#include <set>

#include "questions/preflight/parts.h"

namespace meshfolio::preflight {

namespace {

constexpr double thin_below = 10;   // [°]

report::Text about_meshes(const std::vector<Inspected>& meshes) {
    Names clean, repaired, open;
    for (const Inspected& mesh : meshes) {
        const Preflight& p = mesh.counts();
        if (defects_of(mesh.facts).empty()) clean.push_back(mesh.name());
        if (p.dropped_degenerate_faces + p.dropped_duplicate_faces + p.flipped_faces + p.inside_out_components > 0)
            repaired.push_back(mesh.name());
        if (!p.closed()) open.push_back(mesh.name());
    }
    report::Text t;
    if (!clean.empty()) report::extend(t, words.say("clean", "meshes"_a = listed(clean)), " ");
    report::extend(t,
                   repaired.empty()
                       ? words.say("not_repaired")
                       : words.say(repaired.size() < meshes.size() ? "repaired" : "repaired.all", "meshes"_a = listed(repaired)),
                   " ");
    if (!open.empty()) report::extend(t, words.say("open", "meshes"_a = listed(open)));
    return t;
}

/// What was found and is still there, open boundaries and further components apart: "needle faces (lily 2)".
Names kept_of(const std::vector<Occurrence>& found) {
    static const std::set<std::string_view> told_elsewhere = {"dropped_degenerate_faces", "dropped_duplicate_faces", "flipped_faces",
                                                              "inside_out_components",    "boundary_loops",          "further_components"};
    Names kept;
    for (const Occurrence& o : found)
        if (!told_elsewhere.contains(o.defect->key)) kept.push_back(o.defect->name() + " (" + o.where + ")");
    return kept;
}

report::Text about_smallest_angle(const std::vector<Inspected>& meshes) {
    const Inspected& worst = *std::ranges::min_element(meshes, {}, [](const Inspected& m) { return m.facts.smallest_angle; });
    const double degrees = worst.facts.smallest_angle * 180 / pi;
    return words.say(!(degrees > 0)         ? "angle.none"
                     : degrees < thin_below ? "angle.thin"
                                            : "angle.even",
                     "angle"_a = readable(degrees, 2), "mesh"_a = worst.name());
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<Inspected>& meshes, const std::vector<Occurrence>& found) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_meshes(meshes)});
    if (const Names kept = kept_of(found); !kept.empty()) add_paragraphs(section, {words.say("kept", "defects"_a = listed(kept))});
    add_paragraphs(section, {about_smallest_angle(meshes)});
}

}   // namespace meshfolio::preflight
