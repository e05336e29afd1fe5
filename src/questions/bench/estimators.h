/// @file
/// The estimators of curvature. A new one is a line of the table in estimators.cpp and a name in templates/words/curvature.md: the tables
/// of the ground truth show it then, and the errors of question 3 if `in_q3` names a column. truth/tables.cpp chooses those of its plots.
#pragma once

#include <array>
#include <span>

#include "geometry/operators/vertex_areas.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio {

enum class Quantity { H, K };
inline std::string symbol(Quantity quantity) { return quantity == Quantity::H ? "H" : "K"; }

struct Estimator {
    std::string_view key;     // "H.mixed": the quantity and the source
    std::string_view words;   // the key of its name in curvature.md: "cotangent.mixed"
    Quantity quantity;
    Vector (*estimate)(const BenchMesh& mesh);   // n values, positive on a sphere, NaN where undefined; H [1/length], K [1/length²]
    bool in_panel = true;                        // false: measured, but without a row in the ground-truth panel
    std::string_view in_q3 = {};                 // its column in the errors of question 3; empty: none

    std::string name() const { return curvature_words.line(words); }   // "cotangent ½‖Δx‖, mixed"
};

/// Returns all estimators, in the order of all tables.
std::span<const Estimator> estimators();
/// Returns the estimators of one quantity that have a row in the ground-truth panel.
std::vector<const Estimator*> panel_estimators(Quantity quantity);
/// Returns the estimator with this key. @throws std::logic_error for an unknown key
const Estimator& estimator(std::string_view key);

/// The vertex areas that the cotangent operator and the angle deficit are estimated with.
inline constexpr std::array area_forms{AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed};
/// The area form of the figures and texts that show a single one; later questions use it in the mass matrix.
inline constexpr AreaForm areas_used = AreaForm::barycentric;
/// Returns the name of the areas in prose and tables: "Voronoi".
std::string area_name(AreaForm form);
/// Return the keys of the cotangent H and of the angle-deficit K with these areas: "H.mixed", "K.mixed".
inline std::string H_with(AreaForm form) { return "H." + std::string(name_of(form)); }
inline std::string K_with(AreaForm form) { return "K." + std::string(name_of(form)); }

}   // namespace meshfolio
