/// @file
/// The Python module: the functions behind the commands, with NumPy arrays in and out. The package around it, src/python/meshfolio, has
/// their arguments and documentation.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/number_text.h"
#include "build_info.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "output/publish/file_group.h"
#include "python/interruptible.h"
#include "python/mesh_class.h"
#include "python/pictures.h"
#include "run/arguments.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/inspection.h"
#include "run/settings/setting_list.h"

namespace meshfolio::python {

namespace {

// ---- the functions behind the commands -------------------------------------------------------------------------------------

AreaForm area_of(const std::string& name) {
    run::require_choice("area", name, run::area_choices());
    return area_form_named(name);
}

OperatorKind operator_of(const std::string& name) {
    run::require_choice("operator", name, run::operator_choices());
    return operator_named(name);
}

/// Reads a mesh. @throws meshfolio.MissingFileError, which is a FileNotFoundError as well
Mesh load(const std::filesystem::path& path) {
    try {
        return mesh_of(interruptible([path](const Stop&) { return prepare_mesh(read_mesh(path, Keep::attributes)); }));
    } catch (const InputError& error) {
        std::error_code unknown;
        if (std::filesystem::exists(path, unknown) || unknown) throw;
        const py::object kind = py::module_::import("meshfolio._core").attr("MissingFileError"), missing = kind(error.what());
        missing.attr("errno") = ENOENT;
        PyErr_SetObject(kind.ptr(), missing.ptr());
        throw py::error_already_set();
    }
}

void save(const Mesh& mesh, const std::filesystem::path& path) {
    const std::string bytes = interruptible([of = mesh.prepared, attributes = attributes_of(mesh), path](const Stop&) {
        return encode_mesh(of->mesh, path.string(), attributes);
    });
    const py::gil_scoped_release released;   // cannot be interrupted
    output::replace_file(path, bytes);
}

py::dict curvature(const Mesh& mesh, const std::string& area, const std::string& laplacian, bool jets) {
    const AreaForm form = area_of(area);
    const OperatorKind kind = operator_of(laplacian);
    auto columns = interruptible([=, of = mesh.prepared](const Stop&) { return run::curvature_columns(*of, form, kind, jets); });
    py::dict arrays;
    for (VertexColumn& column : columns) arrays[column.name.c_str()] = py::cast(std::move(column.values));
    return arrays;
}

py::tuple laplacian_of(const Mesh& mesh, const std::string& laplacian, const std::string& area) {
    const AreaForm form = area_of(area);
    const OperatorKind kind = operator_of(laplacian);
    auto found = interruptible([=, of = mesh.prepared](const Stop&) { return laplace_operator(of->mesh, kind, form); });
    found.M = summed_at_first(found.copies, std::move(found.M));   // the mass is in the row of the matrix
    return py::make_tuple(py::cast(std::move(found.C)), py::cast(std::move(found.M)));
}

struct CertifiedSpectrum : Spectrum {
    std::string certificate;
};

CertifiedSpectrum spectrum(const Mesh& mesh, long long asked, const std::string& laplacian, const std::string& area) {
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

struct ChosenStep {
    double lambda = 0;     // in model units
    std::string warning;   // about modes that grow; empty: none
};
ChosenStep chosen_step(const TriangleMesh& mesh, SmoothingOptions options, std::optional<double> step, StepUnit unit) {
    const bool is_explicit = options.scheme == SmoothingScheme::explicit_euler, is_taubin = options.scheme == SmoothingScheme::taubin;
    if (step && unit != StepUnit::tau && !is_explicit && !is_taubin)
        return {step_in_model_units(*step, unit, 0, mean_edge_length(mesh)), ""};
    const LaplaceBeltrami laplacian = laplace_operator(mesh, options.laplacian);
    const LargestEigenvalue top = largest_eigenvalue(laplacian);
    const double critical = largest_stable_step(top);
    options.lambda = step ? step_in_model_units(*step, unit, critical, mean_edge_length(mesh)) : 0.5 * critical;
    ChosenStep chosen{options.lambda, ""};
    if (is_explicit && options.adaptive == 0 && options.lambda > critical) {
        chosen.warning = "step = " + plain_text(options.lambda) + " is beyond the largest stable step of " + plain_text(critical) +
                         "; the highest modes will grow";
    } else if (is_taubin) {
        const TaubinGrowth growth = taubin_growth(laplacian, options);
        chosen.warning = growth.warning(options.iterations);
        if (!chosen.warning.empty())
            chosen.warning += growth.of_highest_mode ? "; take a smaller step" : "; take fewer iterations, or mu nearer to -step";
    }
    return chosen;
}

Mesh smooth_mesh(const Mesh& mesh, std::optional<double> step, const std::string& scheme, const std::string& laplacian,
                 const std::string& unit_name, long long iterations, bool rebuild, bool adaptive, std::optional<double> mu) {
    run::require_choice("scheme", scheme, {"explicit", "implicit", "taubin"});
    run::require_choice("unit", unit_name, {"raw", "tau", "h2"});
    if (step) run::number_above_zero("step", plain_text(*step));
    if (mu) run::finite_number("mu", plain_text(*mu));
    SmoothingOptions options{.scheme = smoothing_scheme_named(scheme), .laplacian = operator_of(laplacian)};
    if (adaptive && options.scheme != SmoothingScheme::explicit_euler)
        throw UsageError("adaptive is for scheme explicit", "leave it off: only explicit steps have a limit");
    options.iterations = static_cast<int>(run::integer_between("iterations", std::to_string(iterations), 0, 1000000));
    options.rebuild = rebuild;
    options.adaptive = adaptive ? 0.95 : 0;
    options.taubin_mu = mu.value_or(0);
    const StepUnit unit = step_unit_named(unit_name);
    if (is_dimensionless(options.laplacian) && unit == StepUnit::h2)
        throw UsageError("unit h2 makes no sense with operator " + laplacian + ", whose step has no unit", "use raw or tau");
    auto [smoothed, warning] = interruptible([=, of = mesh.prepared](const Stop& stop) mutable {
        const ChosenStep found = chosen_step(of->mesh, options, step, unit);
        options.lambda = found.lambda;
        options.after_step = [&stop](int, const Positions&) { return !stop.asked(); };
        return std::pair{smooth(of->mesh, options), found.warning};
    });
    if (smoothed.collapse_iteration > 0)
        throw SolverError("nothing was left of the surface before iteration " + std::to_string(smoothed.collapse_iteration),
                          "take fewer iterations or a smaller step");
    if (smoothed.blew_up)
        throw SolverError(
            "blew up in iteration " + std::to_string(smoothed.blow_up_iteration) + " at vertex " + std::to_string(smoothed.blow_up_vertex),
            "take a smaller step or scheme implicit");
    if (!warning.empty()) warn(warning);
    return moved_to(mesh, std::move(smoothed.X));
}

Mesh noise(const Mesh& mesh, double sigma, long long asked, const std::string& unit) {
    const auto seed = static_cast<std::uint64_t>(run::integer_between("seed", std::to_string(asked), 0, run::largest_seed));
    if (run::number_not_negative("sigma", plain_text(sigma)) > largest_coordinate)
        throw UsageError("sigma " + plain_text(sigma) + " is beyond 1e100", "take a smaller one");
    run::require_choice("unit", unit, noise_units);
    return moved_to(mesh, with_gaussian_noise(mesh.triangles().X, sigma * noise_unit(mesh.triangles(), unit), seed));
}

py::dict compare(const Mesh& a, const Mesh& b, bool surfaces, double accuracy) {
    run::number_between("accuracy", plain_text(accuracy), least_accuracy, most_accuracy);
    const run::Difference difference = interruptible(
        [=, of = a.prepared, to = b.prepared](const Stop&) { return run::difference_of(of->mesh, to->mesh, surfaces, accuracy); });
    for (const std::string& warning : difference.warnings) warn(warning);
    py::dict numbers;
    for (const run::DifferenceLine& line : difference.lines)
        numbers[line.key] = line.is_count ? py::object(py::int_(static_cast<int>(line.value))) : py::object(py::float_(line.value));
    return numbers;
}

Vector distances(const Mesh& a, const Mesh& b) {
    return interruptible([of = a.prepared, to = b.prepared](const Stop&) { return vertex_distances(of->mesh, to->mesh); });
}

py::object inspect(const Mesh& mesh, const std::string& laplacian) {
    const OperatorKind kind = operator_of(laplacian);
    const std::string json = interruptible([=, of = mesh.prepared, again = mesh.moved](const Stop& stop) {
        PreparedMesh seen = again ? prepare_mesh({of->mesh, of->file, {}, of->warnings}) : *of;
        return run::inspection_json(run::inspect_mesh(std::move(seen), kind, [&stop](std::string_view) { stop.check(); }));
    });
    return py::module_::import("json").attr("loads")(json);
}

void add_spectrum(py::module_& m) {
    py::class_<CertifiedSpectrum>(m, "Spectrum", "The smallest eigenpairs of -C phi = mu M phi, ascending.")
        .def(py::init([](const py::args&, const py::kwargs&) -> CertifiedSpectrum {
            throw UsageError("a Spectrum is not made of arguments", "take spectrum(mesh, k)");
        }))
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
    refuse_empty<CertifiedSpectrum>("take spectrum(mesh, k)");
}

/// Adds an exception class for each type of error.
void add_errors(py::module_& m) {
    const auto also = [&](const char* name) { return py::make_tuple(m.attr("Error"), py::module_::import("builtins").attr(name)); };
    py::register_exception<Error>(m, "Error");
    py::register_exception<UsageError>(m, "UsageError", also("ValueError"));
    py::register_exception<InputError>(m, "InputError", also("OSError"));
    const py::exception<void> missing(m, "MissingFileError",
                                      py::make_tuple(m.attr("InputError"), py::module_::import("builtins").attr("FileNotFoundError")));
    py::register_exception<MeshError>(m, "MeshError", also("ValueError"));
    py::register_exception<SolverError>(m, "SolverError", also("ArithmeticError"));
    py::register_exception<OutputError>(m, "OutputError", also("OSError"));
}

}   // namespace

PYBIND11_MODULE(_core, m) {
    add_errors(m);
    add_mesh(m);
    add_spectrum(m);
    add_pictures(m);
    m.attr("__version__") = build_info::version;
    leave_works_at_exit();
    m.def("load", &load);
    m.def("sample", [](const std::string& name, long long subdivide) {
        const auto times = static_cast<int>(run::integer_between("subdivide", std::to_string(subdivide), 0, most_subdivisions));
        return mesh_of(interruptible([=](const Stop&) { return prepare_mesh({make_sample(name, times), name, {}, {}}); }));
    });
    m.def("save", &save);
    m.def("curvature", &curvature);
    m.def("laplacian", &laplacian_of);
    m.def("spectrum", &spectrum);
    m.def("smooth", &smooth_mesh);
    m.def("noise", &noise);
    m.def("compare", &compare);
    m.def("distances", &distances);
    m.def("inspect", &inspect);
}

}   // namespace meshfolio::python
