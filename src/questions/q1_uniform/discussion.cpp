// What question 1 says about its numbers.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/operators/uniform_laplacian.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

using report::math;
using report::ref;

/// Curvature × mean edge below this cannot be seen in any picture: coordinates written with six digits leave as much.
constexpr double visible = 1e-4;

std::string at_most(double x, const std::string& unit) { return x == 0 ? "exactly 0" : "at most " + readable(x, 2) + " " + unit; }

report::Text flat_mesh_words(const FlatMesh& f) {
    const CurvatureSubject& s = f.curvature->subject;
    report::Text t = report::text("The mesh ", s.name(), " is flat, so H and K are zero on it");
    if (s.interior > 0) {
        report::extend(t, "; at its ", counted(s.interior, "inner vertex", "inner vertices"), " the angle deficit is ",
                       at_most(f.deficit, "rad"), " and the normal part of ", math("Δx"), " ", at_most(f.normal_part, "mean edges"));
        if (f.drift < visible) {
            report::extend(t, ", and as every inner ring is symmetric, ", math("½‖Δx‖"), " is ", at_most(f.drift, "mean edges"), " too");
        } else {
            report::extend(t, ", but ", math("½‖Δx‖"), " reaches ", readable(f.drift, 2),
                           " mean edges there: the uniform Laplacian of an asymmetric ring points along the plane, and its length is read "
                           "as curvature");
        }
    }
    report::extend(t, ". ");
    if (f.boundary_vertices > 0) {
        report::extend(t, "Whatever a picture of it shows comes from its ",
                       counted(f.boundary_vertices, "boundary vertex", "boundary vertices"), ": unmasked, they would read up to ",
                       readable(f.boundary_length, 2), " mean edges of ", math("½‖Δx‖"), " and ", readable(f.boundary_K, 3), " of ",
                       math("K·d²"), ". Their ", math("π − Σθ"), " (at most ", readable(f.largest_turning, 3),
                       " rad) is the turning of the boundary and adds up to ", readable(f.turning, 4), " full turns.");
    }
    return t;
}

/// The share of inner vertices where K < 0, and the spread of h² over the mesh, in words.
report::Text mesh_words(const MeshCurvature& c) {
    const CurvatureSubject& s = c.subject;
    const ValueSummary H = summary_of(c.H), K = summary_of(c.K);
    if (H.count == 0) {
        return report::text("On ", s.name(), " every vertex lies on the boundary or is not manifold: no curvature is defined anywhere.");
    }
    int negative = 0;
    double low = INFINITY, high = 0;
    const Vector h2 = mean_squared_ring_edge(s.mesh(), s.topology());
    for (int i = 0; i < c.K.size(); ++i) {
        negative += c.K[i] < 0 ? 1 : 0;
        if (!std::isfinite(c.H[i])) continue;
        low = std::min(low, h2[i]);
        high = std::max(high, h2[i]);
    }
    report::Text t = report::text("On ", s.name(), " the median of H (scaled) is ", readable(H.median), " and of K ", readable(K.median),
                                  " in units of the mesh; K is negative at ", readable_percent(double(negative) / std::max(1, K.count), 2),
                                  " of the ", std::to_string(K.count), " vertices that have one.");
    if (low > 0) {
        const double spread = high / low;
        report::extend(t, " The squared ring edge varies ", readable(spread, 2), "-fold over it, ");
        if (spread < 1.5) {
            report::extend(t, "so there the raw ", math("½‖Δx‖"), " and the scaled H tell the same story.");
        } else {
            report::extend(t, "and the raw ", math("½‖Δx‖"), " of two vertices with equal H by as much.");
        }
    }
    return t;
}

report::Text length_words(const UniformRefinement& sphere) {
    const UniformErrors& coarse = sphere.second_finest();
    const UniformErrors& fine = sphere.finest();
    return report::text("As the assignment writes it, ", math("½‖Δx‖"), " is a length: from ", std::to_string(coarse.vertices), " to ",
                        std::to_string(fine.vertices), " vertices its mean on the unit sphere falls from ", readable(coarse.mean_length),
                        " to ", readable(fine.mean_length), ", ", readable(coarse.mean_length / fine.mean_length),
                        "-fold, though H = 1 throughout. Times ", math("4/h²"),
                        " it becomes a curvature that can be held against the closed form.");
}

/// "on the sphere it falls from …, on the ellipsoid …" over the refinements of one triangulation.
report::Text trends(const std::vector<UniformRefinement>& refinements, Triangulation triangulation, bool gaussian) {
    report::Text t;
    for (const UniformRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        report::extend(t, t.empty() ? "on the " : "; on the ", r.surface.name, " it ", trend(gaussian ? deficit_K(r) : uniform_H(r)));
    }
    return t;
}

