#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

double cotangent_error(const BenchRun& run, AreaForm form) { return run.finest().error(H_with(form)).l2; }
double uniform_error(const BenchRun& run) { return run.finest().error("H.uniform").l2; }

std::string times_smaller(double factor) {
    if (factor > 1000) return words.line("times.over_1000");
    return factor >= 1 ? words.line("times.smaller", "factor"_a = readable(factor, 2))
                       : words.line("times.larger", "factor"_a = readable(1 / factor, 2));
}

/// Of every surface the best error of the cotangent operator beside that of the uniform one.
std::string gains(const BenchRuns& runs, MeshKind kind) {
    std::string told;
    for (const BenchRun& run : of_kind(runs, kind)) {
        const AreaForm best = std::ranges::min(area_forms, {}, [&](AreaForm form) { return cotangent_error(run, form); });
        const double error = cotangent_error(run, best), uniform = uniform_error(run);
        told += (told.empty() ? "" : "; ") + words.line("gains.surface", "surface"_a = run.surface, "error"_a = readable_percent(error),
                                                        "areas"_a = area_name(best), "uniform"_a = readable_percent(uniform),
                                                        "times"_a = times_smaller(uniform / error));
    }
    return told;
}

/// Which area forms converge on one surface.
report::Text refined(const BenchRun& run) {
    std::vector<std::string> trends;
    for (const AreaForm form : area_forms)
        trends.push_back(words.line("refined.areas", "areas"_a = area_name(form), "trend"_a = trend(run.errors(H_with(form)))));
    return words.say("refined", "triangulation"_a = name_of(run.kind), "surface"_a = run.surface, "trends"_a = listed(trends));
}

report::Text about_sphere(const BenchRun& regular, const BenchRun& jittered) {
    const BenchLevel& coarse = regular.levels.front();
    const BenchLevel& fine = regular.finest();
    report::Text t =
        words.say("sphere", "coarse"_a = readable_percent(coarse.error("H.barycentric").linf, 4), "coarse_vertices"_a = coarse.vertices,
                  "fine"_a = readable_percent(fine.error("H.barycentric").linf, 4), "fine_vertices"_a = fine.vertices,
                  "limit"_a = readable_percent(pentagon_excess(), 4), "mixed"_a = readable_percent(fine.error("H.mixed").linf, 2));
    const double identity = cotangent_error(jittered, AreaForm::voronoi);
    if (identity < 0.1 * cotangent_error(jittered, AreaForm::barycentric))
        go_on(t, words.say("sphere.voronoi", "error"_a = readable_percent(identity, 2)));
    return t;
}

report::Text about_square(const PlaneTest& plane) {
    const bool costs = plane.clamped > 1e3 * plane.cotangent;
    return words.say(costs ? "square.clamping_costs" : "square.clamping_free", "vertices"_a = plane.mesh.vertex_count(),
                     "negative"_a = readable_percent(plane.negative_weights, 2), "cotangent"_a = readable(plane.cotangent, 2),
                     "uniform"_a = readable(plane.uniform), "clamped"_a = readable(plane.clamped, costs ? 3 : 2));
}

report::Text about_flat(const CotangentComparison& c) {
    report::Text t = words.say("flat", "mesh"_a = c.subject.name());
    if (c.subject.interior == 0) {
        go_on(t, words.say("flat.no_inside"));
        return t;
    }
    const auto at_most = [](double x) {
        return x == 0 ? words.line("flat.exactly") : words.line("flat.at_most", "value"_a = readable(x, 2));
    };
    std::string verdict = ".";
    if (std::max(c.drift, c.precision) < 1e-4)   // what six digits of the coordinates leave
        verdict = words.line("flat.regular");
    else if (c.drift > 10 * c.precision)
        verdict = words.line("flat.improved", "times"_a = readable(c.drift / std::max(c.precision, 1e-300), 2));
    go_on(t, words.say("flat.inside", "precision"_a = at_most(c.precision), "drift"_a = at_most(c.drift), "verdict"_a = verdict));
    go_on(t, words.say("flat.boundary", "half_sum"_a = readable(c.variants[0].boundary),
                       "opposite_mean"_a = readable(c.variants[1].boundary)));
    return t;
}

report::Text about_negative_weights(const CotangentComparison& c) {
    const OperatorVariant& used = c.variants[0];
    const double change = c.variants[2].change;
    const int negative = used.negative_inside + used.negative_boundary;
    if (negative == 0) return words.say("curved.no_negative", "edges"_a = c.subject.topology().edges.size());
    return words.say("curved.negative", "negative"_a = negative, "edges"_a = c.subject.topology().edges.size(),
                     "on_boundary"_a = used.negative_boundary, "smallest"_a = readable(used.smallest_weight),
                     "clamped"_a = std::isfinite(change) ? words.line("curved.clamped", "change"_a = readable_percent(change, 2)) : "");
}

