/// @file
/// The Python module: the functions behind the commands, with NumPy arrays in and out. src/python/meshfolio is the package around it.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "mesh/io/polygon_list.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "output/publish/file_group.h"
#include "python/interruptible.h"
#include "python/mesh_arrays.h"
#include "run/one_mesh/vertex_columns.h"
#include "run/one_mesh/difference_lines.h"
#include "run/one_mesh/inspection.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::python {

namespace {

py::dict curvature(const Mesh& mesh, const std::string& area, const std::string& laplacian, bool jets) {
    const AreaForm form = area_form_named(area);
    const OperatorKind kind = operator_named(laplacian);
    auto columns = interruptible([=, of = mesh.prepared](const Stop&) { return run::curvature_columns(*of, form, kind, jets); });
    py::dict arrays;
    for (VertexColumn& column : columns) arrays[column.name.c_str()] = py::cast(std::move(column.values));
    return arrays;
}

py::tuple laplacian_of(const Mesh& mesh, const std::string& laplacian, const std::string& area) {
    const AreaForm form = area_form_named(area);
    const OperatorKind kind = operator_named(laplacian);
    auto found = interruptible([=, of = mesh.prepared](const Stop&) { return laplace_operator(of->mesh, kind, form); });
    return py::make_tuple(py::cast(std::move(found.C)), py::cast(std::move(found.M)));
}

struct CertifiedSpectrum : Spectrum {
    std::string certificate;
};

CertifiedSpectrum spectrum(const Mesh& mesh, int k, const std::string& laplacian, const std::string& area) {
    const AreaForm form = area_form_named(area);
    const OperatorKind kind = operator_named(laplacian);
    return interruptible([=, of = mesh.prepared](const Stop& stop) {
        const LaplaceBeltrami L = laplace_operator(of->mesh, kind, form);
        SpectrumOptions options;
        options.progress = [&stop](double) { stop.check(); };
        CertifiedSpectrum found{smallest_eigenpairs(L, k, options), ""};
        stop.check();
        const Proof proof = certify_spectrum(of->mesh, L, found).verdict();
        found.certificate = proof == Proof::proved ? "proved" : proof == Proof::refuted ? "refuted" : "undecided";
        return found;
    });
}

/// In model units, and whether an explicit step is beyond the limit.
struct ChosenStep {
    double lambda = 0, critical = 0;   // critical: 0 where it is not asked for
};
ChosenStep chosen_step(const TriangleMesh& mesh, const SmoothingOptions& options, std::optional<double> step, StepUnit unit) {
    const bool needs_limit = !step || unit == StepUnit::tau || options.scheme == SmoothingScheme::explicit_euler;
    const double critical = needs_limit ? largest_stable_step(largest_eigenvalue(laplace_operator(mesh, options.laplacian))) : 0;
    return {step ? step_in_model_units(*step, unit, critical, mean_edge_length(mesh)) : 0.5 * critical, critical};
}

Mesh smooth_mesh(const Mesh& mesh, std::optional<double> step, const std::string& scheme, const std::string& laplacian,
                 const std::string& unit_name, int iterations, bool rebuild, bool adaptive, std::optional<double> mu) {
    SmoothingOptions options{.scheme = smoothing_scheme_named(scheme), .laplacian = operator_named(laplacian)};
    options.iterations = iterations;
    options.rebuild = rebuild;
    options.adaptive = adaptive ? 0.95 : 0;
    options.taubin_mu = mu.value_or(0);
    const StepUnit unit = step_unit_named(unit_name);
    if (is_dimensionless(options.laplacian) && unit == StepUnit::h2)
        throw UsageError("unit h2 makes no sense with operator " + laplacian + ", whose step has no unit", "use raw or tau");
    const bool warns = options.scheme == SmoothingScheme::explicit_euler && !adaptive;
    auto [smoothed, chosen] = interruptible([=, of = mesh.prepared](const Stop& stop) mutable {
        const ChosenStep found = chosen_step(of->mesh, options, step, unit);
        options.lambda = found.lambda;
        options.after_step = [&stop](int, const Positions&) { return !stop.asked(); };
        return std::pair{smooth(of->mesh, options), found};
    });
    if (smoothed.collapse_iteration > 0)
        throw SolverError("nothing was left of the surface before iteration " + std::to_string(smoothed.collapse_iteration),
                          "take fewer iterations or a smaller step");
    if (smoothed.blew_up)
        throw SolverError(
            "blew up in iteration " + std::to_string(smoothed.blow_up_iteration) + " at vertex " + std::to_string(smoothed.blow_up_vertex),
            "take a smaller step or scheme implicit");
    if (warns && chosen.lambda > chosen.critical) {
        const std::string beyond = "step " + plain_text(chosen.lambda) + " is beyond the largest stable step of " +
                                   plain_text(chosen.critical) + "; the highest modes will grow";
        if (PyErr_WarnEx(PyExc_RuntimeWarning, beyond.c_str(), 1) != 0) throw py::error_already_set();
    }
    return moved_to(*mesh.prepared, std::move(smoothed.X));
}

Mesh noise(const Mesh& mesh, double sigma, std::uint64_t seed, const std::string& unit) {
    if (!(sigma >= 0 && sigma <= largest_coordinate)) throw UsageError("sigma is below 0 or beyond 1e100");
    if (unit != "raw" && unit != "bbox") throw UsageError("unknown unit '" + unit + "'", "raw or bbox");
    const Vector3 scale = unit == "bbox" ? bounding_box(mesh.triangles()).extent() : Vector3::Ones();
    return moved_to(*mesh.prepared, with_gaussian_noise(mesh.triangles().X, sigma * scale, seed));
}

py::dict compare(const Mesh& a, const Mesh& b, bool surfaces) {
    const auto lines = interruptible(
        [=, of = a.prepared, to = b.prepared](const Stop&) { return run::difference_of(of->mesh, to->mesh, surfaces).lines; });
    py::dict numbers;
    for (const run::DifferenceLine& line : lines)
        numbers[line.key] = line.is_count ? py::object(py::int_(static_cast<int>(line.value))) : py::object(py::float_(line.value));
    return numbers;
}

Vector distances(const Mesh& a, const Mesh& b) {
    return interruptible([of = a.prepared, to = b.prepared](const Stop&) { return vertex_distances(of->mesh, to->mesh); });
}

py::object inspect(const Mesh& mesh, const std::string& laplacian) {
    const OperatorKind kind = operator_named(laplacian);
    const std::string json = interruptible([=, of = mesh.prepared, again = mesh.moved](const Stop& stop) {
        PreparedMesh seen = again ? prepare_mesh({of->mesh, of->file, {}, of->warnings}) : *of;
        return run::inspection_json(run::inspect_mesh(std::move(seen), kind, [&stop](std::string_view) { stop.check(); }));
    });
    return py::module_::import("json").attr("loads")(json);
}

py::array draw(const Mesh& mesh, const std::string& field_name, const std::optional<Vector>& values, const std::string& label,
               const std::string& views, const py::object& size, const std::string& colormap,
               const std::optional<std::pair<double, double>>& range, double isolines, bool edges, bool transparent) {
    run::PictureRequest request{
        .views = run::views_named(views), .colormap = colormap, .title = std::filesystem::path(mesh.prepared->file).filename().string()};
    std::tie(request.draw.width, request.draw.height) = picture_size(size);
    if (range) {
        request.range =
            run::value_limits(range->first, range->second, "range (" + plain_text(range->first) + ", " + plain_text(range->second) + ")");
    }
    if (!(isolines >= 0)) throw UsageError("isolines is below 0", "give the distance of two lines, 0 for none");
    request.draw.isoline_spacing = isolines;
    request.draw.edges = edges;
    request.draw.face_colors_from_id = !values && field_name == "id";
    if (transparent) request.draw.background = {255, 255, 255, 0};
    if (values && values->size() != mesh.triangles().X.rows())
        throw MeshError(std::to_string(values->size()) + " values, the mesh has " + std::to_string(mesh.triangles().X.rows()) +
                        " vertices");
    return array_of(interruptible([=, of = mesh.prepared](const Stop& stop) {
        const run::Field field = values ? run::field_of_values(*values, label) : run::field_of(*of, field_name);
        stop.check();
        run::MeshPictures drawn = run::draw_pictures(*of, field, request);
        stop.check();
        return drawn.sheet.pictures.size() == 1 ? std::move(drawn.sheet.pictures.front())
                                                : run::composed(drawn.sheet, request.draw.face_colors_from_id);
    }));
}

/// A class for each type, with the words of the command line.
void add_errors(py::module_& m) {
    const auto also = [&](const char* name) { return py::make_tuple(m.attr("Error"), py::module_::import("builtins").attr(name)); };
    py::register_exception<Error>(m, "Error");
    py::register_exception<UsageError>(m, "UsageError", also("ValueError"));
    py::register_exception<InputError>(m, "InputError", also("OSError"));
    py::register_exception<MeshError>(m, "MeshError", also("ValueError"));
    py::register_exception<SolverError>(m, "SolverError", also("ArithmeticError"));
    py::register_exception<OutputError>(m, "OutputError", also("OSError"));
}

void add_classes(py::module_& m) {
    py::class_<Mesh>(m, "Mesh",
                     "A triangle mesh. It is never changed: smooth() and noise() give new ones.\n\n"
                     "Faces that name a vertex twice, and repeated ones, are dropped, and the rest is turned consistently, outwards where\n"
                     "closed; `warnings` says what was done. Vertices keep their rows.")
        .def(py::init(&mesh_of_arrays), "vertices"_a, "faces"_a, "name"_a = "mesh",
             "vertices: n x 3 coordinates in any unit of length; faces: m x 3 rows of vertices, counter-clockwise seen from outside.")
        .def_property_readonly(
            "vertices", [](const Mesh& mesh) { return rows_of(mesh.triangles().X, mesh); }, "n x 3 float64 [length], read-only, no copy")
        .def_property_readonly(
            "points", [](const Mesh& mesh) { return rows_of(mesh.triangles().X, mesh); }, "the same as vertices, as PyVista calls them")
        .def_property_readonly(
            "faces", [](const Mesh& mesh) { return rows_of(mesh.triangles().F, mesh); }, "m x 3 int32, read-only, no copy")
        .def_property_readonly(
            "name", [](const Mesh& mesh) { return mesh.prepared->file; }, "file it was read from, or what it was called")
        .def_property_readonly(
            "warnings",
            [](const Mesh& mesh) {
                py::list lines;
                for (const MeshWarning& warning : mesh.prepared->warnings) lines.append(printable(warning.message));
                return lines;
            },
            "what looked odd when it was read, and what was repaired")
        .def("__repr__", [](const Mesh& mesh) {
            return "<meshfolio.Mesh " + printable(mesh.prepared->file) + ": " + std::to_string(mesh.triangles().vertex_count()) +
                   " vertices, " + std::to_string(mesh.triangles().face_count()) + " faces>";
        });
    py::class_<CertifiedSpectrum>(m, "Spectrum", "The smallest eigenpairs of -C phi = mu M phi, ascending.")
        .def_readonly("eigenvalues", &CertifiedSpectrum::eigenvalues, "k float64 [1/length^2]")
        .def_readonly("eigenvectors", &CertifiedSpectrum::eigenvectors, "n x k float64, Phi^T M Phi = I [1/length]")
        .def_readonly("residuals", &CertifiedSpectrum::residuals, "k float64, |-C phi - mu M phi| / (mu |M phi|)")
        .def_readonly("certificate", &CertifiedSpectrum::certificate,
                      "that the pairs are right and none is missing: proved, refuted or undecided");
}

}   // namespace

