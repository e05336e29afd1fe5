#include "run/lab/lab_mesh.h"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/stability.h"
#include "mesh/decimation.h"
#include "mesh/mesh_topology.h"
#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"
#include "output/draw/surface_of.h"

namespace meshfolio::run {

namespace {

/// "lab", which belongs to no question, has what all of them have.
std::map<std::string, QuestionSettings> with_all_of_the_lab(std::map<std::string, QuestionSettings> questions) {
    if (const auto lab = questions.find("lab"); lab != questions.end())
        for (const char* id : {"q4", "q5", "q6", "q7"}) questions.emplace(id, lab->second);
    return questions;
}

/// What the page opens with and offers, and the program's numbers for all of that and for what the report shows.
void add_settings(LabMesh& lab, const Spectrum& spectrum, const std::map<std::string, QuestionSettings>& of_this_mesh) {
    const auto questions = with_all_of_the_lab(of_this_mesh);
    const LabScale scale{lab.critical(), static_cast<int>(lab.eigenvalues.size()), lab.has_all_modes()};
    std::vector<BestDenoising> denoised;
    if (const auto q7 = questions.find("q7"); q7 != questions.end() && scale.has_all) denoised = denoising_on(lab, q7->second);
    lab.presets = presets_for(questions, scale, denoised);
    std::vector<LabSetting> settings;
    for (const LabPreset& preset : lab.presets) settings.push_back(preset.setting);
    for (const auto& [question, own] : questions) {
        for (const LabSetting& setting : reported(question, own, scale, denoised)) settings.push_back(setting);
        if (!of_this_mesh.contains(question)) continue;
        lab.starts[question] = start_of(question, own, scale, denoised);
        settings.push_back(lab.starts[question]);
    }
    std::vector<LabSetting> each_once;
    for (const LabSetting& setting : settings)
        if (std::ranges::find(each_once, setting) == each_once.end()) each_once.push_back(setting);
    lab.readings = readings_at(lab, spectrum, each_once);
}

void quantise(LabMesh& lab, const Spectrum& spectrum) {
    lab.modes = quantised(spectrum.eigenvectors);
    Spectrum rounded = spectrum;
    rounded.eigenvectors = lab.modes.restored();
    const DenseMatrix shift = (rounded.eigenvectors - spectrum.eigenvectors) * lab.coefficients;
    lab.quantisation_shift = shift.rowwise().norm().maxCoeff() / lab.diagonal;
    lab.orthonormality_error = orthonormality_error(rounded, lab.laplacian.M);
}

template <class Number, class Values>
void append(std::string& bytes, const Values& values) {
    static_assert(std::endian::native == std::endian::little, "the page reads little endian");
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
    bytes.append(reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(Number));
}

/// As a state of the page (templates/viewer/lab_state.js), σ in percent.
nlohmann::json json_of(const LabSetting& setting) {
    nlohmann::json state = {{"scheme", setting.scheme}, {"sigma", 100 * setting.sigma}, {"seed", setting.seed}};
    state[setting.scheme == "projection" ? "k" : "t"] = setting.count;
    if (setting.scheme != "projection") state[setting.scheme == "denoising" ? "edges" : "lambda"] = setting.lambda;
    return state;
}

nlohmann::json json_of(const LabReading& r) {
    return {{"state", json_of(r.setting)}, {"energy", r.energy}, {"volume", r.volume}, {"rms", r.rms},
            {"factor", r.factor},          {"gains", r.gains}};
}

nlohmann::json json_of(const LabPreset& preset) {
    nlohmann::json state = json_of(preset.setting);
    state["lines"] = preset.shows_drift;
    return {{"question", preset.question}, {"words", preset.words}, {"state", state}};
}

std::string header_of(const LabMesh& lab) {
    nlohmann::json readings = nlohmann::json::array(), presets = nlohmann::json::array(), starts, colors;
    for (const char* map : {"pale", "diverging"})   // the report's for errors and curvature
        for (const render::Rgba& stop : render::colormap_named(map).stops) colors[map].push_back(output::hex_of(stop));
    for (const LabReading& reading : lab.readings) readings.push_back(json_of(reading));
    for (const LabPreset& preset : lab.presets) presets.push_back(json_of(preset));
    for (const auto& [question, start] : lab.starts) starts[question] = json_of(start);
    const nlohmann::json header = {{"name", lab.name},
                                   {"sourceVertices", lab.source_vertices},
                                   {"isDecimated", lab.is_decimated},
                                   {"isClosed", lab.is_closed},
                                   {"vertices", lab.mesh.vertex_count()},
                                   {"triangles", lab.mesh.face_count()},
                                   {"modes", lab.eigenvalues.size()},
                                   {"diagonal", lab.diagonal},
                                   {"largestEigenvalue", lab.largest_eigenvalue},
                                   {"meanEdge", lab.mean_edge},
                                   {"quantisationShift", lab.quantisation_shift},
                                   {"orthonormalityError", lab.orthonormality_error},
                                   {"colors", colors},
                                   {"starts", starts},
                                   {"presets", presets},
                                   {"readings", readings}};
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}   // namespace

LabMesh lab_mesh(const TriangleMesh& source, const std::string& name, const std::map<std::string, QuestionSettings>& questions,
                 const LabLimits& limits) {
    LabMesh lab;
    lab.name = name;
    lab.source_vertices = source.vertex_count();
    lab.mesh = without_unreferenced_vertices(with_joined_vertices(source, coincident_vertices(source))).mesh;
    lab.is_decimated = lab.mesh.vertex_count() > limits.vertices;
    if (lab.is_decimated) lab.mesh = small_copy(lab.mesh, limits.decimated_to);
    const Box box = bounding_box(lab.mesh);
    lab.mesh.X = lab.mesh.X.rowwise() - box.centre().transpose();
    lab.diagonal = box.diagonal();
    lab.mean_edge = mean_edge_length(lab.mesh);
    lab.is_closed = encloses_volume(lab.mesh, topology_without_edges(lab.mesh));
    lab.laplacian = laplace_beltrami(lab.mesh);

    const int n = lab.mesh.vertex_count();
    const bool all = n <= limits.all_modes;
    const Spectrum spectrum = smallest_eigenpairs(lab.laplacian, all ? n : limits.fewer_modes, {.dense_below = limits.all_modes});
    lab.eigenvalues = spectrum.eigenvalues;
    lab.largest_eigenvalue = largest_eigenvalue(lab.laplacian).value;
    lab.coefficients = spectral_coefficients(spectrum, lab.laplacian.M, lab.mesh.X);
    quantise(lab, spectrum);
    add_settings(lab, spectrum, questions);
    return lab;
}

std::string bytes_of(const LabMesh& lab) {
    std::string header = header_of(lab);
    header.resize((header.size() + 4 + 7) / 8 * 8 - 4, ' ');
    std::string bytes;
    append<std::uint32_t>(bytes, Eigen::Matrix<std::uint32_t, 1, 1>(static_cast<std::uint32_t>(header.size())));
    bytes += header;
    append<double>(bytes, lab.eigenvalues);
    append<double>(bytes, lab.laplacian.M);
    append<double>(bytes, lab.mesh.X);
    append<double>(bytes, lab.coefficients);
    append<double>(bytes, lab.modes.scale);
    append<std::int32_t>(bytes, lab.mesh.F);
    for (const int shift : {8, 0})
        for (const std::int16_t number : lab.modes.numbers) bytes += static_cast<char>(static_cast<std::uint16_t>(number) >> shift & 0xff);
    return bytes;
}

}   // namespace meshfolio::run