/// How much of the error of uniform H is the part of Δx along the surface.
report::Text tangential_words(const std::vector<UniformRefinement>& refinements) {
    report::Text t =
        report::text("The norm ", math("‖Δx‖"), " also counts the part of ", math("Δx"),
                     " along the surface, which has nothing to do with curvature. With the normal part alone the error would be ");
    std::vector<std::string> parts, drifting, others;
    for (const UniformRefinement& r : refinements) {
        const std::string place = "the " + std::string(name_of(r.triangulation)) + " " + r.surface.name;
        const double with = r.finest().H.l2, without = r.finest().normal_part.l2;
        parts.push_back(readable_percent(without, 2) + (parts.empty() ? " instead of " : " for ") + readable_percent(with, 2) + " on " +
                        place);
        (without < 0.5 * with ? drifting : others).push_back(place);
    }
    report::extend(t, listed(parts), " (", ref("q1_errors"), "). ");
    if (!drifting.empty()) report::extend(t, "It is less than half, so most of the error is tangential drift, on ", listed(drifting));
    if (!drifting.empty() && !others.empty()) report::extend(t, "; it is not on ", listed(others));
    report::extend(t, drifting.empty() ? "Nowhere is it less than half, so the drift is not what spoils the estimate." : ".");
    return t;
}

/// Worst finest error over the three surfaces.
double worst(const std::vector<UniformRefinement>& refinements, Triangulation triangulation, bool gaussian) {
    double error = 0;
    for (const UniformRefinement& r : refinements) {
        if (r.triangulation == triangulation) error = std::max(error, gaussian ? deficit_K(r).last() : uniform_H(r).last());
    }
    return error;
}

report::Text area_words(const std::vector<UniformRefinement>& refinements) {
    report::Text t = report::text("The area decides how K is normalised. ");
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        std::vector<std::string> parts;
        for (const UniformRefinement& r : refinements) {
            if (r.triangulation != triangulation) continue;
            std::size_t best = 0, last = 0;
            for (std::size_t form = 1; form < area_forms.size(); ++form) {
                if (r.finest().K[form].l2 < r.finest().K[best].l2) best = form;
                if (r.finest().K[form].l2 > r.finest().K[last].l2) last = form;
            }
            parts.push_back(area_name(area_forms[best]) + " on the " + r.surface.name + " (" + readable_percent(r.finest().K[best].l2) +
                            " against " + readable_percent(r.finest().K[last].l2) + " with " + area_name(area_forms[last]) + ")");
        }
        report::extend(t, "The smallest L2 error on ", name_of(triangulation), " meshes is that of ", listed(parts), ". ");
    }
    std::array<int, 3> undefined{};
    for (const UniformRefinement& r : refinements) {
        for (std::size_t form = 0; form < area_forms.size(); ++form) undefined[form] += r.finest().undefined[form];
    }
    report::extend(t,
                   "Barycentric areas are used here for figures and statistics because they are positive wherever triangles have area and "
                   "add up to the surface");
    if (undefined[1] > 0)
        report::extend(t, "; the Voronoi form has ", counted(undefined[1], "vertex", "vertices"), " of area ≤ 0 on these meshes");
    report::extend(t, " (", ref("q1_area_forms_l2"), ").");
    return t;
}

report::Text gauss_bonnet_words(const std::vector<AngleSum>& sums, const std::vector<UniformRefinement>& refinements) {
    double gap = 0;
    int applicable = 0;
    for (const AngleSum& s : sums) {
        if (!s.applies) continue;
        ++applicable;
        gap = std::max(gap, std::abs(s.measured - s.euler));
    }
    const double rms = worst(refinements, Triangulation::jittered, true);
    double pointwise = 0;
    for (const UniformRefinement& r : refinements) {
        if (r.triangulation == Triangulation::jittered) pointwise = std::max(pointwise, r.finest().K.front().linf);
    }
    report::Text t = report::text("Summed up, the angle deficit gives the Euler characteristic of ",
                                  applicable == static_cast<int>(sums.size()) ? "all " : "", counted(applicable, "mesh", "meshes"), " to ",
                                  readable(gap, 2), " (", ref("q1_gauss_bonnet"), ")");
    if (rms > 0.01) {
        report::extend(t, ", also where K is off by up to ", readable_percent(rms), " (L2), at single vertices by up to ",
                       readable_percent(pointwise), " (", ref("q1_errors"), "): the total is exact, its distribution is not");
    }
    report::extend(t, ".");
    return t;
}

