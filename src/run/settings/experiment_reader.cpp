#include "run/settings/settings_reader.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "questions/core/mesh_library.h"
#include "questions/core/mesh_roles.h"
#include "run/one_mesh/fields.h"
#include "run/settings/setting_list.h"

namespace meshfolio::run {

namespace {

using Words = std::vector<std::string>;

constexpr std::size_t longest_remark = 1000;   // bytes of `said` and `lost`

const Words common_keys{"row", "from", "name", "kind", "mesh", "colour", "colormap", "said", "lost", "brief"};

/// The further keys that an experiment of a kind may have, and those that it must have.
struct KindKeys {
    Words may, must;
};
const KindKeys& keys_of(ExperimentKind kind) {
    static const std::map<ExperimentKind, KindKeys> keys{
        {ExperimentKind::curvature, {{"operator", "area"}, {"mesh"}}},
        {ExperimentKind::forms, {{}, {}}},
        {ExperimentKind::reconstruction, {{"operator", "area", "k"}, {"mesh", "k"}}},
        {ExperimentKind::smoothing,
         {{"scheme", "operator", "area", "lambda", "unit", "search", "iterations"}, {"mesh", "lambda", "iterations"}}},
        {ExperimentKind::denoising,
         {{"scheme", "operator", "area", "lambda", "unit", "iterations", "noise", "noise_unit", "seed"},
          {"mesh", "lambda", "iterations", "noise"}}},
        {ExperimentKind::error_curve,
         {{"scheme", "operator", "area", "lambda", "unit", "iterations", "noise", "noise_unit", "minimum", "seed"},
          {"mesh", "lambda", "iterations", "noise"}}},
    };
    return keys.at(kind);
}

Words all_keys() {
    Words all = common_keys;
    for (const std::string& name : experiment_kind_names()) {
        for (const std::string& key : keys_of(experiment_kind_named(name)).may)
            if (!contains(all, key)) all.push_back(key);
    }
    return all;
}

Words bundled_meshes() {
    Words files;
    for (const MeshRole& role : mesh_role_list()) files.emplace_back(role.bundled);
    return files;
}

class ExperimentReader {
public:
    ExperimentReader(const std::map<std::string, OriginalMesh>& originals, Problems& problems)
        : originals_(originals), problems_(problems) {}

    Experiment read(const toml::table& table) {
        static const Words known = all_keys();
        const TableReader reader(table, "[[experiment]]", known, problems_);
        Experiment experiment;
        experiment.rows = reader.integers("row", limits::first_row, limits::last_row);
        experiment.from = reader.text("from", limits::longest_text).value_or("");
        experiment.name = reader.text("name", limits::longest_text).value_or("");
        experiment.said = reader.text("said", longest_remark).value_or("");
        experiment.lost = reader.text("lost", longest_remark).value_or("");
        experiment.brief = reader.truth("brief").value_or(false);
        experiment.search = reader.truth("search").value_or(false);
        read_choices(reader, experiment);
        read_numbers(reader, experiment);
        require(table, reader, {"row", "from", "name", "kind"});
        if (const auto kind = reader.word("kind", experiment_kind_names())) {
            experiment.kind = experiment_kind_named(*kind);
            const auto& [may, must] = keys_of(experiment.kind);
            require(table, reader, must);
            for (const std::string& key : known) {
                if (reader.node(key) == nullptr || contains(common_keys, key) || contains(may, key)) continue;
                problems_.add(*reader.node(key), reader.called(key) + " has no meaning for kind '" + *kind + "'", "leave it out");
            }
        }
        if (experiment.lambda_unit == StepUnit::h2 && std::ranges::any_of(experiment.operators, is_dimensionless))
            problems_.add(*reader.node("unit"), "[[experiment]] unit h2 does not fit the uniform operator, whose steps have no unit",
                          "take raw or tau");
        return experiment;
    }

private:
    const std::map<std::string, OriginalMesh>& originals_;
    Problems& problems_;

    /// Reads known words and maps them by `value_of`. If the key is missing, `values` stays as it is.
    template <class Value, class ValueOf>
    void choose(const TableReader& reader, const std::string& key, const Words& known, std::vector<Value>& values, ValueOf value_of) {
        const Words words = reader.words(key, known);
        if (!words.empty()) values.clear();
        for (const std::string& word : words) values.push_back(value_of(word));
    }

