#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/operators/uniform_laplacian.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

/// Curvature × mean edge below this cannot be seen in any picture: coordinates written with six digits leave as much.
constexpr double visible = 1e-4;

report::Text about_length(const UniformRefinement& sphere) {
    const UniformErrors& coarse = sphere.second_finest();
    const UniformErrors& fine = sphere.finest();
    return words.say("length", "coarse_vertices"_a = coarse.vertices, "fine_vertices"_a = fine.vertices,
                     "coarse"_a = readable(coarse.mean_length), "fine"_a = readable(fine.mean_length),
                     "times"_a = readable(coarse.mean_length / fine.mean_length));
}

/// "on the sphere it falls from …; on the ellipsoid it …" over the refinements of one triangulation.
std::string trends(const Refinements& refinements, Triangulation triangulation, bool gaussian) {
    std::string told;
    for (const UniformRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        told += (told.empty() ? "" : "; ") +
                words.line("trends.surface", "surface"_a = r.surface.name, "trend"_a = trend(errors_of(r, gaussian)));
    }
    return told;
}

/// How much of the error of uniform H is the part of Δx along the surface.
report::Text about_tangential_part(const Refinements& refinements) {
    std::vector<std::string> errors, drifting, others;
    for (const UniformRefinement& r : refinements) {
        const std::string place =
            words.line("tangential.place", "triangulation"_a = name_of(r.triangulation), "surface"_a = r.surface.name);
        const double whole = r.finest().H.l2, normal_part = r.finest().normal_part.l2;
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
double worst(const Refinements& refinements, Triangulation triangulation, bool gaussian) {
    double error = 0;
    for (const UniformRefinement& r : refinements)
        if (r.triangulation == triangulation) error = std::max(error, errors_of(r, gaussian).last());
    return error;
}

/// Of every surface the area form with the smallest error of K, beside that with the largest.
std::string best_areas(const Refinements& refinements, Triangulation triangulation) {
    std::vector<std::string> told;
    for (const UniformRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        const auto& K = r.finest().K;
        const auto name = [&](const FieldError& error) { return area_name(area_forms[static_cast<std::size_t>(&error - K.data())]); };
        const FieldError& best = *std::ranges::min_element(K, {}, &FieldError::l2);
        const FieldError& last = *std::ranges::max_element(K, {}, &FieldError::l2);
        told.push_back(words.line("areas.best", "best"_a = name(best), "surface"_a = r.surface.name, "least"_a = readable_percent(best.l2),
                                  "most"_a = readable_percent(last.l2), "worst"_a = name(last)));
    }
    return listed(told);
}

report::Text about_areas(const Refinements& refinements) {
    int without = 0;
    for (const UniformRefinement& r : refinements) without += r.finest().undefined[voronoi];
    return words.say("areas", "regular"_a = best_areas(refinements, Triangulation::regular),
                     "jittered"_a = best_areas(refinements, Triangulation::jittered),
                     "undefined"_a = without > 0 ? words.line("areas.undefined", "vertices"_a = without) : "");
}

report::Text about_gauss_bonnet(const AngleSums& sums, const Refinements& refinements) {
    const auto applicable = std::ranges::count_if(sums, &AngleSum::applies);
    const bool all = applicable == std::ssize(sums);
    const double rms = worst(refinements, Triangulation::jittered, true);
    double pointwise = 0;
    for (const UniformRefinement& r : refinements)
        if (r.triangulation == Triangulation::jittered) pointwise = std::max(pointwise, r.finest().K[barycentric].linf);
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
        report::extend(t, " ",
                       words.say("flat.boundary", "vertices"_a = f.boundary_vertices, "length"_a = readable(f.boundary_length, 2),
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
    if (low > 0) {
        const double spread = high / low;
        report::extend(t, " ", words.say(spread < 1.5 ? "curved.even_edges" : "curved.uneven_edges", "spread"_a = readable(spread, 2)));
    }
    return t;
}

/// What the panel of all estimators adds: surfaces and meshes this question does not look at.
report::Text about_panel(const GroundTruth& truth) {
    const auto H = [&](MeshKind kind) { return error_and_order(truth, "ellipsoid", kind, Quantity::H, "uniform"); };
    const auto K = [&](MeshKind kind) { return error_and_order(truth, "ellipsoid", kind, Quantity::K, "barycentric"); };
    const std::size_t uniform = estimator_index(Quantity::H, "uniform");
    const auto converging = std::ranges::count_if(
        truth.runs, [&](const PanelRun& run) { return !(truth.order(run, Quantity::H, uniform).order < 0.5); });   // exact: NaN
    return words.say("panel", "runs"_a = truth.runs.size(), "converging"_a = converging, "H_regular"_a = H(MeshKind::regular),
                     "H_random"_a = H(MeshKind::random), "H_anisotropic"_a = H(MeshKind::anisotropic), "K_regular"_a = K(MeshKind::regular),
                     "K_random"_a = K(MeshKind::random), "K_anisotropic"_a = K(MeshKind::anisotropic));
}

/// "6.8 to 24 times as large".
std::string times_as_large(const JitterFactors& factors) {
    const std::string least = readable(factors.least, 2), most = readable(factors.most, 2);
    return least == most ? words.line("verdict.as_large", "times"_a = least)
                         : words.line("verdict.as_large.range", "least"_a = least, "most"_a = most);
}

report::Text verdict(const Refinements& refinements) {
    const auto error = [&](Triangulation triangulation, bool gaussian) { return worst(refinements, triangulation, gaussian); };
    const double H_regular = error(Triangulation::regular, false), H_jittered = error(Triangulation::jittered, false);
    const double K_regular = error(Triangulation::regular, true), K_jittered = error(Triangulation::jittered, true);
    const JitterFactors H = jitter_factors(refinements, false), K = jitter_factors(refinements, true);
    const char* key = H.matter() && K.matter() ? "verdict.both" : H.matter() ? "verdict.h" : K.matter() ? "verdict.k" : "verdict.neither";
    return words.say("verdict", "H_regular"_a = readable_percent(H_regular), "H_regular_grade"_a = grade(H_regular),
                     "K_regular"_a = readable_percent(K_regular), "K_regular_grade"_a = grade(K_regular),
                     "H_jittered"_a = readable_percent(H_jittered), "H_jittered_grade"_a = grade(H_jittered),
                     "K_jittered"_a = readable_percent(K_jittered), "K_jittered_grade"_a = grade(K_jittered),
                     "H_times"_a = times_as_large(H), "K_times"_a = times_as_large(K), "verdict"_a = words.line(key));
}

}   // namespace

void add_discussion(report::Section& section, const Meshes& meshes, const Refinements& refinements, const AngleSums& sums,
                    const std::vector<FlatMesh>& flat, const GroundTruth& truth) {
    add_words(section, words, "discussion");
    add_paragraph(section, about_length(refinements.front()));
    for (const bool gaussian : {false, true})
        add_paragraph(section, words.say("trends", "quantity"_a = gaussian ? "K" : "Uniform H",
                                         "regular"_a = trends(refinements, Triangulation::regular, gaussian),
                                         "jittered"_a = trends(refinements, Triangulation::jittered, gaussian)));
    add_paragraph(section, about_tangential_part(refinements));
    add_paragraph(section, about_areas(refinements));
    add_paragraph(section, about_gauss_bonnet(sums, refinements));
    for (const FlatMesh& f : flat) add_paragraph(section, about_flat(f));
    for (const MeshCurvature& c : meshes)
        if (!c.subject.plane_normal) add_paragraph(section, about_curved(c));
    add_paragraph(section, about_panel(truth));
    add_paragraph(section, verdict(refinements));
}

}   // namespace meshfolio::q1_uniform
