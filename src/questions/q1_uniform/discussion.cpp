#include <set>

#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// Meshes with fewer vertices are too small to describe their picture.
constexpr int fewest_to_read = 20;

/// The worst error at the finest level over the three surfaces.
double worst(const BenchRuns& runs, MeshKind kind, std::string_view estimator, Norm norm = &EstimateError::l2) {
    return largest_of(of_kind(runs, kind), [&](const BenchRun& run) { return run.finest().error(estimator).*norm; });
}

/// Counts the runs where most of the error of uniform H is the part of Δx along the surface.
int drifting_runs(const BenchRuns& runs) {
    return static_cast<int>(std::ranges::count_if(
        runs, [](const BenchRun& run) { return run.finest().error(normal_H).l2 < 0.5 * run.finest().error(uniform_H).l2; }));
}

/// The regular mesh with the worst vertex, if that is far worse than the rest and hardly improves with refinement.
const BenchRun* stuck_at_a_vertex(const BenchRuns& runs) {
    const auto error = [](const BenchLevel& level) { return level.error(deficit_K).linf; };
    const auto regular = of_kind(runs, MeshKind::regular);
    const BenchRun& run = *std::ranges::max_element(regular, {}, [&](const BenchRun& r) { return error(r.finest()); });
    const bool stuck = error(run.finest()) > 5 * run.finest().error(deficit_K).l2 && error(run.finest()) > 0.8 * error(run.levels.front());
    return stuck ? &run : nullptr;
}

int closed_rings(const MeshCurvature& c) { return summary_of(c.H).count; }
bool is_flat(const MeshCurvature& c) { return c.subject.plane_normal.has_value(); }

std::string on_mesh(const MeshCurvature& c, const std::string& value) {
    return words.line("value_on", "value"_a = value, "mesh"_a = c.name());
}
std::string share_on(const MeshCurvature& c, double share) { return on_mesh(c, readable_percent(share, 2)); }

/// Uniform H beside cotangent H on the curved meshes.
report::Facts about_pictures(const Meshes& meshes) {
    Names correlations;
    report::FactList uneven;
    for (const MeshCurvature& c : meshes) {
        if (is_flat(c) || closed_rings(c) < fewest_to_read) continue;
        const Picture p = picture_of(c);
        if (!p.varies_where_truth_does_not()) {
            correlations.push_back(on_mesh(c, readable(p.correlation, 2)));
            continue;
        }
        const Contrast drift = tangential_part(c).length;
        uneven.push_back({"mesh"_a = c.name(), "spread"_a = readable(p.spread, 2),
                          "cotangent"_a = readable_percent(p.cotangent_spread - 1, 2),
                          "drift"_a = drift.most > drift.least + 0.05 ? readable_percent(drift.most, 2) : ""});
    }
    return {"correlations"_a = listed(correlations), "uneven"_a = uneven};
}

report::Facts about_flat_meshes(const std::vector<FlatMesh>& flat) {
    Names symmetric;
    report::FactList asymmetric;
    bool rounded = false;
    for (const FlatMesh& f : flat) {
        const CurvatureSubject& s = f.curvature->subject;
        if (s.interior == 0) continue;
        if (f.drift >= visible)
            asymmetric.push_back({"mesh"_a = s.name(), "reach"_a = readable(f.drift, 2)});
        else
            symmetric.push_back(s.name()), rounded = rounded || s.is_rounding(f.drift * s.mean_edge);
    }
    return {"symmetric"_a = listed(symmetric), "symmetric_meshes"_a = symmetric.size(), "rounded"_a = rounded, "asymmetric"_a = asymmetric};
}

report::Facts about_small_meshes(const Meshes& meshes) {
    const Names few = names_where(meshes, [](auto& c) { return !is_flat(c) && closed_rings(c) > 0 && closed_rings(c) < fewest_to_read; });
    return {"few"_a = listed(few), "few_meshes"_a = few.size(),
            "nothing"_a = listed(names_where(meshes, [](auto& c) { return closed_rings(c) == 0; }))};
}

