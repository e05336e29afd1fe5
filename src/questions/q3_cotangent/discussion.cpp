// What question 3 says about its numbers.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

using report::math;
using report::ref;

std::size_t best_form(const CotangentErrors& e) {
    std::size_t best = 0;
    for (std::size_t form = 1; form < area_forms.size(); ++form) {
        if (e.H[form].l2 < e.H[best].l2) best = form;
    }
    return best;
}

std::string times_smaller(double factor) {
    if (factor > 1000) return "over 1000 times smaller";
    return factor >= 1 ? readable(factor, 2) + " times smaller" : readable(1 / factor, 2) + " times larger";
}

/// "on the torus 0.02 % (mixed) against 14 % uniform, 680 times smaller".
report::Text gains(const std::vector<CotangentRefinement>& refinements, Triangulation triangulation) {
    report::Text t;
    for (const CotangentRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        const CotangentErrors& e = r.finest();
        const std::size_t best = best_form(e);
        report::extend(t, t.empty() ? "on the " : "; on the ", r.surface.name, " ", readable_percent(e.H[best].l2), " (",
                       area_name(area_forms[best]), " areas) against ", readable_percent(e.uniform.l2), " of the uniform estimate, ",
                       times_smaller(e.uniform.l2 / e.H[best].l2));
    }
    return t;
}

/// Which area forms converge on one surface, with the errors at the finest level.
report::Text convergence_words(const CotangentRefinement& r) {
    std::vector<std::string> parts;
    for (std::size_t form = 0; form < area_forms.size(); ++form) {
        parts.push_back("with " + area_name(area_forms[form]) + " areas it " + trend(cotangent_H(r, form)));
    }
    return report::text("Refining the ", name_of(r.triangulation), " ", r.surface.name,
                        ", L2 error of cotangent H over the three finest levels: ", listed(parts), ".");
}

report::Text sphere_words(const CotangentRefinement& regular, const CotangentRefinement& jittered) {
    const CotangentErrors& coarse = regular.levels.front();
    const CotangentErrors& fine = regular.finest();
    report::Text t = report::text(
        "At single vertices the barycentric area can be wrong at every resolution: on the icosphere its L∞ error goes from ",
        readable_percent(coarse.H[barycentric].linf, 4), " at ", std::to_string(coarse.vertices), " vertices to ",
        readable_percent(fine.H[barycentric].linf, 4), " at ", std::to_string(fine.vertices),
        "; the limit at the twelve vertices of valence 5 is ", math("3 cot 54°/(2 sin 72°) − 1"), " = ",
        readable_percent(pentagon_excess(), 4), ". With mixed areas it is ", readable_percent(fine.H[mixed].linf, 2), " there.");
    const double identity = jittered.finest().H[voronoi].l2;
    if (identity < 0.1 * jittered.finest().H[barycentric].l2) {
        report::extend(t, " With Voronoi areas the sphere is a special case, off by only ", readable_percent(identity, 2),
                       " (L2) even when jittered, for the normal part of ", math("Lx"),
                       " is then exact at any points of a sphere; the other two surfaces are the ones to judge by.");
    }
    return t;
}

report::Text plane_words(const PlaneTest& plane) {
    report::Text t = report::text("Inside an irregular flat square of ", std::to_string(plane.mesh.vertex_count()), " vertices, ",
                                  readable_percent(plane.negative_weights, 2),
                                  " of whose edges have negative weights, the cotangent operator leaves |H| × mean edge at ",
                                  readable(plane.cotangent, 2), ", rounding; the uniform one reads ", readable(plane.uniform),
                                  " where there is no curvature");
    if (plane.clamped > 1e3 * plane.cotangent) {
        report::extend(t, ", and clamping the negative weights makes that ", readable(plane.clamped),
                       " for the cotangent operator too: it gives up linear precision");
    } else {
        report::extend(t, ", and clamping changes nothing (", readable(plane.clamped, 2), ")");
    }
    report::extend(t, ".");
    return t;
}

