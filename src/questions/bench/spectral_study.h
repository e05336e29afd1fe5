/// @file
/// What question 4 measures: a mesh rebuilt from its k smoothest eigenvectors, and the error for every k.
#pragma once

#include "geometry/measures/mesh_error.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

struct Reconstruction {
    int k = 0;
    TriangleMesh mesh;
    Vector distance;             // n, |x_i − x_i^(k)| [length]
    MeshDifference difference;   // against the original
    double predicted_rms = 0;    // area-weighted, from the coefficients alone [length]
};

struct SpectralStudy : OnMesh {
    double diagonal = 0;   // of the bounding box [length]
    LaplaceBeltrami laplacian;
    Spectrum spectrum;
    SpectrumCertificate certificate;               // measured anew, whatever the solver says
    Vector rms;                                    // entry k: predicted error of k modes [length]
    std::vector<Reconstruction> reconstructions;   // ascending k
    double seconds = 0;                            // of the eigensolve

    int modes() const { return static_cast<int>(spectrum.eigenvalues.size()); }
    int vertices() const { return source->preflight().vertices_in_use; }
};

/// The k of the settings, else those of the assignment, 5, 15 and large, with steps in between; of n modes.
std::vector<int> mode_counts(const QuestionSettings& settings, int n);

/// Solves once for the k of the settings, else 5, 15 and large as in the assignment, with steps between.
SpectralStudy spectral_study(SharedMesh source, const QuestionSettings& settings);

/// Smallest k whose error is at most `share` of the box diagonal; 0 when no k that was computed reaches it.
int smallest_k_below(const SpectralStudy& study, double share);

/// error ≈ factor·k^−power over k = first … last: least squares over all of them, in logarithms.
struct PowerLaw {
    int first = 0, last = 0;
    double factor = 0, power = 0;   // factor [length]
    double deviation = 0;           // largest factor between the law and an error it was fitted to
    double at(double k) const;
};
/// @param a, b  a < b
PowerLaw power_law(const SpectralStudy& study, int a, int b);
/// Fits from the first k asked for to half of all modes, as far as errors are not rounding. None with fewer than five k.
std::optional<PowerLaw> fall_of_the_error(const SpectralStudy& study);

/// Share of the vertices that are farther from their places with `later` than with `earlier`, by more than rounding.
double share_made_worse(const SpectralStudy& study, const Reconstruction& earlier, const Reconstruction& later);

/// Modes of eigenvalue 0: they say where each component is, and nothing of its shape.
int zero_modes(const SpectralStudy& study);
/// Wavelength 2π/√μ of a mode, counted from 1; infinite for a zero mode. [length]
double wavelength(const SpectralStudy& study, int mode);

/// ‖φ_iᵀMX‖/√ΣM of each mode: what it contributes to the rms distance from the origin. The squares beyond k add up to the squared error of
/// k modes. [length]
Vector coefficient_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// Weyl's law for the k-th eigenvalue of a surface with a free boundary of this length, from 4πk ≈ area μ + boundary √μ; 4πk/area where it
/// is closed. [1/length²]
double weyl_eigenvalue(double k, double area, double boundary);
/// The same for the mesh of a study.
double weyl_eigenvalue(const SpectralStudy& study, int k);

/// How far from the centroid the worst-placed 5 % of the vertices are, over how far an average vertex is.
double remoteness_of_worst(const SpectralStudy& study, const Reconstruction& r);

/// Largest |predicted − measured rms| of the reconstructions. [length]
double largest_parseval_gap(const SpectralStudy& study);

}   // namespace meshfolio
