/// @file
/// The Python module: the functions behind the commands, with NumPy arrays in and out. src/python/meshfolio is the package around it.
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
#include "mesh/io/polygon_list.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "output/publish/file_group.h"
#include "python/interruptible.h"
#include "python/mesh_class.h"
#include "run/arguments.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/inspection.h"
#include "run/one_mesh/mesh_pictures.h"
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

void warn(const std::string& text) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
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

Mesh noise(const Mesh& mesh, double sigma, std::uint64_t seed, const std::string& unit) {
    if (run::number_not_negative("sigma", plain_text(sigma)) > largest_coordinate)
        throw UsageError("sigma " + plain_text(sigma) + " is beyond 1e100", "take a smaller one");
    run::require_choice("unit", unit, {"raw", "bbox"});
    const Vector3 scale = unit == "bbox" ? bounding_box(mesh.triangles()).extent() : Vector3::Ones();
    return moved_to(mesh, with_gaussian_noise(mesh.triangles().X, sigma * scale, seed));
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

py::array draw(const Mesh& mesh, const std::string& field_name, const std::optional<Vector>& values, const std::string& label,
               const std::string& views, const py::object& size, const std::string& colormap,
               const std::optional<std::pair<double, double>>& range, double isolines, bool edges, bool transparent) {
    if (!values) run::require_choice("field", field_name, run::field_names());
    if (!colormap.empty()) run::require_choice("colormap", colormap, run::colormap_names());
    run::PictureRequest request{
        .views = run::views_named(views), .colormap = colormap, .title = std::filesystem::path(mesh.prepared->file).filename().string()};
    std::tie(request.draw.width, request.draw.height) = picture_size(size);
    if (range) {
        request.range =
            run::value_limits(range->first, range->second, "range (" + plain_text(range->first) + ", " + plain_text(range->second) + ")");
    }
    if (!(isolines >= 0))
        throw UsageError("isolines must be a number >= 0, not " + plain_text(isolines), "give the distance between lines, 0 for none");
    request.draw.isoline_spacing = isolines;
    request.draw.edges = edges;
    request.draw.face_colors_from_id = !values && field_name == "id";
    if (transparent) request.draw.background = {255, 255, 255, 0};
    if (values && values->size() != mesh.triangles().X.rows())
        throw MeshError(std::to_string(values->size()) + " values, the mesh has " + std::to_string(mesh.triangles().X.rows()) + " vertices",
                        "give one value a vertex, NaN where undefined");
    return array_of(interruptible([=, of = mesh.prepared](const Stop& stop) {
        const run::Field field = values ? run::field_of_values(*values, label) : run::field_of(*of, field_name);
        stop.check();
        run::MeshPictures drawn = run::draw_pictures(*of, field, request);
        stop.check();
        return drawn.sheet.pictures.size() == 1 ? std::move(drawn.sheet.pictures.front())
                                                : run::composed(drawn.sheet, request.draw.face_colors_from_id);
    }));
}

void add_spectrum(py::module_& m) {
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
    m.attr("__version__") = build_info::version;
    leave_works_at_exit();
    m.def("load", &load, "path"_a,
          "A mesh from an OBJ, OFF, PLY, STL, VTP or GLB file, perhaps packed by gzip, with the values that the file holds for its\n"
          "vertices in `attributes`. Raises MissingFileError, a FileNotFoundError, where there is no file.");
    m.def(
        "sample",
        [](const std::string& name, int subdivide) {
            return mesh_of(interruptible([=](const Stop&) { return prepare_mesh({make_sample(name, subdivide), name, {}, {}}); }));
        },
        "name"_a, "subdivide"_a = 0,
        "A bundled mesh, its triangles divided into four `subdivide` times, with new vertices on its surface.");
    m.def("save", &save, "mesh"_a, "path"_a,
          "Writes an OBJ, OFF, PLY, STL, VTP or GLB file, which is replaced as a whole. PLY, VTP and GLB take the attributes:\n"
          "an n x k array as columns NAME_0, NAME_1, … An OBJ file's texture coordinates, groups and materials go into OBJ.");
    m.def("curvature", &curvature, "mesh"_a, py::kw_only(), "area"_a = "barycentric", "operator"_a = "cotan", "jets"_a = false,
          "A dict of n float64 each, NaN where undefined: area [length^2], h_uniform [length], k_gauss [1/length^2], h_cotan and\n"
          "h_uniform_scaled [1/length]; with jets also h_jet, k_jet; h_<operator> of another operator.");
    m.def("laplacian", &laplacian_of, "mesh"_a, py::kw_only(), "operator"_a = "cotan", "area"_a = "barycentric",
          "C (n x n, scipy.sparse, negative semidefinite) and M (n masses [length^2]) of the operator M^-1 C. Of vertices that edges "
          "without\n"
          "length join, the first has the row and the mass of all; the others, like unreferenced vertices, have zeros.");
    m.def("spectrum", &spectrum, "mesh"_a, "k"_a, py::kw_only(), "operator"_a = "cotan", "area"_a = "barycentric",
          "A Spectrum: the k smallest eigenpairs, M-orthonormal, with a certificate; fewer, with a warning, on a mesh of fewer vertices.");
    m.def("smooth", &smooth_mesh, "mesh"_a, "step"_a = py::none(), py::kw_only(), "scheme"_a = "explicit", "operator"_a = "cotan",
          "unit"_a = "raw", "iterations"_a = 1, "rebuild"_a = false, "adaptive"_a = false, "mu"_a = py::none(),
          "A smoothed mesh, by scheme explicit, implicit or taubin. step is lambda in unit raw [length^2], tau (1 is the largest stable\n"
          "step) or h2 (mean edge squared); default: half the largest stable one. SolverError when it blows up.");
    m.def("noise", &noise, "mesh"_a, "sigma"_a, py::kw_only(), "seed"_a = 1, "unit"_a = "raw",
          "A mesh with seeded Gaussian noise of standard deviation sigma per coordinate: raw [length], or bbox, a share of each extent.");
    m.def("compare", &compare, "a"_a, "b"_a, py::kw_only(), "surfaces"_a = false, "accuracy"_a = default_accuracy,
          "A dict of errors of b against a: rms, max, hausdorff, hausdorff_bound [length], mean_normal_angle_deg, volume_ratio, area_ratio "
          "and more. Vertex "
          "by\n"
          "vertex where both have the same faces, else, or if surfaces is true, from surface to surface. The Hausdorff distance lies "
          "between\n"
          "hausdorff and hausdorff_bound, which is larger by the share accuracy at most.");
    m.def("distances", &distances, "a"_a, "b"_a,
          "n float64: the distance of every vertex of a to the surface of b, NaN where no face uses the vertex [length].");
    m.def("inspect", &inspect, "mesh"_a, py::kw_only(), "operator"_a = "cotan",
          "A dict: counts, defects, Gauss-Bonnet, lambda_crit [length^2] and its proof, None where not defined; as `inspect --json`.");
    m.def("draw", &draw, "mesh"_a, "field"_a, "values"_a, "label"_a, "views"_a, "size"_a, "colormap"_a, "range"_a, "isolines"_a, "edges"_a,
          "transparent"_a);
    m.def("encode_png", &png_of, "picture"_a);
}

}   // namespace meshfolio::python
