#include <set>

#include "questions/bench/estimators.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// Meshes with fewer vertices are too small to describe their picture.
constexpr int fewest_to_read = 20;

/// Returns the largest error of an estimator on the finest meshes of a kind, in one norm.
double worst(const BenchRuns& runs, MeshKind kind, std::string_view estimator, Norm norm = &EstimateError::l2) {
    return largest_of(of_kind(runs, kind), [&](const BenchRun& run) { return run.finest().error(estimator).*norm; });
}

/// Counts the runs where most of the error of uniform H is the part of Δx along the surface.
int drifting_runs(const BenchRuns& runs) {
    return static_cast<int>(std::ranges::count_if(
        runs, [](const BenchRun& run) { return run.finest().error(normal_H).l2 < 0.5 * run.finest().error(uniform_H).l2; }));
}

int closed_rings(const MeshCurvature& c) { return summary_of(c.H).count; }
bool is_flat(const MeshCurvature& c) { return c.subject.plane_normal.has_value(); }

/// Returns a value with the name of its mesh, as text: "3 % on cube".
std::string on_mesh(const MeshCurvature& c, const std::string& value) {
    return words.line("value_on", "value"_a = value, "mesh"_a = c.name());
}
std::string share_on(const MeshCurvature& c, double share) { return on_mesh(c, readable_percent(share, 2)); }

/// Uniform H beside cotangent H on the curved meshes, and the meshes too small for that.
void add_picture_facts(report::Facts& facts, const Meshes& meshes) {
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
    const Names few = names_where(meshes, [](auto& c) { return !is_flat(c) && closed_rings(c) > 0 && closed_rings(c) < fewest_to_read; });
    facts.insert(facts.end(),
                 {"correlations"_a = listed(correlations), "uneven"_a = uneven, "few"_a = listed(few), "few_meshes"_a = few.size(),
                  "nothing"_a = listed(names_where(meshes, [](auto& c) { return closed_rings(c) == 0; }))});
}

void add_flat_mesh_facts(report::Facts& facts, const std::vector<FlatMesh>& flat) {
    Names symmetric;
    report::FactList asymmetric;
    bool rounded = false;
    for (const FlatMesh& f : flat) {
        const CurvatureSubject& s = f.curvature->subject;
        if (s.interior == 0) continue;
        if (f.drift >= visible) asymmetric.push_back({"mesh"_a = s.name(), "reach"_a = readable(f.drift, 2)});
        else symmetric.push_back(s.name()), rounded = rounded || s.is_rounding(f.drift * s.mean_edge);
    }
    facts.insert(facts.end(), {"symmetric"_a = listed(symmetric), "symmetric_meshes"_a = symmetric.size(), "rounded"_a = rounded,
                               "asymmetric"_a = asymmetric});
}

void add_drift_facts(report::Facts& facts, const Meshes& meshes, const std::optional<Drifting>& drifting) {
    if (!drifting) return facts.push_back("drifting"_a = "");
    const TangentialPart& part = drifting->part;
    const bool is_known = std::isfinite(part.normal_gap) && part.share > 1e-3;
    const MeshCurvature* flattest = nullptr;   // with the largest flat part that misleads
    FlatParts flat;
    for (const MeshCurvature& c : meshes) {
        if (is_flat(c)) continue;
        if (const FlatParts parts = flat_parts(c); parts.mislead() && parts.share > flat.share) flattest = &c, flat = parts;
    }
    facts.insert(facts.end(), {"drifting"_a = drifting->mesh->name(), "share"_a = readable_percent(part.share, 2),
                               "nearer"_a = is_known && part.explains(), "no_nearer"_a = is_known && !part.explains(),
                               "times"_a = readable(part.gap / part.normal_gap, 2), "flattest"_a = flattest ? flattest->name() : "",
                               "flat"_a = readable_percent(flat.share, 2), "coloured"_a = readable_percent(flat.coloured, 2),
                               "flat_drift"_a = readable_percent(flat.drift, 2)});
}

void add_K_facts(report::Facts& facts, const Meshes& meshes) {
    Names caps, negative, outer, white, positive;
    report::FactList ringed;
    for (const MeshCurvature& c : meshes) {
        const SignsOfK seen = signs_of_K(c);
        const IrregularVertices odd = irregular_vertices(c);
        if (odd.ringed())
            ringed.push_back({"mesh"_a = c.name(), "vertices"_a = odd.vertices.size(), "faint"_a = !odd.seen(),
                              "off"_a = readable_percent(odd.off, 2), "elsewhere"_a = readable_percent(odd.off_elsewhere, 2),
                              "area"_a = odd.area_is_why(), "voronoi"_a = readable_percent(odd.off_with_voronoi, 2)});
        if (is_flat(c) || closed_rings(c) == 0) continue;
        if (seen.all.negative > 0) negative.push_back(share_on(c, seen.all.negative));
        if (seen.all.positive == 1 && !odd.ringed()) positive.push_back(c.name());
        if (seen.all.caps_outside()) outer.push_back(share_on(c, seen.all.outer_positive));
        if (seen.all.caps_outside() && seen.all.inner_negative > 0.5) caps.push_back(c.name());
        if (seen.all.negative > 0 && seen.white > 0.2) white.push_back(share_on(c, seen.white));
    }
    facts.insert(facts.end(), {"caps"_a = listed(caps), "negative"_a = listed(negative), "outer"_a = listed(outer),
                               "white"_a = listed(white), "positive"_a = listed(positive), "ringed"_a = ringed,
                               "plane"_a = listed(names_where(meshes, [](auto& c) { return is_flat(c) && c.subject.interior > 0; }))});
}

