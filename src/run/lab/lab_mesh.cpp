#include "run/lab/lab_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/stability.h"
#include "mesh/decimation.h"
#include "mesh/mesh_topology.h"
#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"
#include "output/draw/surface_of.h"
#include "questions/core/chapter.h"
#include "scene/hero.h"

namespace meshfolio::run {

namespace {

bool can_be_set(const LabSetting& setting, const LabScale& scale) {
    return setting.scheme == "projection" ? setting.count <= scale.modes : scale.has_all;
}

/// Enters the setting that each panel opens with, the presets, and the program's numbers at these and at the settings of the report's
/// tables.
void add_settings(LabMesh& lab, const Spectrum& spectrum, const std::map<std::string, QuestionSettings>& of_this_mesh) {
    const LabScale scale{lab.critical(), static_cast<int>(lab.eigenvalues.size()), lab.has_all_modes()};
    const auto page = of_this_mesh.find("lab");   // the page of the laboratory alone offers the presets of every panel
    std::vector<BestDenoising> denoised;
    std::vector<LabSetting> reported;
    if (page != of_this_mesh.end()) reported.push_back(lab.starts["lab"] = coarse_projection(page->second, scale));
    for (const Chapter* chapter : chapter_list()) {
        const std::string id(chapter->id);
        const auto question = of_this_mesh.contains(id) ? of_this_mesh.find(id) : page;
        if (chapter->lab == nullptr || question == of_this_mesh.end()) continue;
        const QuestionSettings& settings = question->second;
        const LabOffer& offer = *chapter->lab;
        if (offer.denoised != nullptr && scale.has_all) denoised = offer.denoised(lab.mesh, lab.mean_edge, lab.diagonal, settings);
        for (LabPreset& preset : offer.presets(denoised)) {
            preset.question = id;
            if (can_be_set(preset.setting, scale)) lab.presets.push_back(std::move(preset));
        }
        std::ranges::copy(offer.reported(settings, scale, denoised), std::back_inserter(reported));
        if (question != page) {
            lab.starts[id] = scale.has_all ? offer.start(settings, scale, denoised) : coarse_projection(settings, scale);
            reported.push_back(lab.starts[id]);
        }
    }
    std::erase_if(reported, [&](const LabSetting& setting) { return !can_be_set(setting, scale); });
    std::vector<LabSetting> settings;
    const auto add = [&](const LabSetting& setting) {
        if (std::ranges::find(settings, setting) == settings.end()) settings.push_back(setting);
    };
    for (const LabPreset& preset : lab.presets) add(preset.setting);
    for (const LabSetting& setting : reported) add(setting);
    lab.readings = readings_at(lab, spectrum, settings);
}

/// Rounds all modes to 16 bits. If the page has only some, it only adds them up: modes that move vertices less are rounded more.
void quantise(LabMesh& lab, const Spectrum& spectrum) {
    Vector precision;
    if (!lab.has_all_modes()) {
        precision = spectrum.eigenvectors.cwiseAbs().colwise().maxCoeff().transpose().cwiseProduct(lab.coefficients.rowwise().norm());
        precision *= 8 / precision.tail(precision.size() - 1).maxCoeff();   // the first mode is constant
    }
    lab.modes = quantised(spectrum.eigenvectors, precision);
    const DenseMatrix shift = (lab.modes.restored() - spectrum.eigenvectors) * lab.coefficients;
    lab.quantisation_shift = shift.rowwise().norm().maxCoeff() / lab.diagonal;
}

std::vector<std::int16_t> differences(const LabMesh& lab) {
    std::vector<std::int16_t> numbers = lab.modes.numbers;
    const std::vector<Edge> edges = edges_of(lab.mesh);
    const auto n = static_cast<std::size_t>(lab.modes.rows);
    for (auto mode = numbers.begin(); mode != numbers.end(); mode += lab.modes.rows) {
        std::vector<double> sum(n), count(n, 1e-300);
        for (const auto& [a, b, faces] : edges) sum[b] += mode[a], ++count[b];
        for (std::size_t v = 0; v < n; ++v) {
            const auto d = static_cast<std::int16_t>(mode[v] - static_cast<int>(std::floor(sum[v] / count[v])));
            mode[v] = static_cast<std::int16_t>(d < 0 ? -2 * d - 1 : 2 * d);
        }
    }
    return numbers;
}

template <class Number, class Values> void append(std::string& bytes, const Values& values) {
    static_assert(std::endian::native == std::endian::little, "the page reads little endian");
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
    bytes.append(reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(Number));
}

/// Returns a setting as a state of the page (templates/viewer/lab_state.js), σ in percent.
nlohmann::json json_of(const LabSetting& setting) {
    nlohmann::json state = {{"scheme", setting.scheme}, {"sigma", 100 * setting.sigma}, {"seed", setting.seed}};
    state[setting.scheme == "projection" ? "k" : "t"] = setting.count;
    if (setting.scheme != "projection") state[setting.scheme == "denoising" ? "edges" : "lambda"] = setting.lambda;
    return state;
}

std::string header_of(const LabMesh& lab) {
    nlohmann::json readings = nlohmann::json::array(), presets = nlohmann::json::array(), starts, colors;
    for (const char* map : {"pale", "diverging"})   // the report's for errors and curvature
        for (const render::Rgba& stop : render::colormap_named(map).stops) colors[map].push_back(output::hex_of(stop));
    for (const LabReading& r : lab.readings)
        readings.push_back({{"state", json_of(r.setting)},
                            {"energy", r.energy},
                            {"volume", r.volume},
                            {"rms", r.rms},
                            {"factor", r.factor},
                            {"gains", r.gains}});
    for (const LabPreset& p : lab.presets)
        presets.push_back({{"question", p.question}, {"words", p.words}, {"lines", p.shows_drift}, {"state", json_of(p.setting)}});
    for (const auto& [question, start] : lab.starts) starts[question] = json_of(start);
    const render::View view = render::view_of(lab.sight, output::surface_of(lab.mesh));
    const auto vector = [](const glm::dvec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
    nlohmann::json header = {{"name", lab.name},
                             {"from", vector(view.from)},
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
                             {"colors", colors},
                             {"starts", starts},
                             {"presets", presets},
                             {"readings", readings}};
    if (lab.sight != render::Sight() || std::abs(view.right().y) > 1e-9) header.update({{"up", vector(view.up)}, {"zoom", lab.sight.zoom}});
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

    const int n = lab.mesh.vertex_count(), some = std::min(limits.fewer_modes, limits.numbers / std::max(n, 1));
    const Spectrum spectrum = smallest_eigenpairs(lab.laplacian, n <= limits.all_modes ? n : some, {.dense_below = limits.all_modes});
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
    const std::vector<std::int16_t> numbers = lab.has_all_modes() ? lab.modes.numbers : differences(lab);
    for (const int shift : {8, 0})
        for (const std::int16_t number : numbers) bytes += static_cast<char>(static_cast<std::uint16_t>(number) >> shift & 0xff);
    return bytes;
}

}   // namespace meshfolio::run
