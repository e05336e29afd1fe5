#include "questions/core/section_tools.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "base/number_text.h"

namespace meshfolio {

namespace {

const std::string unusable = "meshes that cannot be used";

void say_if_copy(const LibraryMesh& mesh, report::Section& section) {
    if (!mesh.is_copy) return;
    const std::string warning =
        report::Words("figures").line("decimated", "file"_a = mesh.input.file, "vertices"_a = mesh.input.vertices,
                                      "copy"_a = mesh.mesh().vertex_count(), "error"_a = readable_percent(mesh.decimation_error, 2));
    if (std::ranges::find(section.warnings, warning) == section.warnings.end()) section.warnings.push_back(warning);
}

}   // namespace

report::Section section_of(std::string_view id) {
    const Chapter& chapter = chapter_of_id(id);
    report::Section section;
    section.id = chapter.id;
    section.title = chapter.title();
    section.asked = chapter.asked();
    section.code = chapter.cited_code();
    return section;
}

void enter_input(const LibraryMesh& mesh, report::Section& section) {
    say_if_copy(mesh, section);
    const auto same = [&](const report::Input& input) { return input.file == mesh.input.file && input.sha256 == mesh.input.sha256; };
    if (std::any_of(section.inputs.begin(), section.inputs.end(), same)) return;
    section.inputs.push_back(mesh.input);
    for (const MeshWarning& warning : mesh.prepared->warnings) {
        section.warnings.push_back(mesh.input.file + (warning.line > 0 ? ":" + std::to_string(warning.line) : "") + ": " + warning.message);
    }
}

std::vector<std::shared_ptr<const LibraryMesh>> meshes_for(const MeshLibrary& library, const QuestionSettings& settings,
                                                           std::initializer_list<std::string_view> roles, report::Section& section) {
    std::vector<std::shared_ptr<const LibraryMesh>> meshes;
    if (!settings.meshes.empty()) {
        for (const std::string& path : settings.meshes) meshes.push_back(library.file(path, settings.base));
    } else if (library.has_own_meshes()) {
        meshes = library.own_meshes();
    } else {
        for (const std::string_view role : roles) meshes.push_back(library.role(std::string(role)));
    }
    for (const auto& mesh : meshes) enter_input(*mesh, section);
    return meshes;
}

void say_small_settings(report::Section& section) { section.warnings.push_back(report::Words("figures").line("small_settings")); }

std::string left_out_to_fit() { return report::Words("figures").line("left_out"); }

report::Check unusable_mesh_check(const std::string& reason) { return report::check_at_most(unusable, 0, 1, 0, printable(reason)); }

bool lacks_a_mesh(const report::Section& section) {
    return std::ranges::find(section.checks, unusable, &report::Check::name) != section.checks.end();
}

void append_checks(report::Section& section, const std::vector<report::Check>& checks) {
    section.checks.insert(section.checks.end(), checks.begin(), checks.end());
}

void add_words(report::Section& section, const report::Words& words, std::string_view key, const report::Facts& facts) {
    for (report::Block& block : words.blocks(key, facts)) add(section, std::move(block));
}

void add_heading(report::Section& section, std::string title) { section.blocks.push_back(report::Heading{std::move(title)}); }

ValueSummary summary_of(const Vector& values) {
    ValueSummary summary;
    std::vector<double> finite;
    for (const double v : values) {
        if (std::isfinite(v)) finite.push_back(v);
    }
    summary.count = static_cast<int>(finite.size());
    summary.undefined = static_cast<int>(values.size()) - summary.count;
    if (finite.empty()) {
        summary.minimum = summary.maximum = summary.mean = summary.median = summary.standard_deviation = std::nan("");
        return summary;
    }
    std::sort(finite.begin(), finite.end());
    const std::size_t n = finite.size();
    summary.minimum = finite.front();
    summary.maximum = finite.back();
    summary.median = 0.5 * (finite[(n - 1) / 2] + finite[n / 2]);
    const Eigen::Map<const Vector> sorted(finite.data(), static_cast<Eigen::Index>(n));
    summary.mean = sorted.mean();
    summary.standard_deviation = std::sqrt((sorted.array() - summary.mean).square().mean());
    return summary;
}

FieldError relative_error(const Vector& f, const Vector& g, const Vector& areas) {
    double squared = 0, reference = 0, largest = 0, scale = 0;
    for (Eigen::Index i = 0; i < f.size(); ++i) {
        if (!std::isfinite(f[i]) || !std::isfinite(g[i])) continue;
        const double difference = f[i] - g[i];
        squared += areas[i] * difference * difference;
        reference += areas[i] * g[i] * g[i];
        largest = std::max(largest, std::abs(difference));
        scale = std::max(scale, std::abs(g[i]));
    }
    return {std::sqrt(squared / reference), largest / scale};
}

report::Cell cell_of(double x, bool defined) {
    if (defined && std::isfinite(x)) return x;
    return std::monostate{};
}

std::string listed(const std::vector<std::string>& names) {
    std::string joined;
    for (std::size_t i = 0; i < names.size(); ++i) joined += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return joined;
}

std::string listed_observed(const std::vector<Observed>& observed) {
    const auto alike = [&](const Observed& each) { return each.condition == observed.front().condition; };
    const bool told_once = observed.size() > 1 && std::all_of(observed.begin(), observed.end(), alike);
    std::vector<std::string> told;
    for (const Observed& each : observed) told.push_back(told_once ? each.what : each.what + " (" + each.condition + ")");
    return listed(told) + (told_once ? ", each time " + observed.front().condition : "");
}

std::string counted(int n, std::string_view singular, std::string_view plural) {
    const std::string many = plural.empty() ? std::string(singular) + "s" : std::string(plural);
    return readable_count(n) + " " + (n == 1 ? std::string(singular) : many);
}

}   // namespace meshfolio
