/// @file
/// The measurements of question 4: a mesh rebuilt from its k smoothest eigenvectors and the error for every k, thin parts and thick ones,
/// and wrong ways of rebuilding.
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
    SpectrumCertificate certificate;               // measured independently of the solver
    Vector rms;                                    // entry k: predicted error of k modes [length]
    std::vector<Reconstruction> reconstructions;   // ascending k
    double seconds = 0;                            // of the eigensolve

    int modes() const { return static_cast<int>(spectrum.eigenvalues.size()); }
    int vertices() const { return source->preflight().vertices_in_use; }
};

/// Returns the k of the settings, else 5, 15, 30, 60, 150 and a large one (n up to 700 vertices, else 300); quick: 5, 15, 60. Each is at
/// least 1 and at most n; ascending.
std::vector<int> mode_counts(const QuestionSettings& settings, int n);

/// Solves once for the largest of the mode_counts() and rebuilds the mesh from each.
SpectralStudy spectral_study(SharedMesh source, const QuestionSettings& settings);

/// Returns the smallest k with an error of at most `share` of the box diagonal; 0 if no computed k reaches it.
int smallest_k_below(const SpectralStudy& study, double share);

/// The law error ≈ factor·k^−power over k = first … last.
struct PowerLaw {
    int first = 0, last = 0;
    double factor = 0, power = 0;   // factor [length]
    double deviation = 0;           // largest factor between the law and an error it was fitted to
    double at(double k) const;
};
/// Fits the law over k = a … b by least squares in logarithms. @param a, b  a < b
PowerLaw power_law(const SpectralStudy& study, int a, int b);
/// Fits the law from the smallest k of the reconstructions, at least 2, to the computed k up to half the number of vertices, without
/// errors at the end that are rounding. Nothing for fewer than five k.
std::optional<PowerLaw> fall_of_the_error(const SpectralStudy& study);

/// Returns the share of the vertices that are farther from their places with `later` than with `earlier`, by more than rounding.
double share_made_worse(const SpectralStudy& study, const Reconstruction& earlier, const Reconstruction& later);

/// Counts the modes of eigenvalue 0, which give the place of each component and nothing of its shape.
int zero_modes(const SpectralStudy& study);
/// Computes the wavelength 2π/√μ of a mode, counted from 1; infinite for a zero mode. [length]
double wavelength(const SpectralStudy& study, int mode);

/// Computes ‖φ_iᵀMX‖/√ΣM of each mode, its part of the rms distance from the origin. The squares beyond k add up to the squared error of k
/// modes. [length]
Vector coefficient_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// Predicts the k-th eigenvalue by Weyl's law for a surface with a free boundary of this length: 4πk ≈ area μ + boundary √μ. [1/length²]
double weyl_eigenvalue(double k, double area, double boundary);
/// Predicts the k-th eigenvalue of the mesh by Weyl's law with its area and the length of its boundary. [1/length²]
double weyl_eigenvalue(const SpectralStudy& study, int k);

/// Returns the largest |predicted − measured rms| of the reconstructions. [length]
double largest_parseval_gap(const SpectralStudy& study);

// ---- thin parts -----------------------------------------------------------------------------------------------------------

inline constexpr double seen_error = 0.01;   // share of the box diagonal that is visible in a picture of the whole mesh

/// Errors of one reconstruction on thin and thick parts: rms over the area of their vertices. [length]
struct LimbErrors {
    int k = 0;
    double thin = 0, thick = 0;   // the thinnest and the thickest quarter of the area
    double seen_on_thin = 0;      // share of the thinner half in the area that is off by more than seen_error; NaN: there is none
};

struct LimbStudy {
    double thin_diameter = 0, thick_diameter = 0;   // medians of the quarters [length]; 0 for a surface that encloses nothing
    std::vector<LimbErrors> errors;                 // ascending k, without those that are rounding
    bool measured() const { return thin_diameter > 0 && !errors.empty(); }
};
/// Compares the errors of the reconstructions on thin and thick parts; measured() is false for open meshes and for fewer than 20 vertices
/// with a thickness.
LimbStudy limb_study(const SpectralStudy& study);

}   // namespace meshfolio
