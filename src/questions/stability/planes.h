/// @file
/// Explicit and implicit smoothing over the plane of steps λ and iterations t.
#pragma once

#include "questions/bench/smoothing_study.h"

namespace meshfolio::stability {

/// One quantity over the plane, row by row of iteration counts; NaN where the run had blown up or nothing is left to measure.
using PlaneValues = std::vector<double>;

struct SchemeMap {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    PlaneValues moved;          // rms distance from the input over the box diagonal
    PlaneValues error;          // the same from the clean mesh; empty: not known
    PlaneValues size;           // volume over that of the input, of an open mesh area over area
    PlaneValues angle;          // smallest [rad]
    PlaneValues inverted;       // share of the triangles that face away from their first normals
    PlaneValues apart;          // of the implicit scheme, below half the limit: rms distance from the explicit result over `moved`
    std::vector<int> blow_up;   // iteration, one a λ; 0: none
    int analyses = 0, factorisations = 0;

    std::string name() const { return scheme == SmoothingScheme::explicit_euler ? "explicit" : "implicit"; }
};

/// When a run beyond the limit blows up, from the modes that grow: t steps take mode i to a height of |1 − λμ_i|ᵗ times that of the input,
/// |⟨X, φ_i⟩_M| max|φ_i|, and the run ends where a vertex is as far away as `distance`.
struct GrowingModes {
    Vector eigenvalues;    // [1/length²]
    Vector heights;        // of the input [length]
    double rounding = 0;   // of coordinates: no run has less of a mode than this [length]
    double distance = 0;   // [length]

    /// The iteration (not rounded up) where the first single mode reaches `distance`; rounding counts as height. NaN: none grows.
    double blow_up(double lambda) const;
    /// The same for modes above rounding only; symmetry or cancellation cannot stop their growth.
    double latest(double lambda) const;
    /// The first of `last` iterations where all modes together can reach `distance`; 0: none.
    int earliest(double lambda, int last) const;
};

/// A place of the plane that a picture shows. a: explicit, the last stable step, all iterations; b: the first unstable one, while it stays
/// in view; c: implicit, there; d: implicit, the largest step, while a twentieth of the size is left (or after one measured count); e and
/// f: explicit and implicit, nearest to the clean mesh.
struct MapPlace {
    std::string letter;
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    std::size_t step = 0, row = 0;   // in lambdas and iterations
    Positions X;
};

struct SmoothingMaps {
    SmoothingSubject subject;
    std::optional<TriangleMesh> clean;   // the mesh before its noise was added, where the program made it
    double input_error = 0;              // rms distance of the input from it over the box diagonal
    bool closed = false;
    std::vector<double> lambdas;   // [length²]
    std::vector<int> iterations;
    SchemeMap explicit_map, implicit_map;
    GrowingModes top;                  // the top mode alone
    std::optional<GrowingModes> all;   // every mode, of a small mesh
    std::vector<MapPlace> places;

    const std::string& name() const { return subject.name(); }
    std::array<const SchemeMap*, 2> maps() const { return {&explicit_map, &implicit_map}; }
    const SchemeMap& map_of(SmoothingScheme scheme) const {
        return scheme == SmoothingScheme::explicit_euler ? explicit_map : implicit_map;
    }
    /// Every mode of a small mesh, else the top one.
    const GrowingModes& known_modes() const { return all ? *all : top; }
    /// A cell, and where it lies.
    std::size_t index(std::size_t step, std::size_t row) const { return row * lambdas.size() + step; }
    std::size_t step_of(std::size_t cell) const { return cell % lambdas.size(); }
    std::size_t row_of(std::size_t cell) const { return cell / lambdas.size(); }
    double relative(std::size_t step) const { return lambdas[step] / subject.critical; }
    /// Index of the cell with the smallest error from the clean mesh.
    std::optional<std::size_t> best(const SchemeMap& map) const;
};

/// Runs the steps of the settings, else a logarithmic grid with the explicit limit between two steps; iteration counts up to the last of
/// the settings, spaced alike.
SmoothingMaps smoothing_maps(SharedMesh source, const QuestionSettings& settings);

/// Two cells of one scheme with the same diffusion time λt, reached in many small steps and in few large ones.
struct EqualTime {
    std::size_t many = 0, few = 0;   // cells
    double difference = 0;           // of the rms motion, many over few, less 1
};
/// Finds the pair with tenfold iteration counts that differs most, neither blown up; `few` = `many`: none.
EqualTime largest_difference_at_equal_time(const SmoothingMaps& maps, const SchemeMap& map);

/// 1, 2, 3, 5, 8, … with `per_decade` counts a factor of ten, the last one included.
std::vector<int> spaced_iterations(int last, int per_decade);

}   // namespace meshfolio::stability
