#include "questions/core/section_tools.h"

namespace meshfolio {

namespace {

const std::string unusable = "meshes that cannot be used";

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
    if (mesh.is_copy) {
        const std::string warning =
            report::Words("figures").line("decimated", "file"_a = mesh.input.file, "vertices"_a = mesh.input.vertices,
                                          "copy"_a = mesh.mesh().vertex_count(), "error"_a = readable_percent(mesh.decimation_error, 2));
        if (std::ranges::find(section.warnings, warning) == section.warnings.end()) section.warnings.push_back(warning);
    }
    const auto same = [&](const report::Input& input) { return input.file == mesh.input.file && input.sha256 == mesh.input.sha256; };
    if (std::ranges::any_of(section.inputs, same)) return;
    section.inputs.push_back(mesh.input);
    for (const MeshWarning& warning : mesh.prepared->warnings)
        section.warnings.push_back(mesh.input.file + (warning.line > 0 ? ":" + std::to_string(warning.line) : "") + ": " + warning.message);
}

LibraryMeshes meshes_for(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    return meshes_for(library, settings, chapter_of_id(section.id).roles, section);
}

LibraryMeshes meshes_for(const MeshLibrary& library, const QuestionSettings& settings, const std::vector<std::string_view>& roles,
                         report::Section& section) {
    LibraryMeshes meshes;
    if (!settings.meshes.empty())
        for (const std::string& path : settings.meshes) meshes.push_back(library.file(path, settings.base));
    else if (library.has_own_meshes()) meshes = library.own_meshes();
    else
        for (const std::string_view role : roles) meshes.push_back(library.role(std::string(role)));
    for (const auto& mesh : meshes) enter_input(*mesh, section);
    return meshes;
}

void say_small_settings(report::Section& section) { section.warnings.push_back(report::Words("figures").line("small_settings")); }

std::string left_out_to_fit() { return report::Words("figures").line("left_out"); }

report::Check unusable_mesh_check(const std::string& reason) { return report::check_at_most(unusable, 0, 1, 0, printable(reason)); }

bool misses_a_mesh(const report::Section& section) {
    return std::ranges::find(section.checks, unusable, &report::Check::name) != section.checks.end();
}

void append_checks(report::Section& section, const std::vector<report::Check>& checks) {
    section.checks.insert(section.checks.end(), checks.begin(), checks.end());
}

void add_words(report::Section& section, const report::Words& words, std::string_view key, const report::Facts& facts) {
    for (report::Block& block : words.blocks(key, facts)) add(section, std::move(block));
}

void add_one(report::Section& section, report::Block block) {
    const auto complete = [](auto& b) {
        if constexpr (requires { b.alt; })
            if (b.alt.empty()) b.alt = b.caption;
    };
    std::visit(complete, block);
    section.blocks.push_back(std::move(block));
}

void add_paragraphs(report::Section& section, const std::vector<report::Text>& texts) {
    for (const report::Text& text : texts)
        if (!text.empty()) add(section, report::Paragraph{text});
}

std::string id_of(const std::string& question, const std::string& mesh, const std::string& what) {
    return question + "_" + mesh + "_" + what;
}

std::vector<double> sorted_finite(const Vector& values) {
    std::vector<double> finite;
    std::ranges::copy_if(values, std::back_inserter(finite), [](double v) { return std::isfinite(v); });
    std::ranges::sort(finite);
    return finite;
}

std::vector<int> where_finite(const Vector& a, const Vector& b) {
    std::vector<int> both;
    for (int v = 0; v < a.size(); ++v)
        if (std::isfinite(a[v]) && std::isfinite(b[v])) both.push_back(v);
    return both;
}

ValueSummary summary_of(const Vector& values) {
    const std::vector<double> finite = sorted_finite(values);
    const auto n = finite.size();
    const int count = static_cast<int>(n), without = static_cast<int>(values.size()) - count;
    if (finite.empty()) return {undefined, undefined, undefined, undefined, undefined, count, without};
    const Eigen::Map<const Vector> sorted(finite.data(), count);
    const double mean = sorted.mean(), deviation = std::sqrt((sorted.array() - mean).square().mean());
    return {finite.front(), finite.back(), mean, 0.5 * (finite[(n - 1) / 2] + finite[n / 2]), deviation, count, without};
}

double relative_error(const Vector& f, const Vector& g, const Vector& areas) {
    double squared = 0, reference = 0;
    for (Eigen::Index i = 0; i < f.size(); ++i) {
        if (!std::isfinite(f[i]) || !std::isfinite(g[i])) continue;
        const double difference = f[i] - g[i];
        squared += areas[i] * difference * difference;
        reference += areas[i] * g[i] * g[i];
    }
    return std::sqrt(squared / reference);
}

report::Cell cell_of(double x, bool defined) {
    if (defined && std::isfinite(x)) return x;
    return std::monostate{};
}

report::Text paragraph_of(std::initializer_list<report::Text> sentences) {
    report::Text paragraph;
    for (const report::Text& sentence : sentences) go_on(paragraph, sentence);
    return paragraph;
}

void go_on(report::Text& paragraph, const report::Text& sentence) {
    if (!paragraph.empty() && !sentence.empty()) report::extend(paragraph, " ");
    report::extend(paragraph, sentence);
}

std::string listed(const Names& names) {
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i) all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return all;
}

std::string joined(const Names& parts, std::string_view separator) {
    std::string all;
    for (const std::string& part : parts) all += (all.empty() ? "" : std::string(separator)) + part;
    return all;
}

std::string span_of(const std::string& low, const std::string& high) {
    return low == high ? low : report::Words("figures").line("span", "low"_a = low, "high"_a = high);
}

std::string counted(int n, std::string_view singular, std::string_view plural) {
    const std::string many = plural.empty() ? std::string(singular) + "s" : std::string(plural);
    return readable_count(n) + " " + (n == 1 ? std::string(singular) : many);
}

}   // namespace meshfolio
