/// @file
/// Named checks of laws that hold for every mesh, operator and spectrum. The questions, the certificates and the planted faults use the
/// same functions, so the checks that pass in the report are those that fail on the faults.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/spectrum/spectrum_certificate.h"
#include "report/document.h"
#include "report/words.h"

namespace meshfolio {

inline constexpr report::Words spectral_words("spectra");

/// Returns the law of this key in words, with an ending: law("row_sums", " on cube").
inline std::string law(std::string_view key, const std::string& on = "") { return spectral_words.line("law." + std::string(key)) + on; }

/// Returns "it cannot be proved here: …", the note of an undecided check. Both numbers are in units of the eigenvalue.
std::string cannot_be_proved(double rounding, double gap);

/// Returns six checks of a spectrum by its certificate: residual, orthonormality, Parseval, completeness, zeros, ascending order.
/// Completeness is undecided if the rounding of a count exceeds its gap.
/// @param on    the ending of the names: " on cube"
/// @param note  the reason why a limit may be hard to reach
std::vector<report::Check> spectrum_checks(const SpectrumCertificate& certificate, const std::string& on, const std::string& note = "");

/// Checks C and M as the unclamped cotangent operator of this mesh: symmetry, row sums, mass, semidefiniteness, energy, first variation.
/// The last two are left out if there are triangles without area, where the area has no gradient.
/// @param without_area  the number of such triangles
std::vector<report::Check> operator_checks(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const std::string& on,
                                           int without_area = 0);

/// The properties of a surface that decide which laws it must satisfy.
struct SurfaceClaims {
    bool manifold = true, orientable = true, closed = true;
    int euler_characteristic = 2;
};
/// Checks a manifold surface: orientation if it is orientable, flux and outward volume if it is also closed, and Gauss–Bonnet. Returns no
/// checks of a surface that is not manifold.
std::vector<report::Check> surface_checks(const TriangleMesh& mesh, const Vector& angle_deficits, const SurfaceClaims& claims,
                                          const std::string& on);

}   // namespace meshfolio
