/// @file
/// Named checks of what must hold for every mesh, operator and spectrum. The questions, the certificates and the planted faults use the
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

/// What must hold, for people: law("row_sums", " on cube").
inline std::string law(std::string_view key, const std::string& on = "") { return spectral_words.line("law." + std::string(key)) + on; }

/// "it cannot be proved here: …", for the note of an undecided check. Both in units of the eigenvalue.
std::string cannot_be_proved(double rounding, double gap);

/// @param on     " on cube": what the names end with
/// @param note   why a limit may be hard to reach
/// Completeness and definiteness are undecided where rounding of a count exceeds its gap.
std::vector<report::Check> spectrum_checks(const SpectrumCertificate& certificate, const std::string& on, const std::string& note = "");

/// Of C and M as the cotangent operator of this mesh, unclamped. Triangles without area have no normal, and so the area no gradient there:
/// energy and first variation are left out.
std::vector<report::Check> operator_checks(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const std::string& on,
                                           int without_area = 0);

/// What a surface claims to be, and so must satisfy.
struct SurfaceClaims {
    bool manifold = true, orientable = true, closed = true;
    int euler_characteristic = 2;
};
/// Orientation where the surface has one, flux and volume where it is closed too, Gauss–Bonnet where it is manifold.
std::vector<report::Check> surface_checks(const TriangleMesh& mesh, const Vector& angle_deficits, const SurfaceClaims& claims,
                                          const std::string& on);

}   // namespace meshfolio