report::Text about_curved(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    if (summary_of(c.difference).count == 0) return words.say("curved.nothing", "mesh"_a = s.name());
    report::Text t = words.say("curved", "mesh"_a = s.name(), "difference"_a = readable_percent(c.rms_difference / c.rms_uniform),
                               "sign"_a = readable_percent(c.sign_change, 2));
    if (c.jump_uniform > 0 && c.jump_cotangent > 0) {
        const double ratio = c.jump_uniform / c.jump_cotangent;
        go_on(t, words.say(ratio >= 1 ? "curved.smoother" : "curved.rougher", "cotangent"_a = readable(c.jump_cotangent),
                           "uniform"_a = readable(c.jump_uniform), "times"_a = readable(ratio >= 1 ? ratio : 1 / ratio, 2)));
    }
    go_on(t, about_negative_weights(c));
    if (!s.source->prepared->preflight.closed())
        go_on(t, words.say("curved.boundary", "boundary"_a = readable(c.variants[0].boundary),
                           "opposite_mean"_a = readable(c.variants[1].boundary), "inside"_a = readable(c.variants[0].inside)));
    return t;
}

/// How often cotangent H with mixed areas is the better one and converges, and its worst error, on one kind of triangulation.
struct Tally {
    int surfaces = 0, wins = 0, converging = 0;
    double worst = 0;
};
Tally tally(const BenchRuns& runs, MeshKind kind) {
    Tally tally;
    for (const BenchRun& run : of_kind(runs, kind)) {
        const double error = cotangent_error(run, AreaForm::mixed);
        ++tally.surfaces;
        tally.wins += error < uniform_error(run) ? 1 : 0;
        tally.converging += run.errors("H.mixed").order().converges() ? 1 : 0;
        tally.worst = std::max(tally.worst, error);
    }
    return tally;
}

report::Text verdict(const BenchRuns& runs, const PlaneTest& plane) {
    const Tally regular = tally(runs, MeshKind::regular), jittered = tally(runs, MeshKind::jittered);
    const bool converges = jittered.converging == regular.surfaces;
    return words.say(
        "verdict", "regular_wins"_a = regular.wins, "surfaces"_a = regular.surfaces, "regular_converging"_a = regular.converging,
        "worst_regular"_a = readable_percent(regular.worst), "regular_grade"_a = grade(regular.worst), "jittered_wins"_a = jittered.wins,
        "jittered_converging"_a = jittered.converging, "worst_jittered"_a = readable_percent(jittered.worst),
        "jittered_grade"_a = grade(jittered.worst), "verdict"_a = words.line(converges ? "verdict.converging" : "verdict.not_converging"),
        "uniform"_a = readable(plane.uniform, 2), "cotangent"_a = readable(plane.cotangent, 2));
}

/// Cotangent against uniform over every sequence of meshes of the ground-truth panel, and who does better still.
report::Text about_panel(const BenchRuns& panel) {
    const auto nearer = [&](const char* one, const char* other) {
        return std::ranges::count_if(panel, [&](const BenchRun& run) { return run.finest().error(one).l2 < run.finest().error(other).l2; });
    };
    const auto error = [&](const char* key) { return error_and_order(run_on(panel, "ellipsoid", MeshKind::random).errors(key)); };
    return words.say("panel", "runs"_a = panel.size(), "better_than_uniform"_a = nearer("H.mixed", "H.uniform"),
                     "jet_better"_a = nearer("H.jet", "H.mixed"), "mixed"_a = error("H.mixed"), "jet"_a = error("H.jet"));
}

}   // namespace

void add_discussion(report::Section& section, const Comparisons& meshes, const BenchRuns& runs, const PlaneTest& plane,
                    const BenchRuns& panel) {
    add_words(section, words, "discussion");
    add_paragraph(section, verdict(runs, plane));
    add_paragraph(section,
                  words.say("gains", "regular"_a = gains(runs, MeshKind::regular), "jittered"_a = gains(runs, MeshKind::jittered)));
    for (const MeshKind kind : question_kinds)
        for (const char* surface : {"ellipsoid", "torus"}) add_paragraph(section, refined(run_on(runs, surface, kind)));
    add_paragraph(section, about_sphere(run_on(runs, "sphere", MeshKind::regular), run_on(runs, "sphere", MeshKind::jittered)));
    add_paragraph(section, about_square(plane));
    for (const CotangentComparison& c : meshes) add_paragraph(section, c.subject.plane_normal ? about_flat(c) : about_curved(c));
    add_paragraph(section, about_panel(panel));
}

}   // namespace meshfolio::q3_cotangent
