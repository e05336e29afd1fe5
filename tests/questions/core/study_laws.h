/// @file
/// Meshes for the studies of questions 4 to 7, and their tables by column.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "questions/bench/spectral_study.h"
#include "questions/core/answer_laws.h"

namespace meshfolio::testing_tools {

inline std::shared_ptr<const LibraryMesh> library_mesh(const TriangleMesh& mesh, const std::string& name) {
    return library_of(mesh, name).own_meshes().front();
}

inline SpectralStudy spectral_study_on(const TriangleMesh& mesh, const std::string& name, std::vector<int> k) {
    QuestionSettings settings = quick_settings();
    settings.k = std::move(k);
    return spectral_study(library_mesh(mesh, name), settings);
}

inline const report::Table& table_named(const report::Section& section, const std::string& id) {
    for (const report::Block& block : section.blocks) {
        if (const auto* table = std::get_if<report::Table>(&block); table && table->id == id) return *table;
    }
    throw std::logic_error("no table " + id);
}

inline const report::Plot& plot_named(const report::Section& section, const std::string& id) {
    for (const report::Block& block : section.blocks)
        if (const auto* plot = std::get_if<report::Plot>(&block); plot != nullptr && plot->id == id) return *plot;
    throw std::logic_error("no plot " + id);
}

/// The cells of the column of that name (and unit, where two share the name).
inline std::vector<report::Cell> cells(const report::Table& table, const std::string& name, const std::string& unit = "") {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        if (table.columns[c].name != name || (!unit.empty() && table.columns[c].unit != unit)) continue;
        std::vector<report::Cell> column;
        for (const auto& row : table.rows) column.push_back(row[c]);
        return column;
    }
    throw std::logic_error("no column " + name);
}

/// The same as numbers; a column with empty cells has none.
inline std::vector<double> numbers(const report::Table& table, const std::string& name, const std::string& unit = "") {
    std::vector<double> values;
    for (const report::Cell& cell : cells(table, name, unit)) values.push_back(std::get<double>(cell));
    return values;
}

/// The same without the empty cells.
inline std::vector<double> finite_numbers(const report::Table& table, const std::string& name) {
    std::vector<double> values;
    for (const report::Cell& cell : cells(table, name))
        if (const double* value = std::get_if<double>(&cell)) values.push_back(*value);
    return values;
}

inline const output::FigureRequest& figure_named(const Answer& answer, const std::string& id) {
    for (const output::FigureRequest& figure : answer.figures)
        if (figure.id == id) return figure;
    throw std::logic_error("no figure " + id);
}

inline constexpr auto any_size = std::numeric_limits<std::uintmax_t>::max();
/// Checks a chapter on every mesh beside the project up to this size of file; skipped where there are none.
inline void check_real_meshes(Answer (*answer_of)(const MeshLibrary&, const QuestionSettings&, const Progress&),
                              const QuestionSettings& settings = quick_settings(), std::uintmax_t most_bytes = 300'000) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        if (std::filesystem::file_size(file) > most_bytes) continue;
        SCOPED_TRACE(file);
        const Answer answer = answer_of(MeshLibrary({}, {file}), settings, no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

inline void expect_near(const std::vector<double>& measured, const std::vector<double>& expected, double relative = 1e-12) {
    ASSERT_EQ(measured.size(), expected.size());
    for (std::size_t i = 0; i < measured.size(); ++i)
        EXPECT_NEAR(measured[i], expected[i], relative * std::abs(expected[i])) << "row " << i;
}

}   // namespace meshfolio::testing_tools
