#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/operators/uniform_laplacian.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// Curvature × mean edge below this cannot be seen in any picture: coordinates written with six digits leave as much.
constexpr double visible = 1e-4;

report::Text about_length(const BenchRun& sphere) {
    const BenchLevel& coarse = sphere.levels[sphere.levels.size() - 2];
    const BenchLevel& fine = sphere.finest();
    return words.say("length", "coarse_vertices"_a = coarse.vertices, "fine_vertices"_a = fine.vertices,
                     "coarse"_a = readable(coarse.mean_length), "fine"_a = readable(fine.mean_length),
                     "times"_a = readable(coarse.mean_length / fine.mean_length));
}

/// "on the sphere it falls from …; on the ellipsoid it …" over the meshes of one kind.
std::string trends(const BenchRuns& runs, MeshKind kind, std::string_view estimator) {
    std::string told;
    for (const BenchRun& run : of_kind(runs, kind))
        told +=
            (told.empty() ? "" : "; ") + words.line("trends.surface", "surface"_a = run.surface, "trend"_a = trend(run.errors(estimator)));
    return told;
}

/// How much of the error of uniform H is the part of Δx along the surface.
report::Text about_tangential_part(const BenchRuns& runs) {
    std::vector<std::string> errors, drifting, others;
    for (const BenchRun& run : runs) {
        const std::string place = words.line("tangential.place", "triangulation"_a = name_of(run.kind), "surface"_a = run.surface);
        const double whole = run.finest().error(uniform_H).l2, normal_part = run.finest().error("H.uniform_n").l2;
        errors.push_back(words.line(errors.empty() ? "tangential.first" : "tangential.next",
                                    "normal_part"_a = readable_percent(normal_part, 2), "whole"_a = readable_percent(whole, 2),
                                    "place"_a = place));
        (normal_part < 0.5 * whole ? drifting : others).push_back(place);
    }
    const char* key = drifting.empty() ? "tangential.nowhere" : others.empty() ? "tangential.everywhere" : "tangential.partly";
    return report::text(words.say("tangential", "errors"_a = listed(errors)), " ",
                        words.say(key, "drifting"_a = listed(drifting), "others"_a = listed(others)));
}

/// The worst error at the finest level over the three surfaces.
double worst(const BenchRuns& runs, MeshKind kind, std::string_view estimator, Norm norm = &EstimateError::l2) {
    double error = 0;
    for (const BenchRun& run : of_kind(runs, kind)) error = std::max(error, run.finest().error(estimator).*norm);
    return error;
}

/// Of every surface the area form with the smallest error of K, beside that with the largest.
std::string best_areas(const BenchRuns& runs, MeshKind kind) {
    std::vector<std::string> told;
    for (const BenchRun& run : of_kind(runs, kind)) {
        const auto error = [&](AreaForm form) { return run.finest().error(K_with(form)).l2; };
        const auto [best, last] = std::ranges::minmax(area_forms, {}, error);
        told.push_back(words.line("areas.best", "best"_a = area_name(best), "surface"_a = run.surface,
                                  "least"_a = readable_percent(error(best)), "most"_a = readable_percent(error(last)),
                                  "worst"_a = area_name(last)));
    }
    return listed(told);
}

report::Text about_areas(const BenchRuns& runs) {
    const int without = without_K(runs, AreaForm::voronoi);
    return words.say("areas", "regular"_a = best_areas(runs, MeshKind::regular), "jittered"_a = best_areas(runs, MeshKind::jittered),
                     "undefined"_a = without > 0 ? words.line("areas.undefined", "vertices"_a = without) : "");
}

report::Text about_gauss_bonnet(const AngleSums& sums, const BenchRuns& runs) {
    const auto applicable = std::ranges::count_if(sums, &AngleSum::applies);
    const bool all = applicable == std::ssize(sums);
    const double rms = worst(runs, MeshKind::jittered, deficit_K);
    const double pointwise = worst(runs, MeshKind::jittered, deficit_K, &EstimateError::linf);
    return words.say(rms > 0.01 ? "euler.pointwise" : "euler",
                     "meshes"_a = words.line(all ? "euler.all" : "euler.some", "meshes"_a = applicable),
                     "gap"_a = readable(euler_gap(sums), 2), "rms"_a = readable_percent(rms), "pointwise"_a = readable_percent(pointwise));
}

report::Text about_flat(const FlatMesh& f) {
    const CurvatureSubject& s = f.curvature->subject;
    const auto at_most = [](double x, const char* unit) {
        return x == 0 ? words.line("flat.exactly") : words.line("flat.at_most", "value"_a = readable(x, 2), "unit"_a = unit);
    };
    const bool symmetric = f.drift < visible;
    report::Text t = words.say(s.interior == 0 ? "flat.all_boundary"
                               : symmetric     ? "flat.symmetric"
                                               : "flat.asymmetric",
                               "mesh"_a = s.name(), "vertices"_a = s.interior, "deficit"_a = at_most(f.deficit, "rad"),
                               "normal_part"_a = at_most(f.normal_part, "mean edges"),
                               "drift"_a = symmetric ? at_most(f.drift, "mean edges") : readable(f.drift, 2));
    if (f.boundary_vertices > 0)
        go_on(t, words.say("flat.boundary", "vertices"_a = f.boundary_vertices, "length"_a = readable(f.boundary_length, 2),
                           "K"_a = readable(f.boundary_K, 3), "largest_turning"_a = readable(f.largest_turning, 3),
                           "turning"_a = readable(f.turning, 4)));
    return t;
}