    void read_choices(const TableReader& reader, Experiment& experiment) {
        Words meshes;
        for (const auto& [name, mesh] : originals_) meshes.push_back(name);
        choose(reader, "mesh", meshes, experiment.meshes, [&](const std::string& name) { return originals_.at(name); });
        choose(reader, "scheme", smoothing_method_names(), experiment.methods, smoothing_method_named);
        choose(reader, "operator", operator_choices(), experiment.operators, operator_named);
        choose(reader, "area", area_choices(), experiment.areas, area_form_named);
        choose(reader, "colour", experiment_colour_names(), experiment.colours, experiment_colour_named);
        if (const auto unit = reader.word("unit", {"raw", "tau", "h2"})) experiment.lambda_unit = step_unit_named(*unit);
        if (const auto unit = reader.word("noise_unit", noise_unit_names())) experiment.noise_unit = noise_unit_named(*unit);
        experiment.colormap = reader.word("colormap", colormap_names()).value_or("");
    }

    void read_numbers(const TableReader& reader, Experiment& experiment) {
        experiment.lambda = reader.numbers("lambda", 0, limits::largest_lambda, true);
        experiment.iterations = reader.integers("iterations", 1, limits::largest_iterations);
        experiment.k = reader.integers("k", 1, limits::largest_k);
        experiment.noise = reader.numbers("noise", 0, limits::largest_lambda, false);
        experiment.minimum = reader.integers("minimum", 0, limits::largest_iterations);
        std::sort(experiment.iterations.begin(), experiment.iterations.end());
        std::sort(experiment.k.begin(), experiment.k.end());
        if (const auto seed = reader.integer("seed", 0, largest_seed)) experiment.seed = static_cast<std::uint64_t>(*seed);
        if (const std::size_t given = reader.size("minimum"), levels = reader.size("noise"); given > 0 && given != levels) {
            problems_.add(
                *reader.node("minimum"),
                "[[experiment]] minimum has " + std::to_string(given) + " values for " + std::to_string(levels) + " levels of noise",
                "give one for each level, 0 where the report says nothing");
        }
    }

    void require(const toml::table& table, const TableReader& reader, const Words& keys) {
        for (const std::string& key : keys)
            if (reader.node(key) == nullptr) problems_.add(table, "[[experiment]] has no " + key, "add " + key + " = …");
    }
};

OriginalMesh read_original(const toml::table& table, const std::string& name, Problems& problems) {
    const std::string called = "[original." + printable(name) + "]";
    const TableReader reader(table, called, {"file", "stand_in", "lambda_crit", "mean_edge", "diagonal"}, problems);
    const auto number = [&](const char* key) { return reader.number(key, 0, limits::largest_lambda, true, 0); };
    OriginalMesh mesh{name,
                      reader.text("file").value_or(""),
                      reader.word("stand_in", bundled_meshes()).value_or(""),
                      number("lambda_crit"),
                      number("mean_edge"),
                      number("diagonal")};
    if (mesh.file.find('\0') != std::string::npos) problems.add(*reader.node("file"), called + " file contains a NUL", "name a file");
    if (reader.node("stand_in") == nullptr) problems.add(table, called + " has no stand_in", "name the bundled mesh that takes its place");
    return mesh;
}

std::map<std::string, OriginalMesh> read_originals(const toml::table& root, Problems& problems) {
    std::map<std::string, OriginalMesh> originals;
    const toml::node* node = root.get("original");
    if (node == nullptr) return originals;
    if (!node->is_table()) {
        problems.add(*node, "original is not a table", "write [original] and under it bunny = { file = …, stand_in = … }");
        return originals;
    }
    for (const auto& [key, value] : *node->as_table()) {
        const std::string name(key.str());
        if (const toml::table* table = value.as_table()) {
            originals[name] = read_original(*table, name, problems);
        } else {
            problems.add(value, "[original] " + name + " is not a table", "write " + name + " = { file = …, stand_in = … }");
        }
    }
    return originals;
}

}   // namespace

std::vector<Experiment> read_experiments(const toml::table& root, Problems& problems) {
    const std::map<std::string, OriginalMesh> originals = read_originals(root, problems);
    std::vector<Experiment> experiments;
    const toml::node* node = root.get("experiment");
    if (node == nullptr) return experiments;
    const std::size_t count = node->is_array() ? node->as_array()->size() : 1;
    if (count > static_cast<std::size_t>(limits::most_experiments)) {
        problems.add(*node, std::to_string(count) + " experiments", "at most " + std::to_string(limits::most_experiments) + " are allowed");
        return experiments;
    }
    ExperimentReader reader(originals, problems);
    for_each_table(*node, "experiment", problems, [&](const toml::table& table) { experiments.push_back(reader.read(table)); });
    return experiments;
}

}   // namespace meshfolio::run
