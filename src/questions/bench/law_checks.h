/// @file
/// Named checks of what must hold for every mesh, operator and spectrum. The questions, the certificates and the planted faults all use
/// these: that the checks can fail is shown by the same functions that pass in the report.
#pragma once

#include <string>
#include <vector>

#include "geometry/spectrum/spectrum_certificate.h"
#include "report/document.h"

namespace meshfolio {

/// The names of the checks, before " on <mesh>".
namespace law {
// of an operator
inline constexpr const char* symmetric = "C is symmetric: largest |C − Cᵀ| / largest |C|";
inline constexpr const char* row_sums = "rows of C sum to 0: largest |row sum| / largest |C|";
inline constexpr const char* energy = "Dirichlet energy of the positions / area = 1";
inline constexpr const char* first_variation = "CX = −∇area: largest relative deviation at a vertex";
inline constexpr const char* mass = "ΣM / area = 1";
inline constexpr const char* semidefinite = "−C ⪰ 0: negative eigenvalues, by inertia";
// of a surface
inline constexpr const char* half_edges = "orientation: half-edges used more than once";
inline constexpr const char* flux = "area vectors of a closed surface sum to 0: |Σ A n| / area";
inline constexpr const char* outward = "normals point outwards: volume / box volume > 0";
inline constexpr const char* gauss_bonnet = "Gauss–Bonnet: |Σ deficits / 2π − χ|";
// of a spectrum
inline constexpr const char* residual = "largest eigenpair residual";
inline constexpr const char* orthonormal = "‖ΦᵀMΦ − I‖";
inline constexpr const char* parseval = "Parseval: |‖x‖² − Σ|ĉ|² − ‖x − Φĉ‖²| / ‖x‖²";
inline constexpr const char* complete = "no eigenvalue missed: counted below σ by inertia − found";
inline constexpr const char* zeros = "zero eigenvalues = components";
inline constexpr const char* ascending = "eigenvalues ascend: largest step down / largest eigenvalue";
}   // namespace law

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