report::Text flat_words(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    report::Text t = report::text("The mesh ", s.name(), " is flat. ");
    if (s.interior == 0) {
        report::extend(t, "All its vertices lie on the boundary: there is no H to estimate.");
        return t;
    }
    const auto at_most = [](double x) { return x == 0 ? "exactly 0" : "at most " + readable(x, 2); };
    report::extend(t, "Inside, |H| × mean edge is ", at_most(c.precision), " by the cotangent and ", at_most(c.drift),
                   " by the uniform operator");
    if (std::max(c.drift, c.precision) < 1e-4) {   // what six digits of the coordinates leave
        report::extend(t, ": its triangles are so regular that the cotangent weights improve nothing here. ");
    } else if (c.drift > 10 * c.precision) {
        report::extend(t, ", ", readable(c.drift / std::max(c.precision, 1e-300), 2),
                       " times more: there the cotangent weights are the improvement. ");
    } else {
        report::extend(t, ". ");
    }
    report::extend(t, "On its boundary ", math("½‖Lx‖"), " reaches ", readable(c.variants[0].boundary),
                   " per mean edge with half the sum of cotangents and ", readable(c.variants[1].boundary),
                   " with the mean over opposite vertices: a pull along the plane, which a picture without mask would show as curvature.");
    return t;
}

report::Text curved_words(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    if (summary_of(c.difference).count == 0) {
        return report::text("On ", s.name(), " no vertex has a neighbourhood inside the surface, so there is nothing to compare.");
    }
    const OperatorVariant& used = c.variants[0];
    const OperatorVariant& clamped = c.variants[2];
    report::Text t = report::text("On ", s.name(), " the two estimates differ by ", readable_percent(c.rms_difference / c.rms_uniform),
                                  " of the uniform one (rms) and in sign at ", readable_percent(c.sign_change, 2), " of the vertices. ");
    if (c.jump_uniform > 0 && c.jump_cotangent > 0) {
        const double ratio = c.jump_uniform / c.jump_cotangent;
        report::extend(t, "From a vertex to its neighbour H changes by ", readable(c.jump_cotangent), " (rms) with cotangent and by ",
                       readable(c.jump_uniform), " with uniform weights: the cotangent estimate is ",
                       readable(ratio >= 1 ? ratio : 1 / ratio, 2), " times ", ratio >= 1 ? "smoother. " : "rougher. ");
    }
    if (used.negative_inside + used.negative_boundary == 0) {
        report::extend(t, "None of its ", std::to_string(s.topology().edges.size()),
                       " edges has a negative weight, so clamping changes nothing.");
    } else {
        report::extend(t, std::to_string(used.negative_inside + used.negative_boundary), " of its ",
                       counted(static_cast<int>(s.topology().edges.size()), "edge"),
                       used.negative_inside + used.negative_boundary == 1 ? " has" : " have", " a negative weight (",
                       std::to_string(used.negative_boundary), " on the boundary; the smallest is ", readable(used.smallest_weight), ")");
        if (std::isfinite(clamped.change))
            report::extend(t, "; clamping them changes H inside by ", readable_percent(clamped.change, 2), " (rms)");
        report::extend(t, ".");
    }
    if (!s.source->prepared->preflight.closed()) {
        report::extend(t, " On the boundary ", math("½‖Lx‖"), " × mean edge reaches ", readable(used.boundary),
                       ", with the mean over opposite vertices ", readable(c.variants[1].boundary), ", against ", readable(used.inside),
                       " inside: it is masked.");
    }
    return t;
}