void add_error_facts(report::Facts& facts, const BenchRuns& runs, const BenchRuns& panel) {
    const auto converges = [](std::string_view estimator) {
        return [=](const BenchRun& run) { return run.errors(estimator).order().converges(); };
    };
    const auto worse = std::ranges::count_if(runs, [](const BenchRun& run) { return run.errors(uniform_H).order().exponent < -0.5; });
    facts.insert(facts.end(),
                 {"K_converges"_a = std::ranges::any_of(of_kind(runs, MeshKind::jittered), converges(deficit_K)),
                  "drifting_runs"_a = drifting_runs(runs), "runs"_a = runs.size(),
                  "rest"_a = readable_percent(largest_of(runs, [](auto& run) { return run.finest().error(normal_H).l2; }), 2),
                  "worse"_a = worse, "panel"_a = panel.size(), "converging"_a = std::ranges::count_if(panel, converges(uniform_H))});
}

/// Counts the vertices without K on all finest meshes: their area of this form is not positive.
int without_K(const BenchRuns& runs, AreaForm form) {
    int without = 0;
    for (const BenchRun& run : runs) without += run.finest().error(K_with(form)).undefined;
    return without;
}

/// The area form with the smallest error of K on each jittered surface, and the cost of barycentric areas [percentage points].
void add_area_facts(report::Facts& facts, const BenchRuns& runs, const AngleSums& sums) {
    const auto error = [](const BenchRun& run, AreaForm form) { return run.finest().error(K_with(form)).l2; };
    Names best_on;
    std::set<AreaForm> winners;
    for (const BenchRun& run : of_kind(runs, MeshKind::jittered)) {
        const AreaForm best = std::ranges::min(area_forms, {}, [&](AreaForm form) { return error(run, form); });
        winners.insert(best);
        best_on.push_back(words.line("areas.best", "best"_a = area_name(best), "surface"_a = run.surface));
    }
    const double price = largest_of(runs, [&](const BenchRun& run) {
        return error(run, AreaForm::barycentric) - std::min(error(run, AreaForm::voronoi), error(run, AreaForm::mixed));
    });
    const BenchRun& sphere = run_on(runs, "sphere", MeshKind::jittered);
    facts.insert(facts.end(),
                 {"one"_a = winners.size() == 1, "best"_a = winners.size() == 1 ? area_name(*winners.begin()) : listed(best_on),
                  "price"_a = readable(rounded_up(100 * price, 2), 2),
                  "sphere"_a = error(sphere, AreaForm::voronoi) < 0.1 * error(sphere, AreaForm::barycentric),
                  "without"_a = without_K(runs, AreaForm::voronoi), "sums"_a = std::ranges::count_if(sums, &AngleSum::applies),
                  "gap"_a = readable(largest_of(sums, [](auto& s) { return s.applies ? std::abs(s.measured - s.euler) : 0; }), 2)});
}

}   // namespace

report::Table area_table(const BenchRuns& runs) {
    const bool all_defined = std::ranges::all_of(area_forms, [&](AreaForm form) { return without_K(runs, form) == 0; });
    const std::string caption = words.line("area_forms") + (all_defined ? "" : " " + words.line("area_forms.undefined"));
    auto errors = table("q1_area_forms", caption, area_forms);
    errors.column("area form", area_name);
    for (const BenchRun& run : runs)
        errors.column(run.title(), {.unit = "%", .best = Best::smallest},
                      [&](AreaForm form) { return 100 * run.finest().error(K_with(form)).linf; });
    if (!all_defined)
        errors.column("without K", {.unit = "vertices", .best = Best::smallest}, [&](AreaForm form) { return without_K(runs, form); });
    return errors;
}

std::optional<Drifting> most_drifting(const Meshes& meshes) {
    std::optional<Drifting> most;
    for (const MeshCurvature& c : meshes) {
        if (is_flat(c) || closed_rings(c) == 0) continue;
        const TangentialPart part = tangential_part(c);
        if (part.share > (most ? most->part.share : 0.01)) most = {&c, part};
    }
    return most;
}

void add_answer(report::Section& section, const BenchRuns& runs) {
    using enum MeshKind;
    const auto error = [&](MeshKind kind, std::string_view estimator) { return readable_percent(worst(runs, kind, estimator), 2); };
    section.answer = words.say("answer", "K_regular"_a = error(regular, deficit_K), "K_jittered"_a = error(jittered, deficit_K),
                               "H_regular"_a = error(regular, uniform_H), "H_jittered"_a = error(jittered, uniform_H),
                               "drift"_a = 2 * drifting_runs(runs) > std::ssize(runs));
    const auto largest = [](const BenchLevel& level) { return level.error(deficit_K).linf; };
    const auto regular_runs = of_kind(runs, regular);
    const BenchRun& run = *std::ranges::max_element(regular_runs, {}, [&](const BenchRun& r) { return largest(r.finest()); });
    const double at_worst_vertex = largest(run.finest());
    // One vertex is far worse than the rest, and refinement hardly improves it.
    const bool stuck = at_worst_vertex > 5 * run.finest().error(deficit_K).l2 && at_worst_vertex > 0.8 * largest(run.levels.front());
    add_paragraphs(section,
                   {words.say("lead", "jittered"_a = readable_percent(worst(runs, jittered, deficit_K, &EstimateError::linf), 2),
                              "stuck"_a = stuck ? run.surface : "", "stuck_error"_a = stuck ? readable_percent(at_worst_vertex, 2) : "")});
}

void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting) {
    report::Facts facts;
    add_picture_facts(facts, meshes);
    add_flat_mesh_facts(facts, flat);
    add_drift_facts(facts, meshes, drifting);
    add_K_facts(facts, meshes);
    add_error_facts(facts, runs, panel);
    add_area_facts(facts, runs, sums);
    add_words(section, words, "discussion", facts);
}

}   // namespace meshfolio::q1_uniform
