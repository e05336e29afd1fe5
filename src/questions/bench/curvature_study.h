/// @file
/// What the questions on curvature share: the meshes they look at, their colours, and words for how an error behaves.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/draw/figure_request.h"
#include "questions/bench/known_surfaces.h"
#include "questions/core/chapter.h"
#include "questions/core/mesh_library.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

/// A mesh whose curvature is estimated.
struct CurvatureSubject {
    std::shared_ptr<const LibraryMesh> source;
    double diagonal = 0;                   // of the bounding box [length]
    double mean_edge = 0;                  // [length]
    int interior = 0;                      // vertices in use, manifold and not on the boundary
    std::optional<Vector3> plane_normal;   // unit; set when all vertices in use lie in one plane
    Positions centred;                     // n × 3, about the box centre [length]
    Positions uniform;                     // n × 3, Δ_uniform x, boundary included [length]

    const TriangleMesh& mesh() const { return source->mesh(); }
    const MeshTopology& topology() const { return source->prepared->topology; }
    const std::string& name() const { return source->name; }
    bool inside(int vertex) const;   // in use, manifold and not on the boundary
};
CurvatureSubject curvature_subject(std::shared_ptr<const LibraryMesh> source);

/// The unit normal of the plane all vertices in use lie in, to 1e-6 box diagonals; nothing when they do not.
std::optional<Vector3> common_plane_normal(const TriangleMesh& mesh);

/// Largest |value| over the finite values whose vertex satisfies `chosen`; 0 when there is none.
template <class Predicate>
double largest_magnitude(const Vector& values, Predicate chosen) {
    double largest = 0;
    for (int i = 0; i < values.size(); ++i) {
        if (chosen(i) && std::isfinite(values[i])) largest = std::max(largest, std::abs(values[i]));
    }
    return largest;
}
double largest_magnitude(const Vector& values);

/// A thousand quantiles of each panel's finite values: in a range over them every mesh weighs the same, however many vertices it has.
std::vector<output::Panel> equally_weighted(const std::vector<output::Panel>& panels);

/// `shared` with the clipped shares of these panels alone: several figures have one range, each says what it clips.
output::ColorRange range_for(const output::ColorRange& shared, const std::vector<output::Panel>& panels);

/// Robust range of unsigned values, from 0 on, with the clipped shares of the panels.
output::ColorRange range_from_zero(const std::vector<output::Panel>& panels, std::string colormap, std::string quantity, double floor);

std::string name_of(Triangulation triangulation);   // "regular", "jittered"

/// " 12 vertices on the boundary … are drawn in the colour for undefined values.", or nothing: for captions.
std::string undefined_words(const CurvatureSubject& subject);

/// A relative error over a refinement. Words and order are about the (up to) three finest meshes.
struct ErrorHistory {
    std::vector<double> mean_edges, errors;   // coarse to fine
    double first() const { return errors[errors.size() > 3 ? errors.size() - 3 : 0]; }
    double last() const { return errors.back(); }
    double order() const { return fitted_order(mean_edges, errors); }
};
/// "falls from 3.1 % to 0.05 % (order 1.98)", "stays near 14.6 %, … ", "grows from … to …".
std::string trend(const ErrorHistory& history);
bool converges(const ErrorHistory& history);   // order ≥ 0.5

/// "good" below 1 %, "fair" below 5 %, "rough" below 20 %, "useless" beyond.
std::string grade(double relative_error);

/// The estimates of `Level` (which has a mean_edge) on one known surface, coarse to fine.
template <class Level>
struct Refinement {
    KnownSurface surface;
    Triangulation triangulation = Triangulation::regular;
    std::vector<Level> levels;

    const Level& finest() const { return levels.back(); }
    const Level& second_finest() const { return levels[levels.size() - 2]; }
    std::string title() const { return surface.name + ", " + name_of(triangulation); }
    template <class Pick>
    ErrorHistory history(Pick error_of) const {
        ErrorHistory history;
        for (const Level& level : levels) {
            history.mean_edges.push_back(level.mean_edge);
            history.errors.push_back(error_of(level));
        }
        return history;
    }
};

/// Measures every known surface at every level, first regular, then jittered.
template <class Level>
std::vector<Refinement<Level>> refine_known_surfaces(const QuestionSettings& settings, const Progress& progress, const std::string& what,
                                                     Level (*measure)(const SampledSurface&)) {
    std::vector<Refinement<Level>> refinements;
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        for (KnownSurface& surface : known_surfaces()) {
            Refinement<Level> r{std::move(surface), triangulation, {}};
            progress(what + " on the " + r.title() + " mesh");
            for (const int level : refinement_levels(settings.quick)) {
                r.levels.push_back(measure(sampled(r.surface, level, triangulation, settings.seed)));
            }
            refinements.push_back(std::move(r));
        }
    }
    return refinements;
}

template <class Level>
const Refinement<Level>& refinement_on(const std::vector<Refinement<Level>>& refinements, const std::string& surface,
                                       Triangulation triangulation) {
    return *std::find_if(refinements.begin(), refinements.end(),
                         [&](const Refinement<Level>& r) { return r.surface.name == surface && r.triangulation == triangulation; });
}

/// One series of a log–log plot of errors in %.
report::Series error_series(std::string name, const ErrorHistory& history, report::Series::Style style);

}   // namespace meshfolio
