#include <set>

#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// Meshes with fewer vertices are too small to describe their picture.
constexpr int fewest_to_read = 20;

/// The worst error at the finest level over the three surfaces.
double worst(const BenchRuns& runs, MeshKind kind, std::string_view estimator, Norm norm = &EstimateError::l2) {
    double error = 0;
    for (const BenchRun& run : of_kind(runs, kind)) error = std::max(error, run.finest().error(estimator).*norm);
    return error;
}

double worst(const BenchRuns& runs, std::string_view estimator) {
    return std::max(worst(runs, MeshKind::regular, estimator), worst(runs, MeshKind::jittered, estimator));
}

/// Counts the runs where most of the error of uniform H is the part of Δx along the surface.
int drifting_runs(const BenchRuns& runs) {
    return static_cast<int>(std::ranges::count_if(
        runs, [](const BenchRun& run) { return run.finest().error(normal_H).l2 < 0.5 * run.finest().error(uniform_H).l2; }));
}

// ---- what the pictures of H show

report::Text flat_picture(const FlatMesh& f) {
    const CurvatureSubject& s = f.curvature->subject;
    const char* key = s.interior == 0                        ? "h.flat.all_boundary"
                      : f.drift >= visible                   ? "h.flat.asymmetric"
                      : s.is_rounding(f.drift * s.mean_edge) ? "h.flat.rounded"
                                                             : "h.flat.symmetric";
    return words.say(key, "mesh"_a = s.name(), "drift"_a = readable(f.drift, 2));
}

report::Text curved_picture(const MeshCurvature& c) {
    const std::string& mesh = c.name();
    if (summary_of(c.H).count == 0) return words.say("h.nothing", "mesh"_a = mesh);
    if (const int vertices = summary_of(c.H).count; vertices < fewest_to_read)
        return words.say("h.few", "mesh"_a = mesh, "vertices"_a = vertices);
    const Picture p = picture_of(c);
    if (p.varies_where_truth_does_not()) {
        const Contrast drift = tangential_part(c).length;
        report::Text t = words.say("h.uneven", "mesh"_a = mesh, "spread"_a = readable(p.spread, 2),
                                   "cotangent"_a = readable_percent(p.cotangent_spread - 1, 2));
        if (drift.most > drift.least + 0.05)
            go_on(t, words.say("h.uneven.drift", "most"_a = readable_percent(drift.most, 2), "least"_a = readable_percent(drift.least, 2)));
        return t;
    }
    const char* key = p.misleads() ? "h.misleads" : p.correlation < 0.8 ? "h.partly" : "h.plausible";
    return words.say(key, "mesh"_a = mesh, "correlation"_a = readable(p.correlation, 2));
}

/// Has the mesh a picture that is compared with that of cotangent H?
bool is_compared(const MeshCurvature& c) { return !c.subject.plane_normal && summary_of(c.H).count >= fewest_to_read; }

report::Text about_H_picture(const Meshes& meshes, const std::vector<FlatMesh>& flat) {
    report::Text t = words.say("h.read");
    if (std::ranges::any_of(meshes, is_compared)) go_on(t, words.say("h.reference"));
    for (const MeshCurvature& c : meshes)
        if (!c.subject.plane_normal) go_on(t, curved_picture(c));
    for (const FlatMesh& f : flat) go_on(t, flat_picture(f));
    return t;
}

// ---- the drift along the surface

/// Describes the largest flat parts of the curved meshes.
void go_on_about_flat_parts(report::Text& t, const Meshes& meshes) {
    const MeshCurvature* flattest = nullptr;
    FlatParts most;
    for (const MeshCurvature& c : meshes) {
        if (c.subject.plane_normal) continue;
        if (const FlatParts flat = flat_parts(c); flat.mislead() && flat.share > most.share) flattest = &c, most = flat;
    }
    if (!flattest) return;
    go_on(t, words.say("tangential.flat", "mesh"_a = flattest->name(), "flat"_a = readable_percent(most.share, 2),
                       "coloured"_a = readable_percent(most.coloured, 2), "drift"_a = readable_percent(most.drift, 2)));
}

report::Text about_tangential_picture(const Drifting& drifting, const Meshes& meshes) {
    const TangentialPart& part = drifting.part;
    const std::string& mesh = drifting.mesh->name();
    report::Text t = words.say("tangential", "mesh"_a = mesh, "share"_a = readable_percent(part.share, 2));
    go_on(t, words.say(part.dark > 0.5    ? "tangential.mostly_dark"
                       : part.dark > 0.02 ? "tangential.partly_dark"
                                          : "tangential.pale",
                       "mesh"_a = mesh, "dark"_a = readable_percent(part.dark, 2)));
    go_on(t, words.say("tangential.why"));
    go_on_about_flat_parts(t, meshes);
    if (std::isfinite(part.normal_gap) && part.share > 1e-3)
        go_on(t, words.say(part.explains() ? "tangential.nearer" : "tangential.no_nearer", "mesh"_a = mesh,
                           "gap"_a = readable_percent(part.gap, 2), "normal_gap"_a = readable_percent(part.normal_gap, 2)));
    return t;
}