/// The curved mesh with the largest flat part that misleads.
std::pair<const MeshCurvature*, FlatParts> flattest_of(const Meshes& meshes) {
    std::pair<const MeshCurvature*, FlatParts> most{};
    for (const MeshCurvature& c : meshes) {
        if (is_flat(c)) continue;
        if (const FlatParts flat = flat_parts(c); flat.mislead() && flat.share > most.second.share) most = {&c, flat};
    }
    return most;
}

report::Facts about_drift(const Meshes& meshes, const std::optional<Drifting>& drifting) {
    if (!drifting) return {"drifting"_a = ""};
    const TangentialPart& part = drifting->part;
    const bool is_known = std::isfinite(part.normal_gap) && part.share > 1e-3;
    const auto [flattest, flat] = flattest_of(meshes);
    return {"drifting"_a = drifting->mesh->name(),
            "share"_a = readable_percent(part.share, 2),
            "nearer"_a = is_known && part.explains(),
            "no_nearer"_a = is_known && !part.explains(),
            "times"_a = readable(part.gap / part.normal_gap, 2),
            "flattest"_a = flattest ? flattest->name() : "",
            "flat"_a = readable_percent(flat.share, 2),
            "coloured"_a = readable_percent(flat.coloured, 2),
            "flat_drift"_a = readable_percent(flat.drift, 2)};
}

report::FactList ringed_vertices(const Meshes& meshes) {
    report::FactList ringed;
    for (const MeshCurvature& c : meshes) {
        const IrregularVertices odd = irregular_vertices(c);
        if (!odd.ringed()) continue;
        ringed.push_back({"mesh"_a = c.name(), "vertices"_a = odd.vertices.size(), "faint"_a = !odd.seen(),
                          "off"_a = readable_percent(odd.off, 2), "elsewhere"_a = readable_percent(odd.off_elsewhere, 2),
                          "area"_a = odd.area_is_why(), "voronoi"_a = readable_percent(odd.off_with_voronoi, 2)});
    }
    return ringed;
}

report::Facts about_K(const Meshes& meshes) {
    Names caps, negative, outer, white, positive;
    for (const MeshCurvature& c : meshes) {
        const SignsOfK seen = signs_of_K(c);
        if (is_flat(c) || closed_rings(c) == 0) continue;
        if (seen.all.negative > 0) negative.push_back(share_on(c, seen.all.negative));
        if (seen.all.positive == 1 && !irregular_vertices(c).ringed()) positive.push_back(c.name());
        if (seen.all.caps_outside()) outer.push_back(share_on(c, seen.all.outer_positive));
        if (seen.all.caps_outside() && seen.all.inner_negative > 0.5) caps.push_back(c.name());
        if (seen.all.negative > 0 && seen.white > 0.2) white.push_back(share_on(c, seen.white));
    }
    return {"caps"_a = listed(caps),
            "negative"_a = listed(negative),
            "outer"_a = listed(outer),
            "white"_a = listed(white),
            "positive"_a = listed(positive),
            "ringed"_a = ringed_vertices(meshes),
            "plane"_a = listed(names_where(meshes, [](auto& c) { return is_flat(c) && c.subject.interior > 0; }))};
}

report::Facts about_errors(const BenchRuns& runs, const BenchRuns& panel) {
    const auto converges = [](std::string_view estimator) {
        return [=](const BenchRun& run) { return run.errors(estimator).order().converges(); };
    };
    const auto worse = std::ranges::count_if(runs, [](const BenchRun& run) { return run.errors(uniform_H).order().exponent < -0.5; });
    return {"K_converges"_a = std::ranges::any_of(of_kind(runs, MeshKind::jittered), converges(deficit_K)),
            "drifting_runs"_a = drifting_runs(runs),
            "runs"_a = runs.size(),
            "rest"_a = readable_percent(largest_of(runs, [](auto& run) { return run.finest().error(normal_H).l2; }), 2),
            "worse"_a = worse,
            "panel"_a = panel.size(),
            "converging"_a = std::ranges::count_if(panel, converges(uniform_H))};
}

