/// @file
/// What question 4 does with the modes beyond rebuilding: bands amplified, a low-pass without modes, and the mistaken ways beside the right
/// one; and why thin parts suffer first.
#pragma once

#include <string>
#include <vector>

#include "geometry/spectrum/chebyshev_filter.h"
#include "geometry/spectrum/spectral_filter.h"
#include "questions/bench/spectral_study.h"

namespace meshfolio {

// ---- frequency bands ----------------------------------------------------------------------------------------------------

/// Modes first … last, counted from 1.
struct Band {
    std::string name;
    int first = 0, last = 0;
    double energy_share = 0;   // of Σ|ĉ|² over the modes known that are not zero modes
};

struct EqualisedMesh {
    std::string id, label;
    TriangleMesh mesh;
    Vector distance;            // n, how far each vertex moved [length]
    double predicted_rms = 0;   // area-weighted, from the coefficients alone [length]
    double measured_rms = 0;    // area-weighted [length]
};

struct BandStudy {
    std::vector<Band> bands;   // low, middle, high; empty where there are too few modes to part
    std::vector<EqualisedMesh> meshes;
};
BandStudy band_study(const SpectralStudy& study);

// ---- low-pass by products -------------------------------------------------------------------------------------------------

/// Area-weighted rms distance to the exact filter of the same kind. [length]
struct LowPassError {
    int degree = 0;
    double ideal = 0, smooth = 0;
    double ideal_from_response = 0;   // of the part of the known modes, Σ (p(μ_i) − [i ≤ k])² |ĉ_i|²
    double operations = 0;
};

struct LowPassStudy {
    int k = 0;                          // modes below the cutoff; 0: too few modes to study one
    double cutoff = 0;                  // in the widest gap near k [1/length²]
    double bound = 0;                   // Gershgorin's, of the spectrum [1/length²]
    double unknown = 0;                 // what the modes not computed add at most to the exact smooth filter [length]
    std::vector<LowPassError> errors;   // ascending degree
    double seconds = 0;                 // of all products
};
LowPassStudy low_pass_study(const SpectralStudy& study, bool quick);

// ---- mistakes -------------------------------------------------------------------------------------------------------------

/// rms over the vertices. [length]
struct MistakeErrors {
    int k = 0;
    double right = 0, unmapped = 0, unweighted = 0, edge_normalised = 0;   // the last NaN where its operator has no such modes
};

struct MistakeStudy {
    std::vector<MistakeErrors> errors;   // ascending k
    int pictured = 0;                    // k of the meshes below
    std::vector<EqualisedMesh> meshes;   // right, then the mistakes
};
MistakeStudy mistake_study(const SpectralStudy& study, bool quick);

// ---- thin parts -----------------------------------------------------------------------------------------------------------

/// Of one reconstruction: rms over the area of the vertices concerned. [length]
struct LimbErrors {
    int k = 0;
    double thin = 0, thick = 0;    // the thinnest and the thickest quarter of the area
    double far_share = 0;          // of Σ A|x − x_k|², on the tenth of the area that is farthest from the centroid
    double rank_correlation = 0;   // Spearman's, between thickness and error
};

struct LimbStudy {
    double thin_diameter = 0, thick_diameter = 0;   // median of the quarter [length]; NaN for a surface that encloses nothing
    int modes_needed = 0;   // first mode with μ ≥ 4/d², whose wavelength goes once round a limb of the thin diameter; 0: beyond those known
    std::vector<LimbErrors> errors;   // ascending k, those that are not rounding
    bool measured() const { return thin_diameter > 0 && !errors.empty(); }
};
LimbStudy limb_study(const SpectralStudy& study);

// ---- cost -----------------------------------------------------------------------------------------------------------------

/// Counted, not timed: what k modes take at least, whatever Krylov method finds them.
struct ModeCost {
    int k = 0;
    double solve_operations = 0;           // k solves with the factor
    double orthogonalise_operations = 0;   // each vector once against all before it
    double rebuild_operations = 0;         // Φ(ΦᵀMX)
    double megabytes = 0;                  // of Φ
};
/// @param factor_entries  of a Cholesky factor of −C + σM
ModeCost mode_cost(int k, double n, double factor_entries);
double factor_entries(const SpectralStudy& study);

/// All of the above for one mesh.
struct SpectralUses {
    BandStudy bands;
    LowPassStudy low_pass;
    MistakeStudy mistakes;
    LimbStudy limbs;
    double factor_entries = 0;
};
SpectralUses spectral_uses(const SpectralStudy& study, const QuestionSettings& settings);

}   // namespace meshfolio
