/// @file
/// The rubric of a class (data/rubric.toml documents every key), and the settings that students name (answers.toml).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/stability.h"

namespace meshfolio::run {

enum class MarkedThing { H, H_uniform, K, eigenvalues, reconstruction, smoothed, number };

/// Are these the positions of a mesh's vertices?
inline bool is_of_mesh(MarkedThing what) { return what == MarkedThing::reconstruction || what == MarkedThing::smoothed; }

/// How the right answer is computed. Two answers of the same settings are the same.
struct AnswerSettings {
    OperatorKind laplacian = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    int k = 10;   // eigenvalues, or modes of a reconstruction
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0.5;
    StepUnit unit = StepUnit::tau;
    int iterations = 1;
    bool rebuild = false;
    auto operator<=>(const AnswerSettings&) const = default;
};

struct RubricItem {
    std::string id;      // a safe name; that of the section of the page
    std::string title;   // for people
    MarkedThing what = MarkedThing::H;
    std::string mesh;                   // beside the rubric or bundled
    std::string file;                   // of the student; * and ? are wildcards
    std::vector<std::string> columns;   // of a CSV file; the first that it has
    AnswerSettings settings;
    std::vector<std::string> free;     // keys of settings that the student may choose
    std::vector<std::string> accept;   // conventions that cost nothing
    double value = 0;                  // of a number
    double tolerance = 1e-4;           // relative, of each value
    double points = 1;
    double recognised = 0.5;   // share of the points for an answer that is right but for a known convention
};

struct Rubric {
    std::string title;
    std::filesystem::path base;   // its folder: what meshes are relative to
    std::vector<RubricItem> items;
    double points() const;
};

/// @param file  what messages call it @throws SettingsErrors with everything that is wrong, each with its line
Rubric parse_rubric(std::string_view text, const std::string& file);
/// From a file; empty: the bundled example. @throws SettingsErrors, InputError for a file that cannot be read
Rubric read_rubric(const std::string& file);

/// Of these settings, those that the answer depends on: "area = mixed, k = 5".
std::string described(const RubricItem& item, const AnswerSettings& settings);

/// answers.toml: by id of an item what the student chose.
struct StudentAnswer {
    AnswerSettings settings;
    std::optional<double> value;   // of a number
};
inline constexpr const char* answers_file = "answers.toml";
/// For each item; those that the text says nothing of, or that is empty, have the settings of the rubric.
/// @param problems  what was not understood, one line each: it is left out, and the rubric's own settings hold
std::map<std::string, StudentAnswer> parse_answers(std::string_view text, const Rubric& rubric, std::vector<std::string>& problems);

}   // namespace meshfolio::run