// ---- what the picture of K shows

report::Text K_picture(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const ValueSummary K = summary_of(c.K);
    if (K.count == 0) return words.say("k.nothing", "mesh"_a = s.name());
    if (const IrregularVertices odd = irregular_vertices(c); odd.ringed()) {
        report::Text t =
            words.say(odd.seen() ? "k.irregular" : "k.irregular.faint", "mesh"_a = s.name(), "vertices"_a = odd.vertices.size(),
                      "off"_a = readable_percent(odd.off, 2), "elsewhere"_a = readable_percent(odd.off_elsewhere, 2));
        if (odd.area_is_why()) go_on(t, words.say("k.irregular.area", "voronoi"_a = readable_percent(odd.off_with_voronoi, 2)));
        return t;
    }
    if (!(c.K.array() < 0).any()) return words.say("k.positive", "mesh"_a = s.name());
    const SignsByDistance seen = signs_by_distance(s, c.K, 0.05 * diverging_range(c.K));   // what is paler is as good as white
    return words.say("k.saddles", "mesh"_a = s.name(), "negative"_a = readable_percent(seen.negative, 2),
                     "flat"_a = readable_percent(1 - seen.positive - seen.negative, 2));
}

/// Caps outside and saddles between them: what several meshes show alike is said once.
struct Caps {
    Names negative, outer;

    /// Does the mesh show them?
    bool take(const MeshCurvature& c) {
        const SignsByDistance seen = signs_by_distance(c.subject, c.K, 0.05 * diverging_range(c.K));
        if (irregular_vertices(c).ringed() || !(c.K.array() < 0).any() || !seen.caps_outside()) return false;
        negative.push_back(words.line(negative.empty() ? "k.caps.saddles" : "k.caps.saddles_too",
                                      "share"_a = readable_percent(seen.negative, 2), "mesh"_a = c.name()));
        outer.push_back(readable_percent(seen.outer_positive, 2));
        return true;
    }
};

report::Text about_K_picture(const Meshes& meshes, const std::vector<FlatMesh>& flat) {
    report::Text t = words.say("k.read"), others;
    Caps caps;
    for (const MeshCurvature& c : meshes)
        if (!c.subject.plane_normal && !caps.take(c)) go_on(others, K_picture(c));
    if (!caps.outer.empty()) go_on(t, words.say("k.caps", "negative"_a = listed(caps.negative), "outer"_a = listed(caps.outer)));
    go_on(t, others);
    for (const FlatMesh& f : flat)
        if (f.curvature->subject.interior > 0) go_on(t, words.say("k.flat", "mesh"_a = f.curvature->name()));
    return t;
}

// ---- what the errors say

/// Names the regular mesh whose worst vertex is far worse than the rest and hardly improves with refinement.
void go_on_about_worst_vertex(report::Text& t, const BenchRuns& runs) {
    const auto error = [](const BenchLevel& level) { return level.error(deficit_K).linf; };
    const BenchRun* worst = nullptr;
    for (const BenchRun& run : of_kind(runs, MeshKind::regular))
        if (!worst || error(run.finest()) > error(worst->finest())) worst = &run;
    if (error(worst->finest()) > 5 * worst->finest().error(deficit_K).l2 && error(worst->finest()) > 0.8 * error(worst->levels.front()))
        go_on(t, words.say("errors.k.worst", "surface"_a = worst->surface));
}

report::Text about_errors(const BenchRuns& runs, const BenchRuns& panel) {
    const int drifting = drifting_runs(runs);
    const auto converging = std::ranges::count_if(panel, [](const BenchRun& run) { return run.errors(uniform_H).order().converges(); });
    const bool jitter_converges = std::ranges::any_of(of_kind(runs, MeshKind::jittered),
                                                      [](const BenchRun& run) { return run.errors(deficit_K).order().converges(); });
    report::Text t = words.say(jitter_converges ? "errors.k.converging" : "errors.k");
    go_on_about_worst_vertex(t, runs);
    const auto on_sphere = [&](MeshKind kind) { return readable_percent(run_on(runs, "sphere", kind).finest().error(normal_H).l2, 2); };
    go_on(t, words.say("errors.h", "drifting"_a = drifting, "runs"_a = runs.size(), "regular"_a = on_sphere(MeshKind::regular),
                       "jittered"_a = on_sphere(MeshKind::jittered), "rest"_a = readable_percent(worst(runs, normal_H), 2)));
    const auto worse = std::ranges::count_if(runs, [](const BenchRun& run) { return run.errors(uniform_H).order().exponent < -0.5; });
    if (2 * worse > std::ssize(runs)) go_on(t, words.say("errors.worse", "worse"_a = worse, "runs"_a = runs.size()));
    go_on(t, words.say(converging > 0 ? "errors.panel" : "errors.panel.none", "converging"_a = converging, "runs"_a = panel.size()));
    return t;
}

