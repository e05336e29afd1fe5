#include "questions/core/answer_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "mesh/io/mesh_files.h"
#include "report/svg/plot_panel.h"
#include "temporary_folder.h"

namespace meshfolio::testing_tools {

std::string prose_of(const report::Section& section) {
    std::string prose = section.extent + "\n" + report::plain(section.answer);
    for (const report::Block& block : section.blocks) {
        if (const auto* paragraph = std::get_if<report::Paragraph>(&block)) prose += "\n" + report::plain(paragraph->text);
        if (const auto* list = std::get_if<report::BulletList>(&block)) {
            for (const report::Text& item : list->items) prose += "\n" + report::plain(item);
        }
        if (const auto* table = std::get_if<report::Table>(&block)) prose += "\n" + table->caption;
        if (const auto* figure = std::get_if<report::Figure>(&block)) prose += "\n" + figure->caption + "\n" + figure->alt;
        if (const auto* plot = std::get_if<report::Plot>(&block)) prose += "\n" + plot->caption + "\n" + plot->alt;
        if (const auto* map = std::get_if<report::Map>(&block)) prose += "\n" + map->caption + "\n" + map->alt;
        if (const auto* diagram = std::get_if<report::Diagram>(&block)) prose += "\n" + diagram->caption + "\n" + diagram->alt;
    }
    return prose;
}

namespace {

/// Everything that is read but no running text.
std::string labels_of(const Answer& answer) {
    std::string labels = answer.section.title + "\n" + answer.section.asked;
    for (const report::Block& block : answer.section.blocks) {
        if (const auto* heading = std::get_if<report::Heading>(&block)) labels += "\n" + heading->title;
        if (const auto* plot = std::get_if<report::Plot>(&block)) {
            labels += "\n" + plot->x_label + "\n" + plot->y_label;
            for (const report::Series& series : plot->series) labels += "\n" + series.name;
            for (const report::Marker& marker : plot->markers) labels += "\n" + marker.label;
        }
        const auto* table = std::get_if<report::Table>(&block);
        if (table == nullptr) continue;
        for (const report::Column& column : table->columns) labels += "\n" + column.name;
        for (const auto& row : table->rows)
            for (const report::Cell& cell : row)
                if (const auto* words = std::get_if<std::string>(&cell)) labels += "\n" + *words;
    }
    for (const report::Check& check : answer.section.checks) labels += "\n" + check.name + "\n" + check.note;
    for (const std::string& warning : answer.section.warnings) labels += "\n" + warning;
    for (const output::FigureRequest& figure : answer.figures) {
        labels += "\n" + figure.title + "\n" + figure.subtitle;
        for (const std::string& head : figure.columns) labels += "\n" + head;
        for (const std::string& head : figure.rows) labels += "\n" + head;
        for (const output::Panel& panel : figure.panels) labels += "\n" + panel.label;
    }
    return labels;
}

}   // namespace

void expect_checks_pass(const report::Section& section) {
    EXPECT_FALSE(section.checks.empty());
    for (const report::Check& check : section.checks) {
        EXPECT_TRUE(check.passed()) << check.name << ": expected " << check.expected << ", measured " << check.measured << ", tolerance "
                                    << check.tolerance;
    }
}

namespace {

/// Does the id belong to another section of the report? Its existence is checked when the report is written.
bool is_of_another_section(const std::string& id, const std::string& own) {
    const std::vector<std::string> all = section_ids();
    const std::string section = id.substr(0, id.find('_'));
    return section != own && std::find(all.begin(), all.end(), section) != all.end();
}

/// No panel of a plot has more than five curves, no two of them of the same colour, the same dashes (or no line) and the same shape of
/// points (or none).
void expect_few_and_different(const report::Plot& plot) {
    const report::Axis axis({}, false);
    for (const std::string& name : report::panel_names(plot)) {
        std::set<std::string> looks;
        const report::PlotPanel panel(plot, name, axis, axis);
        for (const report::PlotCurve& curve : panel.curves()) {
            const report::Look& look = curve.look;
            const std::string line = look.has_line ? look.dashes : "none", points = look.has_points ? std::to_string(look.pattern) : "";
            EXPECT_TRUE(looks.insert(look.color + "/" + line + "/" + points).second)
                << plot.id << ": " << curve.series->name << " looks like another";
        }
        EXPECT_LE(looks.size(), 5u) << plot.id << " " << name;
    }
    for (const report::Marker& marker : plot.markers) {
        const auto is_its_panel = [&](const report::Series& series) { return series.panel == marker.panel; };
        EXPECT_TRUE(std::ranges::any_of(plot.series, is_its_panel)) << plot.id << " has no panel " << marker.panel;
    }
}

}   // namespace

void expect_well_formed(const Answer& answer) {
    const report::Section& section = answer.section;
    static const std::regex id_form("[a-z0-9_]+"), file_form("[A-Za-z0-9_.-]+"), not_a_number("\\b(nan|inf)\\b");
    std::set<std::string> ids, figures, references;
    const auto enter = [&](const std::string& id) {
        EXPECT_TRUE(std::regex_match(id, id_form)) << id;
        EXPECT_TRUE(ids.insert(id).second) << "twice: " << id;
    };
    for (const report::Block& block : section.blocks) {
        if (const auto* table = std::get_if<report::Table>(&block)) {
            enter(table->id);
            EXPECT_FALSE(table->rows.empty()) << table->id;
            for (const auto& row : table->rows) {
                EXPECT_EQ(row.size(), table->columns.size()) << table->id;
                for (std::size_t c = 0; c < row.size(); ++c) {
                    const auto* id = std::get_if<std::string>(&row[c]);
                    if (table->columns[c].reference && id) references.insert(*id);
                }
            }
        }
        if (const auto* plot = std::get_if<report::Plot>(&block)) {
            enter(plot->id);
            for (const report::Series& series : plot->series) EXPECT_EQ(series.x.size(), series.y.size()) << plot->id;
            expect_few_and_different(*plot);
        }
        if (const auto* map = std::get_if<report::Map>(&block)) {
            enter(map->id);
            for (const auto& panel : map->panels) EXPECT_EQ(panel.values.size(), map->x.size() * map->y.size()) << map->id;
        }
        if (const auto* diagram = std::get_if<report::Diagram>(&block)) {
            enter(diagram->id);
            EXPECT_FALSE(diagram->panels.empty()) << diagram->id;
            for (const auto& panel : diagram->panels) {
                for (const auto& path : panel.paths) EXPECT_EQ(path.x.size(), path.y.size()) << diagram->id;
            }
        }
        if (const auto* figure = std::get_if<report::Figure>(&block)) {
            enter(figure->id);
            figures.insert(figure->id);
        }
        if (const auto* formula = std::get_if<report::Formula>(&block); formula && !formula->id.empty()) enter(formula->id);
        const auto enter_references = [&](const report::Text& text) {
            for (const report::Run& run : text) {
                if (run.kind == report::Run::Kind::reference) references.insert(run.content);
            }
        };
        if (const auto* paragraph = std::get_if<report::Paragraph>(&block)) enter_references(paragraph->text);
    }
    std::set<std::string> requested, panels;
    for (const output::FigureRequest& request : answer.figures) {
        EXPECT_TRUE(requested.insert(request.id).second) << request.id;
        EXPECT_TRUE(request.rows.empty() || request.panels.size() == request.rows.size() * request.columns.size()) << request.id;
        for (std::size_t i = 0; i < request.panels.size(); ++i) {
            const output::Panel& panel = request.panels[i];
            EXPECT_TRUE(std::regex_match(panel.name, file_form)) << panel.name;
            EXPECT_TRUE(panels.insert(panel.name).second) << "two pictures of one name: " << panel.name;
            if (panel.mesh == nullptr) {   // an empty cell of a matrix, which says why, but for those below the input
                const bool is_below_the_input = i > 0 && !request.columns.empty() && i % request.columns.size() == 0;
                EXPECT_TRUE(is_below_the_input || !panel.label.empty()) << panel.name;
                continue;
            }
            EXPECT_TRUE(panel.values.size() == 0 || panel.values.size() == panel.mesh->vertex_count()) << panel.name;
        }
    }
    EXPECT_EQ(figures, requested);
    static const std::regex cited_work("[a-z_]+_[0-9]{4}");   // that it is in the bibliography is seen to where the report is written
    for (const std::string& reference : references)
        EXPECT_TRUE(ids.contains(reference) || std::regex_match(reference, cited_work) || is_of_another_section(reference, section.id))
            << "leads nowhere: " << reference;
    EXPECT_FALSE(std::regex_search(prose_of(section), not_a_number)) << prose_of(section);
    for (const std::string& text : {prose_of(section), labels_of(answer)})
        for (const char* mark : {"[[", "]]", "{{", "}}"}) EXPECT_EQ(text.find(mark), std::string::npos) << mark << " in " << text;
    EXPECT_FALSE(section.answer.empty());
    EXPECT_FALSE(section.extent.empty());
}

MeshLibrary library_of(const TriangleMesh& mesh, const std::string& name) {
    static const auto values = std::make_shared<OnceMap>();   // curvature of known surfaces is measured once for all tests
    static const testing_tools::TemporaryFolder folder;       // of this process: tests run side by side
    const std::filesystem::path file = folder.path() / (name + ".ply");
    write_mesh(file, mesh);
    return MeshLibrary({}, {file}, {}, values);
}

}   // namespace meshfolio::testing_tools
