/// @file
/// Laplacians of the Python module, and their spectra.
#pragma once

#include <pybind11/eigen.h>

#include <string>
#include <utility>

#include "base/errors.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "python/interruptible.h"
#include "python/mesh_arrays.h"
#include "run/arguments.h"
#include "run/one_mesh/fields.h"

namespace meshfolio::python {

inline AreaForm area_of(const std::string& name) {
    run::require_choice("area", name, {"barycentric", "voronoi", "mixed"});
    return area_form_named(name);
}

inline OperatorKind operator_of(const std::string& name) {
    run::require_choice("operator", name, run::operator_choices());
    return operator_named(name);
}

inline void warn(const std::string& text) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

inline py::tuple laplacian_of(const Mesh& mesh, const std::string& laplacian, const std::string& area) {
    const AreaForm form = area_of(area);
    const OperatorKind kind = operator_of(laplacian);
    auto found = interruptible([=, of = mesh.prepared](const Stop&) { return laplace_operator(of->mesh, kind, form); });
    found.M = summed_at_first(found.copies, std::move(found.M));   // the mass where the row is
    return py::make_tuple(py::cast(std::move(found.C)), py::cast(std::move(found.M)));
}

struct CertifiedSpectrum : Spectrum {
    std::string certificate;
};

inline CertifiedSpectrum spectrum(const Mesh& mesh, long long asked, const std::string& laplacian, const std::string& area) {
    const AreaForm form = area_of(area);
    const OperatorKind kind = operator_of(laplacian);
    const auto k = static_cast<int>(run::integer_between("k", std::to_string(asked), 1, 100000));
    CertifiedSpectrum spectrum = interruptible([=, of = mesh.prepared](const Stop& stop) {
        const LaplaceBeltrami L = laplace_operator(of->mesh, kind, form);
        SpectrumOptions options;
        options.progress = [&stop](double) { stop.check(); };
        CertifiedSpectrum found{smallest_eigenpairs(L, k, options), ""};
        stop.check();
        const Proof proof = certify_spectrum(of->mesh, L, found).verdict();
        found.certificate = proof == Proof::proved ? "proved" : proof == Proof::refuted ? "refuted" : "undecided";
        return found;
    });
    const auto modes = static_cast<int>(spectrum.eigenvalues.size());
    if (modes < k) warn("the mesh has " + std::to_string(modes) + " modes, fewer than the " + std::to_string(k) + " asked for");
    return spectrum;
}

inline void add_spectrum(py::module_& m) {
    py::class_<CertifiedSpectrum>(m, "Spectrum", "The smallest eigenpairs of -C phi = mu M phi, ascending.")
        .def_readonly("eigenvalues", &CertifiedSpectrum::eigenvalues, "k float64 [1/length^2]")
        .def_readonly("eigenvectors", &CertifiedSpectrum::eigenvectors, "n x k float64, Phi^T M Phi = I [1/length]")
        .def_readonly("residuals", &CertifiedSpectrum::residuals, "k float64, |-C phi - mu M phi| / (mu |M phi|)")
        .def_readonly("certificate", &CertifiedSpectrum::certificate,
                      "that the pairs are right and none is missing: proved, refuted or undecided")
        .def(py::pickle(
            [](const CertifiedSpectrum& found) {
                return py::make_tuple(found.eigenvalues, found.eigenvectors, found.residuals, found.certificate);
            },
            [](const py::tuple& state) {
                CertifiedSpectrum found;
                found.eigenvalues = state[0].cast<Vector>();
                found.eigenvectors = state[1].cast<DenseMatrix>();
                found.residuals = state[2].cast<Vector>();
                found.certificate = state[3].cast<std::string>();
                return found;
            }));
}

}   // namespace meshfolio::python