/// The area form with the smallest error of K on each jittered surface.
report::Text about_areas(const BenchRuns& runs) {
    Names told;
    std::set<AreaForm> winners;
    for (const BenchRun& run : of_kind(runs, MeshKind::jittered)) {
        const auto error = [&](AreaForm form) { return run.finest().error(K_with(form)).l2; };
        const AreaForm best = std::ranges::min(area_forms, {}, error);
        winners.insert(best);
        told.push_back(words.line("areas.best", "best"_a = area_name(best), "surface"_a = run.surface));
    }
    report::Text t =
        winners.size() == 1 ? words.say("areas.one", "best"_a = area_name(*winners.begin())) : words.say("areas", "best"_a = listed(told));
    const auto price = [&](AreaForm form) {   // of barycentric areas, at most [percentage points]
        double most = 0;
        for (const BenchRun& run : runs)
            most = std::max(most, run.finest().error(K_with(AreaForm::barycentric)).l2 - run.finest().error(K_with(form)).l2);
        return readable(100 * most, 2);
    };
    go_on(t, words.say("areas.mixed", "mixed"_a = price(AreaForm::mixed), "voronoi"_a = price(AreaForm::voronoi)));
    const BenchLevel& sphere = run_on(runs, "sphere", MeshKind::jittered).finest();
    if (sphere.error(K_with(AreaForm::voronoi)).l2 < 0.1 * sphere.error(K_with(AreaForm::barycentric)).l2)
        go_on(t, words.say("areas.sphere"));
    if (const int without = without_K(runs, AreaForm::voronoi); without > 0) go_on(t, words.say("areas.undefined", "vertices"_a = without));
    return t;
}

report::Text about_gauss_bonnet(const AngleSums& sums) {
    const auto applicable = std::ranges::count_if(sums, &AngleSum::applies);
    const bool all = applicable == std::ssize(sums);
    return words.say("euler", "meshes"_a = words.line(all ? "euler.all" : "euler.some", "meshes"_a = applicable),
                     "gap"_a = readable(euler_gap(sums), 2));
}

}   // namespace

std::optional<Drifting> most_drifting(const Meshes& meshes) {
    std::optional<Drifting> most;
    for (const MeshCurvature& c : meshes) {
        if (c.subject.plane_normal || summary_of(c.H).count == 0) continue;
        const TangentialPart part = tangential_part(c);
        if (part.share > (most ? most->part.share : 0.01)) most = {&c, part};
    }
    return most;
}

report::Text answer_of(const BenchRuns& runs) {
    const bool drift = 2 * drifting_runs(runs) > std::ssize(runs);
    const double regular = worst(runs, MeshKind::regular, deficit_K), jittered = worst(runs, MeshKind::jittered, deficit_K);
    return words.say(drift ? "answer.drift" : "answer", "K_regular"_a = grade(regular), "regular"_a = readable_percent(regular, 2),
                     "K_jittered"_a = grade(jittered), "jittered"_a = readable_percent(jittered, 2), "H"_a = grade(worst(runs, uniform_H)));
}

report::Text lead_of(const BenchRuns& runs, const std::optional<Drifting>& drifting) {
    const auto error = [&](MeshKind kind, std::string_view estimator, Norm norm = &EstimateError::l2) {
        return readable_percent(worst(runs, kind, estimator, norm), 2);
    };
    using enum MeshKind;
    report::Text t = words.say("lead.h", "regular"_a = error(regular, uniform_H), "jittered"_a = error(jittered, uniform_H));
    go_on(t, words.say("lead.k", "regular"_a = error(regular, deficit_K, &EstimateError::linf),
                       "jittered"_a = error(jittered, deficit_K, &EstimateError::linf)));
    if (drifting)
        go_on(t, words.say("lead.drift", "mesh"_a = drifting->mesh->name(), "share"_a = readable_percent(drifting->part.share, 2)));
    return t;
}

void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting) {
    add_paragraphs(section,
                   {about_H_picture(meshes, flat), drifting ? about_tangential_picture(*drifting, meshes) : report::Text(),
                    about_K_picture(meshes, flat), about_errors(runs, panel), paragraph_of({about_areas(runs), about_gauss_bonnet(sums)})});
}

void add_flat_boundaries(report::Section& section, const std::vector<FlatMesh>& flat) {
    for (const FlatMesh& f : flat)
        if (f.boundary_vertices > 0)
            add_paragraphs(section,
                           {words.say("flat.boundary", "mesh"_a = f.curvature->name(), "vertices"_a = f.boundary_vertices,
                                      "length"_a = readable(f.boundary_length, 2), "K"_a = readable(f.boundary_K, 3),
                                      "largest_turning"_a = readable(f.largest_turning, 3), "turning"_a = readable(f.turning, 4))});
}

}   // namespace meshfolio::q1_uniform
