#include "geometry/curvature/fundamental_forms.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

void require_ellipsoid(const Ellipsoid& ellipsoid) {
    const Vector3 axes(ellipsoid.a, ellipsoid.b, ellipsoid.c);
    if (axes.allFinite() && axes.minCoeff() > 0) return;
    throw MeshError("ellipsoid_forms: half axes must be finite and > 0, not " + std::to_string(ellipsoid.a) + ", " +
                    std::to_string(ellipsoid.b) + ", " + std::to_string(ellipsoid.c));
}

void require_regular_point(double u, double v) {
    const std::string where = "(u, v) = (" + std::to_string(u) + ", " + std::to_string(v) + ")";
    if (!std::isfinite(u) || !(v >= 0 && v <= pi))
        throw MeshError("ellipsoid_forms: " + where + " is outside the parameter domain", "u is any angle, v lies in [0, π]");
    if (std::sin(v) < 1e-12) {
        throw MeshError("ellipsoid_forms: " + where +
                            " is a pole, (0, 0, ±c), where p_u = 0 and the first fundamental form is singular: a fault of the "
                            "coordinates, not of the surface",
                        "the point (a, 0, 0) is u = 0, v = π/2");
    }
}

/// Weights of f(−2h), f(−h), f(0), f(h), f(2h) in f′h and f″h²; both have an error of order h⁴.
constexpr std::array<double, 5> first_derivative{1.0 / 12, -8.0 / 12, 0, 8.0 / 12, -1.0 / 12};
constexpr std::array<double, 5> second_derivative{-1.0 / 12, 16.0 / 12, -30.0 / 12, 16.0 / 12, -1.0 / 12};
constexpr std::array<double, 5> no_derivative{0, 0, 1, 0, 0};

/// Returns the vector at unit length, its largest entry positive.
Vector3 as_direction(const Vector3& tangent) {
    Eigen::Index largest = 0;
    tangent.cwiseAbs().maxCoeff(&largest);
    const Vector3 unit = tangent.normalized();
    return unit[largest] < 0 ? Vector3(-unit) : unit;
}

}   // namespace

Vector3 ellipsoid_point(const Ellipsoid& ellipsoid, double u, double v) {
    return {ellipsoid.a * std::cos(u) * std::sin(v), ellipsoid.b * std::sin(u) * std::sin(v), ellipsoid.c * std::cos(v)};
}

FundamentalForms ellipsoid_forms(const Ellipsoid& ellipsoid, double u, double v) {
    require_ellipsoid(ellipsoid);
    require_regular_point(u, v);
    const auto [a, b, c] = ellipsoid;
    const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
    const Vector3 outward(b * c * sv * cu, a * c * sv * su, a * b * cv);
    const double D = outward.norm();

    const double E = sv * sv * (a * a * su * su + b * b * cu * cu);
    const double F = (b * b - a * a) * su * cu * sv * cv;
    const double G = cv * cv * (a * a * cu * cu + b * b * su * su) + c * c * sv * sv;
    const double e = a * b * c * sv * sv / D, f = 0, g = a * b * c / D;

    FundamentalForms forms;
    forms.I << E, F, F, G;
    forms.II << e, f, f, g;
    forms.p_u = {-a * su * sv, b * cu * sv, 0};
    forms.p_v = {a * cu * cv, b * su * cv, -c * sv};
    forms.normal = -outward / D;
    return forms;
}

FundamentalForms ellipsoid_forms_by_differences(const Ellipsoid& ellipsoid, double u, double v, double h) {
    require_ellipsoid(ellipsoid);
    require_regular_point(u, v);
    if (!(h > 0)) throw MeshError("ellipsoid_forms_by_differences: the step is " + std::to_string(h), "it must be > 0");
    const auto derivative = [&](const auto& in_u, const auto& in_v, double power_of_h) -> Vector3 {
        Vector3 sum = Vector3::Zero();   // Σ_ij w_i w_j p(u + ih, v + jh): the derivative times a power of h
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) {
                const double weight = in_u[at(i)] * in_v[at(j)];
                if (weight != 0) sum += weight * ellipsoid_point(ellipsoid, u + (i - 2) * h, v + (j - 2) * h);
            }
        }
        return sum / power_of_h;
    };
    const Vector3 p_uu = derivative(second_derivative, no_derivative, h * h);
    const Vector3 p_uv = derivative(first_derivative, first_derivative, h * h);
    const Vector3 p_vv = derivative(no_derivative, second_derivative, h * h);

    FundamentalForms forms;
    forms.p_u = derivative(first_derivative, no_derivative, h);
    forms.p_v = derivative(no_derivative, first_derivative, h);
    forms.normal = forms.p_u.cross(forms.p_v).normalized();
    const double F = forms.p_u.dot(forms.p_v), f = p_uv.dot(forms.normal);
    forms.I << forms.p_u.squaredNorm(), F, F, forms.p_v.squaredNorm();
    forms.II << p_uu.dot(forms.normal), f, f, p_vv.dot(forms.normal);
    return forms;
}

double normal_curvature(const FundamentalForms& forms, const Eigen::Vector2d& du_dv) {
    const double squared_length = du_dv.dot(forms.I * du_dv);
    if (!(squared_length > 0)) throw MeshError("normal_curvature: the direction (0, 0) has no curvature", "give a tangent direction");
    return du_dv.dot(forms.II * du_dv) / squared_length;
}

PrincipalCurvatures principal_curvatures(const FundamentalForms& forms) {
    // II in the orthonormal tangents t = p_u/√E and s = (p_v − p_u F/E)/length: its eigenvalues are the extrema of κ_n.
    const double E = forms.I(0, 0), skew = forms.I(0, 1) / E, length = std::sqrt(forms.I(1, 1) - skew * forms.I(0, 1));
    const double e = forms.II(0, 0), f = forms.II(0, 1), g = forms.II(1, 1);
    const double tt = e / E, ts = (f - skew * e) / (std::sqrt(E) * length), ss = (g - skew * (2 * f - skew * e)) / (length * length);
    const double middle = (tt + ss) / 2, radius = std::hypot((tt - ss) / 2, ts), angle = std::atan2(-2 * ts, ss - tt) / 2;
    const Vector3 t = forms.p_u / std::sqrt(E), s = (forms.p_v - skew * forms.p_u) / length;
    return {middle - radius, middle + radius, as_direction(std::cos(angle) * t + std::sin(angle) * s),
            as_direction(std::cos(angle) * s - std::sin(angle) * t)};
}

double mean_curvature(const FundamentalForms& forms) {
    const double E = forms.I(0, 0), F = forms.I(0, 1), G = forms.I(1, 1);
    const double e = forms.II(0, 0), f = forms.II(0, 1), g = forms.II(1, 1);
    return (e * G - 2 * f * F + g * E) / (2 * (E * G - F * F));
}

double gaussian_curvature(const FundamentalForms& forms) { return forms.II.determinant() / forms.I.determinant(); }

double tip_curvature_by_angle(const Ellipsoid& ellipsoid, double phi) {
    const auto [a, b, c] = ellipsoid;
    const double cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    return a * (cos_phi * cos_phi / (b * b) + sin_phi * sin_phi / (c * c));
}

double tip_curvature_by_parameters(const Ellipsoid& ellipsoid, double theta) {
    const auto [a, b, c] = ellipsoid;
    const double du = std::cos(theta), dv = std::sin(theta);
    return a / (b * b * du * du + c * c * dv * dv);
}

}   // namespace meshfolio
