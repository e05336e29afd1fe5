/// @file
/// The estimators of curvature. A new one is a file in estimators/, a line in estimators.cpp and a name in templates/words/curvature.md: it
/// is then in the tables of the ground truth, and in the errors of question 3 where `in_q3` names a column. What the plots of the ground
/// truth show is chosen in truth/tables.cpp.
#pragma once

#include <array>
#include <span>

#include "geometry/operators/vertex_areas.h"
#include "questions/bench/bench_mesh.h"
#include "questions/bench/known_surfaces.h"

namespace meshfolio {

enum class Quantity { H, K };
inline std::string symbol(Quantity quantity) { return quantity == Quantity::H ? "H" : "K"; }

struct Estimator {
    std::string_view key;     // "H.mixed": the quantity, then what it comes from
    std::string_view words;   // the key of its name in curvature.md: "cotangent.mixed"
    Quantity quantity;
    Vector (*estimate)(const BenchMesh& mesh);   // n values, positive on a sphere, NaN where there is none [1/length], [1/length²]
    bool in_panel = true;                        // false: measured, but without a row in the ground-truth panel
    std::string_view in_q3 = {};                 // its column in the errors of question 3; empty: none

    std::string name() const { return curvature_words.line(words); }   // "cotangent ½‖Δx‖, mixed"
};

/// All, in the order of all tables.
std::span<const Estimator* const> estimators();
std::vector<const Estimator*> panel_estimators(Quantity quantity);
/// @throws std::logic_error for an unknown key
const Estimator& estimator(std::string_view key);

/// The areas that the cotangent operator and the angle deficit are estimated with.
inline constexpr std::array area_forms{AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed};
std::string area_name(AreaForm form);   // "Voronoi", for prose and tables
// The keys of the estimators with these areas.
inline std::string H_with(AreaForm form) { return "H." + std::string(name_of(form)); }
inline std::string K_with(AreaForm form) { return "K." + std::string(name_of(form)); }

}   // namespace meshfolio
