/// @file
/// What question 4 tells of its modes beside the error: why thin parts suffer first. And ways of rebuilding that
/// look right and are not, for the claims.
#pragma once

#include "questions/bench/spectral_study.h"

namespace meshfolio {

// ---- mistakes -------------------------------------------------------------------------------------------------------------

/// rms over the vertices. [length]
struct MistakeErrors {
    int k = 0;
    double right = 0, unmapped = 0, unweighted = 0, edge_normalised = 0;   // the last NaN where its operator has no such modes
};
/// Ascending k.
std::vector<MistakeErrors> mistake_study(const SpectralStudy& study, bool quick);

// ---- thin parts -----------------------------------------------------------------------------------------------------------

/// An error of this share of the box diagonal is visible in a picture of the whole mesh.
inline constexpr double seen_error = 0.01;

/// Errors of one reconstruction on thin and thick parts: rms over the area of their vertices. [length]
struct LimbErrors {
    int k = 0;
    double thin = 0, thick = 0;   // the thinnest and the thickest quarter of the area
    double seen_on_thin = 0;      // of the area that is off by more than seen_error, the share on the thinner half; NaN: nothing is
};

struct LimbStudy {
    double thin_diameter = 0, thick_diameter = 0;   // median of the quarter [length]; NaN for a surface that encloses nothing
    std::vector<LimbErrors> errors;                 // ascending k, those that are not rounding
    bool measured() const { return thin_diameter > 0 && !errors.empty(); }
};
LimbStudy limb_study(const SpectralStudy& study);

}   // namespace meshfolio