/// The area form with the smallest error of K on each jittered surface, and what barycentric areas cost [percentage points].
report::Facts about_areas(const BenchRuns& runs, const AngleSums& sums) {
    const auto error = [](const BenchRun& run, AreaForm form) { return run.finest().error(K_with(form)).l2; };
    Names told;
    std::set<AreaForm> winners;
    for (const BenchRun& run : of_kind(runs, MeshKind::jittered)) {
        const AreaForm best = std::ranges::min(area_forms, {}, [&](AreaForm form) { return error(run, form); });
        winners.insert(best);
        told.push_back(words.line("areas.best", "best"_a = area_name(best), "surface"_a = run.surface));
    }
    const double price = largest_of(runs, [&](const BenchRun& run) {
        return error(run, AreaForm::barycentric) - std::min(error(run, AreaForm::voronoi), error(run, AreaForm::mixed));
    });
    const BenchRun& sphere = run_on(runs, "sphere", MeshKind::jittered);
    return {"one"_a = winners.size() == 1,
            "best"_a = winners.size() == 1 ? area_name(*winners.begin()) : listed(told),
            "price"_a = readable(rounded_up(100 * price, 2), 2),
            "sphere"_a = error(sphere, AreaForm::voronoi) < 0.1 * error(sphere, AreaForm::barycentric),
            "without"_a = without_K(runs, AreaForm::voronoi),
            "sums"_a = std::ranges::count_if(sums, &AngleSum::applies),
            "gap"_a = readable(euler_gap(sums), 2)};
}

}   // namespace

std::optional<Drifting> most_drifting(const Meshes& meshes) {
    std::optional<Drifting> most;
    for (const MeshCurvature& c : meshes) {
        if (is_flat(c) || closed_rings(c) == 0) continue;
        const TangentialPart part = tangential_part(c);
        if (part.share > (most ? most->part.share : 0.01)) most = {&c, part};
    }
    return most;
}

report::Text answer_of(const BenchRuns& runs) {
    const auto error = [&](MeshKind kind, std::string_view estimator) { return readable_percent(worst(runs, kind, estimator), 2); };
    using enum MeshKind;
    return words.say("answer", "K_regular"_a = error(regular, deficit_K), "K_jittered"_a = error(jittered, deficit_K),
                     "H_regular"_a = error(regular, uniform_H), "H_jittered"_a = error(jittered, uniform_H),
                     "drift"_a = 2 * drifting_runs(runs) > std::ssize(runs));
}

report::Text lead_of(const BenchRuns& runs) {
    const auto largest = [](const BenchRun& run) { return run.finest().error(deficit_K).linf; };
    const BenchRun* stuck = stuck_at_a_vertex(runs);
    return words.say("lead", "jittered"_a = readable_percent(worst(runs, MeshKind::jittered, deficit_K, &EstimateError::linf), 2),
                     "stuck"_a = stuck ? stuck->surface : "", "stuck_error"_a = stuck ? readable_percent(largest(*stuck), 2) : "");
}

void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting) {
    report::Facts facts;
    for (const report::Facts& part : {about_pictures(meshes), about_flat_meshes(flat), about_small_meshes(meshes),
                                      about_drift(meshes, drifting), about_K(meshes), about_errors(runs, panel), about_areas(runs, sums)})
        facts.insert(facts.end(), part.begin(), part.end());
    add_words(section, words, "discussion", facts);
}

void add_flat_boundaries(report::Section& section, const std::vector<FlatMesh>& flat) {
    for (const FlatMesh& f : flat)
        if (f.boundary_vertices > 0)
            add_words(section, words, "flat.boundary", "mesh"_a = f.curvature->name(), "length"_a = readable(f.boundary_length, 2),
                      "turning"_a = readable(f.turning, 4));
}

}   // namespace meshfolio::q1_uniform