/// "6.8 to 24 times as large".
std::string times_as_large(const JitterFactors& factors) {
    const std::string least = readable(factors.least, 2), most = readable(factors.most, 2);
    return (least == most ? least : least + " to " + most) + " times as large";
}

report::Text verdict(const std::vector<UniformRefinement>& refinements) {
    const double h_regular = worst(refinements, Triangulation::regular, false),
                 h_jittered = worst(refinements, Triangulation::jittered, false);
    const double k_regular = worst(refinements, Triangulation::regular, true),
                 k_jittered = worst(refinements, Triangulation::jittered, true);
    report::Text t = report::text(report::strong("Is this a good approximation? "), "On regular triangulations uniform H is ",
                                  grade(h_regular), " (worst L2 error at the finest level ", readable_percent(h_regular), ") and K ",
                                  grade(k_regular), " (", readable_percent(k_regular),
                                  "). After a jitter along the surface, which leaves the surface as it was, H is ", grade(h_jittered), " (",
                                  readable_percent(h_jittered), ") and K ", grade(k_jittered), " (", readable_percent(k_jittered), ").");
    const JitterFactors H = jitter_factors(refinements, false), K = jitter_factors(refinements, true);
    report::extend(t, " Surface by surface the error became ", times_as_large(H), " for H and ", times_as_large(K), " for K (",
                   ref("q1_errors"), "): ",
                   H.matter() && K.matter() ? "both depend on the triangulation, not only on the surface."
                   : H.matter()             ? "H depends on the triangulation, not only on the surface."
                   : K.matter()             ? "K depends on the triangulation, not only on the surface."
                                            : "the triangulation matters little here.");
    return t;
}

/// What the panel of all estimators adds: surfaces and meshes this question does not look at.
report::Text panel_words(const GroundTruth& truth) {
    using Kind = MeshKind;
    const auto told = [&](Quantity quantity, Kind kind, const char* estimator) {
        return readable_percent(truth.finest("ellipsoid", kind, quantity, estimator).l2, 2) + " (order " +
               words_of(truth.order("ellipsoid", kind, quantity, estimator)) + ")";
    };
    const std::size_t uniform = estimator_index(Quantity::H, "uniform");
    int converging = 0;
    for (const PanelRun& run : truth.runs) converging += truth.order(run, Quantity::H, uniform).order < 0.5 ? 0 : 1;   // exact: NaN
    return report::text("The ground-truth panel (", ref("truth"), ") widens this to ",
                        counted(static_cast<int>(truth.runs.size()), "sequence"), " of refined meshes: scaled uniform H converges on ",
                        std::to_string(converging), " of them (", ref("truth_overview"), "). On the ellipsoid its L2 error is ",
                        told(Quantity::H, Kind::regular, "uniform"), " on regular, ", told(Quantity::H, Kind::random, "uniform"),
                        " on random and ", told(Quantity::H, Kind::anisotropic, "uniform"),
                        " on anisotropic triangles; that of K with barycentric areas ", told(Quantity::K, Kind::regular, "barycentric"),
                        ", ", told(Quantity::K, Kind::random, "barycentric"), " and ", told(Quantity::K, Kind::anisotropic, "barycentric"),
                        " (", ref("truth_errors_regular_l2"), ", ", ref("truth_errors_random_l2"), " and ",
                        ref("truth_errors_anisotropic_l2"), ", each followed by its orders).");
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<MeshCurvature>& meshes, const std::vector<UniformRefinement>& refinements,
                    const std::vector<AngleSum>& sums, const std::vector<FlatMesh>& flat, const GroundTruth& truth) {
    add_heading(section, "Discussion: is this a good approximation?");
    section.blocks.push_back(report::Paragraph{length_words(refinements.front())});
    for (const bool gaussian : {false, true}) {
        add_paragraph(section, gaussian ? "K" : "Uniform H",
                      ", L2 error over the three finest levels, regular meshes: ", trends(refinements, Triangulation::regular, gaussian),
                      ". With jittered vertices: ", trends(refinements, Triangulation::jittered, gaussian), ".");
    }
    section.blocks.push_back(report::Paragraph{tangential_words(refinements)});
    section.blocks.push_back(report::Paragraph{area_words(refinements)});
    section.blocks.push_back(report::Paragraph{gauss_bonnet_words(sums, refinements)});
    for (const FlatMesh& f : flat) section.blocks.push_back(report::Paragraph{flat_mesh_words(f)});
    for (const MeshCurvature& c : meshes) {
        if (!c.subject.plane_normal) section.blocks.push_back(report::Paragraph{mesh_words(c)});
    }
    section.blocks.push_back(report::Paragraph{panel_words(truth)});
    section.blocks.push_back(report::Paragraph{verdict(refinements)});
}

}   // namespace meshfolio::q1_uniform
