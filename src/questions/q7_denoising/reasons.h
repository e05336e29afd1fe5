/// @file
/// Why denoising can work: shape and noise mode by mode, and the error of one noisy mesh as the sum of the noise left and the shape lost.
#pragma once

#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

/// Coefficients |Φᵀ M X| of the clean mesh and |Φᵀ M N| of the noise of a trial: rms over bands of modes, in units of the noise that one
/// mode is expected to hold, σ √(3 ΣM/n). That is the mean over all modes exactly: E|Φᵀ M N|² = 3σ² tr(ΦᵀM²Φ), ΦΦᵀ = M⁻¹.
struct ModeBands {
    std::vector<double> mu;             // geometric mean of the band [1/h̄²]
    std::vector<double> shape, noise;   // [noise of a mode]
    std::vector<double> kept;           // of a mode of this μ by the best smoothing with the same operator, (1 + λμ)⁻ᵗ
    int modes = 0, above = 0;           // without the constant ones; of waves longer than at the crossing
    bool all = false;                   // all modes of the mesh

    bool crosses() const { return above > 0 && above < modes; }
    double crossing = NAN;                                               // μ where shape falls below noise, between bands [1/h̄²]
    double wavelength() const { return 2 * pi / std::sqrt(crossing); }   // [h̄]
};

/// Surface distance over the amount of smoothing. [h̄]
struct ErrorCurve {
    std::vector<double> amount, error;   // λt, ascending from 0 [h̄²]
    std::size_t least() const { return std::ranges::min_element(error) - error.begin(); }
};

/// With the operator S of the clean mesh, which is linear and knows nothing of the noise N: S(X + N) − X = SN + (SX − X), the noise left
/// and the shape lost. All along the vertex normals of the clean mesh, where displacements add up, as distances to a surface do not.
struct ErrorParts {
    ErrorCurve total, noise, shape;   // of the same amounts
    ErrorCurve surface;               // surface distance of the smoothed clean mesh, likewise
    double best_lambda = 0;           // of the least total [h̄²]
    int best_step = 0;                // 0: the noisy mesh itself

    /// Largest |(noise² + shape²)/error² − 1| up to twice the best amount: 0 in the mean over the noise.
    double deviation_of_sum() const;
};

/// Both for pictured() of one mesh, the smallest of those that gain, so that its modes are cheap.
struct Reasons {
    const DenoisingGrid* grid = nullptr;
    ModeBands bands;                  // none where the modes were not found
    ErrorParts parts;                 // of pictured()
    std::vector<ErrorCurve> levels;   // of each trial
};

/// Do the curves approach that of the clean mesh beyond their minima, as the noise goes?
bool joins_the_clean(const Reasons& reasons);

/// The runs of all λ as one curve: of each but the smallest from its third step on, where the runs before have not come.
ErrorCurve error_curve(const DenoisingGrid& grid, const NoisyTrial& trial);
/// @param noisy  smoothed beside the clean mesh, with its operator and every λ of the grid
ErrorParts error_parts(const DenoisingGrid& grid, const TriangleMesh& noisy);
/// All modes of small meshes, else the smoothest. @param parts  of this trial @throws SolverError
ModeBands mode_bands(const DenoisingGrid& grid, const NoisyTrial& trial, const ErrorParts& parts);
Reasons reasons_of(const std::vector<DenoisingGrid>& grids);

}   // namespace meshfolio::q7_denoising