PYBIND11_MODULE(_core, m) {
    add_errors(m);
    add_classes(m);
    py::module_::import("atexit").attr("register")(py::cpp_function(wait_for_works));
    m.def(
        "load", [](const std::filesystem::path& path) { return interruptible([path](const Stop&) { return prepared(read_mesh(path)); }); },
        "path"_a, "A mesh from an OBJ, OFF, PLY, STL, VTP or GLB file, perhaps packed by gzip.");
    m.def(
        "sample",
        [](const std::string& name, int subdivide) {
            return interruptible([=](const Stop&) { return prepared({make_sample(name, subdivide), name, {}, {}}); });
        },
        "name"_a, "subdivide"_a = 0, "A bundled mesh, its triangles divided into four so many times, onto the surface.");
    m.def(
        "save",
        [](const Mesh& mesh, const std::filesystem::path& path) {
            interruptible([of = mesh.prepared, path](const Stop&) { output::replace_file(path, encode_mesh(of->mesh, path.string())); });
        },
        "mesh"_a, "path"_a, "Into an OBJ, OFF, PLY, STL, VTP or GLB file, which is replaced as a whole.");
    m.def("curvature", &curvature, "mesh"_a, py::kw_only(), "area"_a = "barycentric", "operator"_a = "cotan", "jets"_a = false,
          "A dict of n float64 each, NaN where undefined: area [length^2], h_uniform [length], k_gauss [1/length^2], h_cotan and\n"
          "h_uniform_scaled [1/length]; with jets also h_jet, k_jet; h_<operator> of another operator.");
    m.def("laplacian", &laplacian_of, "mesh"_a, py::kw_only(), "operator"_a = "cotan", "area"_a = "barycentric",
          "C (n x n, scipy.sparse, negative semidefinite) and M (n masses [length^2]) of the operator M^-1 C.");
    m.def("spectrum", &spectrum, "mesh"_a, "k"_a, py::kw_only(), "operator"_a = "cotan", "area"_a = "barycentric",
          "The k smallest eigenpairs, M-orthonormal, and whether they are proved complete.");
    m.def("smooth", &smooth_mesh, "mesh"_a, "step"_a = py::none(), py::kw_only(), "scheme"_a = "explicit", "operator"_a = "cotan",
          "unit"_a = "raw", "iterations"_a = 1, "rebuild"_a = false, "adaptive"_a = false, "mu"_a = py::none(),
          "Laplacian smoothing: scheme explicit, implicit or taubin. step is lambda in unit raw [length^2], tau (1 is the largest stable\n"
          "step) or h2 (mean edge squared); default: half the largest stable one. SolverError when it blows up.");
    m.def("noise", &noise, "mesh"_a, "sigma"_a, py::kw_only(), "seed"_a = 1, "unit"_a = "raw",
          "Seeded Gaussian noise of standard deviation sigma per coordinate: raw [length], or bbox, a share of each extent.");
    m.def("compare", &compare, "a"_a, "b"_a, py::kw_only(), "surfaces"_a = false,
          "A dict of errors of b against a: rms, max, hausdorff [length], mean_normal_angle_deg, volume_ratio, area_ratio and more. Vertex "
          "by\n"
          "vertex where both have the same faces, else, or if surfaces is true, from surface to surface.");
    m.def("distances", &distances, "a"_a, "b"_a,
          "n float64: the distance of every vertex of a to the surface of b, NaN where no face uses the vertex [length].");
    m.def("inspect", &inspect, "mesh"_a, py::kw_only(), "operator"_a = "cotan",
          "A dict: counts, defects, Gauss-Bonnet, lambda_crit [length^2] and its proof, None where not defined; as `inspect --json`.");
    m.def("draw", &draw, "mesh"_a, "field"_a, "values"_a, "label"_a, "views"_a, "size"_a, "colormap"_a, "range"_a, "isolines"_a, "edges"_a,
          "transparent"_a);
    m.def("encode_png", &png_of, "picture"_a);
}

}   // namespace meshfolio::python
