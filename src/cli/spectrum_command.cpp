#include <bit>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "cli/commands.h"
#include "geometry/distributed/backend.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "mesh/io/mesh_files.h"
#include "output/publish/folder_system.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/fields.h"

namespace meshfolio::cli {

namespace {

/// Returns the matrix in NumPy's .npy format 1.0: a padded text header, then the entries row by row.
std::string npy_of(const DenseMatrix& matrix) {
    static_assert(std::endian::native == std::endian::little, "the header says '<f8'");
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(matrix.rows()) + ", " +
                         std::to_string(matrix.cols()) + "), }";
    header.append(63 - (10 + header.size()) % 64, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 0xff);
    bytes += static_cast<char>(header.size() >> 8);
    bytes += header;
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
    const std::size_t start = bytes.size();
    bytes.resize(start + static_cast<std::size_t>(rows.size()) * sizeof(double));
    std::memcpy(bytes.data() + start, rows.data(), bytes.size() - start);
    return bytes;
}

std::string eigenvalue_table(const Spectrum& spectrum) {
    std::string csv = "index,eigenvalue,residual\n";
    for (Eigen::Index i = 0; i < spectrum.eigenvalues.size(); ++i)
        csv += std::to_string(i + 1) + ',' + exact_text(spectrum.eigenvalues[i]) + ',' + exact_text(spectrum.residuals[i]) + '\n';
    return csv;
}

std::vector<VertexColumn> mode_columns(const Spectrum& spectrum) {
    std::vector<VertexColumn> columns;
    for (Eigen::Index i = 0; i < spectrum.eigenvectors.cols(); ++i)
        columns.push_back({"mode_" + std::to_string(i + 1), spectrum.eigenvectors.col(i)});
    return columns;
}

struct SpectrumFlags {
    std::string mesh, area = "barycentric", laplacian = "cotan", backend = "builtin", k, csv, vectors, ply, reconstruct, out;
};

constexpr int largest_k = 100000;

std::string in_words(Proof proof, OperatorKind kind) {
    const char* const proved = has_intrinsic_lengths(kind) ? "proved of the operator as stored" : "proved";
    return proof == Proof::proved ? proved : proof == Proof::refuted ? "REFUTED" : "cannot be proved here";
}

/// Returns the certificate as one line for people.
std::string in_words(const SpectrumCertificate& c, OperatorKind kind) {
    const auto within = [](const std::string& what, double measured, double limit) {
        return what + " " + plain_text(measured, 2) + (measured <= limit ? " (at most " : " (ABOVE ") + plain_text(limit, 2) + "), ";
    };
    const bool failed = c.verdict() == Proof::refuted;
    const int cut = c.pairs - c.found_below;
    const std::string residual = c.residual_undecided() ? "residual " + plain_text(c.residual, 2) + " (rounding may leave " +
                                                              plain_text(c.residual_rounding, 2) + "), "
                                                        : within("residual", c.residual, c.residual_limit);
    return "certificate: " + std::string(failed ? "FAILED: " : "") + residual +
           within("orthonormality", c.orthonormality_error, SpectrumCertificate::orthonormality_limit) +
           within("Parseval", c.parseval_gap, SpectrumCertificate::parseval_limit) + "none missing below " + plain_text(c.shift, 6) + ": " +
           (c.says_nothing() ? std::string("empty") : in_words(c.residual_undecided() ? Proof::undecided : c.complete, kind)) +
           (c.delta_is_measured ? " but for measured rounding (" : " (") +
           (c.counted_below >= 0 ? std::to_string(c.counted_below) : std::string("not")) + " counted by inertia, " +
           std::to_string(c.found_below) + " found" +
           (cut > 0 ? ", " + std::to_string(cut) + " more in the last cluster, just above" : "") + "; rounding " + plain_text(c.delta, 2) +
           ", gap " + plain_text(c.gap, 2) + "); zero eigenvalues " + std::to_string(c.zero_eigenvalues) + ", components " +
           std::to_string(c.components) + (c.zeros_undecided ? " (rounding hides which of the smallest are 0)" : "");
}

/// True if the bytes begin like the PLY files that this program writes.
bool is_our_ply(const std::string& bytes) { return bytes.starts_with("ply\nformat binary_little_endian 1.0\nelement vertex "); }

/// Adds the reconstructions to the files. @return their paths
std::vector<std::filesystem::path> add_reconstructions(output::FileGroup& files, const SpectrumFlags& options,
                                                       const std::vector<int>& counts, const TriangleMesh& mesh, const Spectrum& spectrum,
                                                       const Vector& M) {
    std::vector<std::filesystem::path> paths;
    const std::string stem = mesh_name(options.mesh);
    output::make_folder(options.out);
    for (const int k : counts) {
        if (k > spectrum.eigenvalues.size()) continue;
        const auto file = std::filesystem::path(options.out) / (stem + "_k" + std::to_string(k) + ".ply");
        keep_others(file, is_our_ply);
        add_mesh(files, file, moved_to(mesh, reconstruct(spectrum, M, mesh.X, k)));
        paths.push_back(file);
    }
    return paths;
}

ExitCode run_spectrum(const SpectrumFlags& options, const Backend& backend) {
    const AreaForm form = area_form_named(options.area);
    const OperatorKind kind = operator_named(options.laplacian);
    const int k = static_cast<int>(integer_between("-k", options.k, 1, largest_k));
    const std::vector<int> counts = integers_between("--reconstruct", options.reconstruct, 1, k);
    if (counts.empty() != options.out.empty()) throw UsageError("--reconstruct and --out go together", "give both or neither");
    if (!options.csv.empty() && options.csv == options.vectors)
        throw UsageError("--csv and --vectors are both " + in_quotes(options.csv), "give each output a name of its own");
    if (!options.out.empty()) output::require_folder(options.out);
    check_output("--csv", options.csv, {".csv", "-"}, options.out);
    check_output("--vectors", options.vectors, {".npy", ".csv", "-"}, options.out);
    check_output("--ply", options.ply, column_endings(), options.out);
    const PreparedMesh prepared = load_mesh(options.mesh, Checks::for_pictures, options.ply.empty() ? Keep::mesh : Keep::attributes);
    const LaplaceBeltrami laplacian = laplace_operator(prepared.mesh, kind, form);
    const Spectrum spectrum = about_mesh(options.mesh, [&] { return smallest_eigenpairs(laplacian, k, {.engine = backend.engine}); });
    const auto found = static_cast<int>(spectrum.eigenvalues.size());
    if (found < k) {
        warn(shown(options.mesh) + ": the mesh has " + std::to_string(found) + " modes, fewer than the " + std::to_string(k) +
             " asked for");
    }
    const SpectrumCertificate certificate = certify_spectrum(prepared.mesh, laplacian, spectrum, backend.inertia_at);
    complain(in_words(certificate, kind));
    output::FileGroup files;
    files.keep(options.mesh);
    std::vector<std::filesystem::path> rebuilt;
    if (!counts.empty()) rebuilt = add_reconstructions(files, options, counts, prepared.mesh, spectrum, laplacian.M);
    if (!options.vectors.empty()) {
        const bool is_table = lower_case_ending(options.vectors) == ".csv";
        print_to(files, options.vectors, is_table ? vertex_table(prepared, mode_columns(spectrum)) : npy_of(spectrum.eigenvectors));
    }
    if (!options.ply.empty()) add_mesh(files, options.ply, prepared.mesh, attributes_with(prepared, mode_columns(spectrum)));
    if (!options.csv.empty() || (options.vectors.empty() && options.ply.empty() && options.out.empty()))
        print_to(files, options.csv.empty() ? "-" : options.csv, eigenvalue_table(spectrum));
    files.publish();
    if (options.csv != "-" && options.vectors != "-")
        for (const std::filesystem::path& file : rebuilt) print_path(file);
    return certificate.verdict() == Proof::refuted ? ExitCode::failed : ExitCode::ok;
}

}   // namespace

Command spectrum_command(CLI::App& parent) {
    const auto options = std::make_shared<SpectrumFlags>();
    CommandOptions app(parent, "spectrum", "The smallest eigenpairs of a Laplace-Beltrami operator");
    app.required("MESH", options->mesh, formats_read);
    app.required("-k", options->k, "how many eigenpairs, 1 to 100000");
    app.choice("--area", options->area, area_choices(), "area of a vertex");
    app.choice("--operator", options->laplacian, operator_choices(), "Laplace-Beltrami operator");
    app.choice("--backend", options->backend, backend_choices(), "library that factors; slepc: all ranks of mpirun together");
    app.text("--csv FILE", options->csv, "index, eigenvalue, residual; - for standard output");
    app.text("--vectors FILE", options->vectors,
             "eigenvectors: .npy, n x K float64; .csv, a row per vertex with mode_1, mode_2, …; - for .npy on standard output");
    app.text("--ply FILE", options->ply,
             "the mesh with its eigenvectors as properties mode_1, mode_2, …: " + joined(column_endings(), ", "));
    app.text("--reconstruct NUMBERS", options->reconstruct, "numbers of modes to rebuild the mesh from: 5,15,30");
    app.text("--out DIR", options->out, "folder for <mesh>_k<k>.ply");
    app.footer(
        "Prints a certificate on stderr: that no eigenpair is missing is proved, refuted, or undecided because rounding exceeds the gap.\n"
        "Exit code 1 if something is refuted or beyond its limit.\n"
        "Example: meshfolio spectrum armadillo.obj -k 30 --csv - --reconstruct 5,15,30 --out modes");
    return {app,
            [options] { return with_backend(options->backend, [&](const Backend& backend) { return run_spectrum(*options, backend); }); }};
}

}   // namespace meshfolio::cli