report::Text verdict(const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane) {
    int regular_wins = 0, jittered_wins = 0, regular_converging = 0, jittered_converging = 0, surfaces = 0;
    double worst_regular = 0, worst_jittered = 0;
    for (const CotangentRefinement& r : refinements) {
        const bool regular = r.triangulation == Triangulation::regular;
        const bool better = r.finest().H[mixed].l2 < r.finest().uniform.l2, converging = converges(cotangent_H(r, mixed));
        surfaces += regular ? 1 : 0;
        (regular ? regular_wins : jittered_wins) += better ? 1 : 0;
        (regular ? regular_converging : jittered_converging) += converging ? 1 : 0;
        double& worst = regular ? worst_regular : worst_jittered;
        worst = std::max(worst, r.finest().H[mixed].l2);
    }
    const std::string of_surfaces = " of " + counted(surfaces, "surface");
    report::Text t = report::text(report::strong("Does the cotangent discretisation improve the estimate? "),
                                  "On regular triangulations it is the better one on ", std::to_string(regular_wins), of_surfaces,
                                  " (mixed areas) and converges on ", std::to_string(regular_converging), ", with errors up to ",
                                  readable_percent(worst_regular), " at the finest level, which is ", grade(worst_regular), ". ");
    report::extend(
        t, "On jittered ones it is the better one on ", std::to_string(jittered_wins), of_surfaces, " and converges on ",
        std::to_string(jittered_converging), ", with errors up to ", readable_percent(worst_jittered), ", which is ", grade(worst_jittered),
        jittered_converging < surfaces ? ": the weights repair the bias of the uniform average, not the dependence on the triangulation. "
                                       : ". ");
    report::extend(t, "On irregular planes the false curvature falls from ", readable(plane.uniform, 2), " to ",
                   readable(plane.cotangent, 2), " per mean edge.");
    return t;
}

/// Cotangent against uniform over every sequence of meshes of the ground-truth panel, and who does better still.
report::Text panel_words(const GroundTruth& truth) {
    const auto finest = [&](const PanelRun& run, const char* key) { return run.finest(Quantity::H, estimator_index(Quantity::H, key)).l2; };
    int better_than_uniform = 0, jet_better = 0;
    for (const PanelRun& run : truth.runs) {
        better_than_uniform += finest(run, "mixed") < finest(run, "uniform") ? 1 : 0;
        jet_better += finest(run, "jet") < finest(run, "mixed") ? 1 : 0;
    }
    const std::string runs = std::to_string(truth.runs.size());
    const auto told = [&](const char* key) {
        return readable_percent(truth.finest("ellipsoid", MeshKind::random, Quantity::H, key).l2, 2) + " (order " +
               words_of(truth.order("ellipsoid", MeshKind::random, Quantity::H, key)) + ")";
    };
    return report::text("Over the ", runs, " sequences of meshes of the ground-truth panel (", ref("truth"),
                        "), cotangent H with mixed areas is nearer to the truth on the finest mesh than scaled uniform H on ",
                        std::to_string(better_than_uniform), ", and a degree-3 jet nearer than the cotangent operator on ",
                        std::to_string(jet_better), " (tables of L2 errors, from ", ref("truth_errors_regular_l2"),
                        " on). On random points of the ellipsoid the L2 error is ", told("mixed"), " for mixed areas and ", told("jet"),
                        " for the jet (", ref("truth_errors_random_l2"), "; orders in ", ref("truth_orders_random_l2"), ").");
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<CotangentComparison>& meshes,
                    const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane, const GroundTruth& truth) {
    add_heading(section, "Discussion: does this improve the estimate?");
    add_paragraph(section, "L2 error of H on the finest regular meshes: ", gains(refinements, Triangulation::regular),
                  ". With jittered vertices: ", gains(refinements, Triangulation::jittered), " (", ref("q3_errors_l2"), ").");
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        for (const char* surface : {"ellipsoid", "torus"}) {
            section.blocks.push_back(report::Paragraph{convergence_words(refinement_on(refinements, surface, triangulation))});
        }
    }
    section.blocks.push_back(report::Paragraph{sphere_words(refinement_on(refinements, "sphere", Triangulation::regular),
                                                            refinement_on(refinements, "sphere", Triangulation::jittered))});
    section.blocks.push_back(report::Paragraph{plane_words(plane)});
    for (const CotangentComparison& c : meshes)
        section.blocks.push_back(report::Paragraph{c.subject.plane_normal ? flat_words(c) : curved_words(c)});
    section.blocks.push_back(report::Paragraph{panel_words(truth)});
    section.blocks.push_back(report::Paragraph{verdict(refinements, plane)});
}

}   // namespace meshfolio::q3_cotangent