/// The share of inner vertices where K < 0, and the spread of h² over the mesh.
report::Text about_curved(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const ValueSummary H = summary_of(c.H), K = summary_of(c.K);
    if (H.count == 0) return words.say("curved.nothing", "mesh"_a = s.name());
    double low = INFINITY, high = 0;
    const Vector h2 = mean_squared_ring_edge(s.mesh(), s.topology());
    for (int i = 0; i < c.K.size(); ++i) {
        if (!std::isfinite(c.H[i])) continue;
        low = std::min(low, h2[i]);
        high = std::max(high, h2[i]);
    }
    const auto negative = double((c.K.array() < 0).count());
    report::Text t = words.say("curved", "mesh"_a = s.name(), "H"_a = readable(H.median), "K"_a = readable(K.median),
                               "negative"_a = readable_percent(negative / std::max(1, K.count), 2), "vertices"_a = K.count);
    if (const TangentialPart part = tangential_part(c); std::isfinite(part.normal_gap) && part.share > 1e-3)
        go_on(t, words.say(part.normal_gap < 0.9 * part.gap ? "curved.tangential" : "curved.tangential.no_nearer",
                           "share"_a = readable_percent(part.share, 2), "gap"_a = readable_percent(part.gap, 2),
                           "normal_gap"_a = readable_percent(part.normal_gap, 2)));
    if (low > 0) {
        const double spread = high / low;
        go_on(t, words.say(spread < 1.5 ? "curved.even_edges" : "curved.uneven_edges", "spread"_a = readable(spread, 2)));
    }
    return t;
}

/// What the panel of all estimators adds: surfaces and meshes this question does not look at.
report::Text about_panel(const BenchRuns& panel) {
    const auto H = [&](MeshKind kind) { return error_and_order(run_on(panel, "ellipsoid", kind).errors(uniform_H)); };
    const auto K = [&](MeshKind kind) { return error_and_order(run_on(panel, "ellipsoid", kind).errors(deficit_K)); };
    const auto converging = std::ranges::count_if(panel, [](const BenchRun& run) { return run.errors(uniform_H).order().converges(); });
    return words.say("panel", "runs"_a = panel.size(), "converging"_a = converging, "H_regular"_a = H(MeshKind::regular),
                     "H_random"_a = H(MeshKind::random), "H_anisotropic"_a = H(MeshKind::anisotropic), "K_regular"_a = K(MeshKind::regular),
                     "K_random"_a = K(MeshKind::random), "K_anisotropic"_a = K(MeshKind::anisotropic));
}

/// "6.8 to 24 times as large".
std::string times_as_large(const JitterFactors& factors) {
    const std::string least = readable(factors.least, 2), most = readable(factors.most, 2);
    return least == most ? words.line("verdict.as_large", "times"_a = least)
                         : words.line("verdict.as_large.range", "least"_a = least, "most"_a = most);
}

report::Text verdict(const BenchRuns& runs) {
    const double H_regular = worst(runs, MeshKind::regular, uniform_H), H_jittered = worst(runs, MeshKind::jittered, uniform_H);
    const double K_regular = worst(runs, MeshKind::regular, deficit_K), K_jittered = worst(runs, MeshKind::jittered, deficit_K);
    const double normal = worst(runs, MeshKind::regular, "H.uniform_n");
    const JitterFactors H = jitter_factors(runs, uniform_H), K = jitter_factors(runs, deficit_K);
    const char* key = H.matter() && K.matter() ? "verdict.both" : H.matter() ? "verdict.h" : K.matter() ? "verdict.k" : "verdict.neither";
    return words.say("verdict", "H_regular"_a = readable_percent(H_regular), "H_regular_grade"_a = grade(H_regular),
                     "normal"_a = readable_percent(normal, 2), "normal_grade"_a = grade(normal),
                     "K_regular"_a = readable_percent(K_regular), "K_regular_grade"_a = grade(K_regular),
                     "H_jittered"_a = readable_percent(H_jittered), "H_jittered_grade"_a = grade(H_jittered),
                     "K_jittered"_a = readable_percent(K_jittered), "K_jittered_grade"_a = grade(K_jittered),
                     "H_times"_a = times_as_large(H), "K_times"_a = times_as_large(K), "verdict"_a = words.line(key));
}

}   // namespace

void add_discussion(report::Section& section, const Meshes& meshes, const BenchRuns& runs, const AngleSums& sums,
                    const std::vector<FlatMesh>& flat, const BenchRuns& panel) {
    add_words(section, words, "discussion");
    add_paragraph(section, verdict(runs));
    add_paragraph(section, about_length(runs.front()));
    for (const auto& [quantity, estimator] : {std::pair{"Uniform H", uniform_H}, {"K", deficit_K}})
        add_paragraph(section, words.say("trends", "quantity"_a = quantity, "regular"_a = trends(runs, MeshKind::regular, estimator),
                                         "jittered"_a = trends(runs, MeshKind::jittered, estimator)));
    add_paragraph(section, about_tangential_part(runs));
    add_paragraph(section, about_areas(runs));
    add_paragraph(section, about_gauss_bonnet(sums, runs));
    for (const FlatMesh& f : flat) add_paragraph(section, about_flat(f));
    for (const MeshCurvature& c : meshes)
        if (!c.subject.plane_normal) add_paragraph(section, about_curved(c));
    add_paragraph(section, about_panel(panel));
}

}   // namespace meshfolio::q1_uniform
