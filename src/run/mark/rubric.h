/// @file
/// The rubric of a class (data/rubric.toml documents every key; it may be one file with the settings of the sheet), and the settings that
/// students name in answers.toml.
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

/// True if the answer is a mesh, of which the positions are marked.
inline bool is_of_mesh(MarkedThing what) { return what == MarkedThing::reconstruction || what == MarkedThing::smoothed; }

/// The settings of an answer. Equal settings have equal right answers.
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
    std::string id;      // a safe name
    std::string title;   // for people
    MarkedThing what = MarkedThing::H;
    std::string mesh;                   // beside the rubric or bundled
    std::string file;                   // pattern of the student's file, with * and ?
    std::vector<std::string> columns;   // of a CSV file; the first that is there counts
    AnswerSettings settings;
    std::vector<std::string> free;     // keys of the settings that the student may choose
    std::vector<std::string> accept;   // keys of conventions that cost no points
    double value = 0;                  // the right number
    double tolerance = 1e-4;           // relative, of each value
    double points = 1;
    double recognised = 0.5;   // share of the points for an answer that a known convention explains
};

struct Rubric {
    std::string title;
    std::filesystem::path base;   // folder of the rubric, to which paths of meshes are relative
    std::vector<RubricItem> items;
    double points() const;
};

/// Parses a rubric. @param file  its name in messages @throws SettingsErrors with every problem and its line
Rubric parse_rubric(std::string_view text, const std::string& file);
/// Reads a rubric from a file, or from the bundled settings of that name; empty: the bundled example. @throws SettingsErrors, InputError
/// for a file that cannot be read
Rubric read_rubric(const std::string& file);

/// Returns the settings on which the answer to the item depends, as text: "area = mixed, k = 5"; empty if there are none.
std::string described(const RubricItem& item, const AnswerSettings& settings);

struct StudentAnswer {
    AnswerSettings settings;
    std::optional<double> value;   // for a number
};
inline constexpr const char* answers_file = "answers.toml";
/// Parses answers.toml: id of an item → settings and number. Items that it does not name have the settings of the rubric.
/// @param problems  receives a line for each entry that was not understood; the rubric's setting holds instead
std::map<std::string, StudentAnswer> parse_answers(std::string_view text, const Rubric& rubric, std::vector<std::string>& problems);

}   // namespace meshfolio::run
