#include "output/draw/draw_models.h"

#include <gtest/gtest.h>

#include "base/file_bytes.h"
#include "mesh/samples/sample_shapes.h"
#include "output/draw/figure_request.h"
#include "output/draw/flat_mesh.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::flat_mesh;
using testing_tools::TemporaryFolder;

namespace {

Panel turnable_panel(TriangleMesh mesh, const std::string& name) {
    Panel panel{name, "label of " + name, nullptr};
    panel.values = mesh.X.col(2);
    panel.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    return panel;
}

FigureRequest turnable(std::vector<Panel> panels) {
    FigureRequest request;
    request.id = panels.front().name;
    request.range = robust_range(panels, "viridis", "z", "length", 0);
    request.panels = std::move(panels);
    request.turnable = true;
    return request;
}

/// Writes the models of these requests and checks them against the files in the folder.
report::DrawnFigures models_of(const std::vector<FigureRequest>& requests) {
    const TemporaryFolder folder;
    report::DrawnFigures figures;
    for (const FigureRequest& request : requests) figures[request.id];
    for (auto& [id, models] : write_models(requests, folder.path())) figures.at(id).models = models;
    std::size_t named = 0, written = 0;
    for (const auto& [id, figure] : figures) {
        for (const report::DrawnModel& model : figure.models) {
            EXPECT_EQ(read_file(folder.path() / model.file), model.glb);
            ++named;
        }
    }
    if (std::filesystem::exists(folder.path() / "models"))
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path() / "models")) ++written;
    EXPECT_EQ(named, written);
    return figures;
}

}   // namespace

TEST(DrawModels, OnlyTurnableFiguresHaveModels) {
    FigureRequest quiet = turnable({turnable_panel(icosphere(1), "q1_quiet")});
    quiet.turnable = false;
    const auto figures = models_of({turnable({turnable_panel(icosphere(2), "q1_ball")}), quiet});
    ASSERT_EQ(figures.at("q1_ball").models.size(), 1U);
    EXPECT_TRUE(figures.at("q1_quiet").models.empty());
    const report::DrawnModel& model = figures.at("q1_ball").models[0];
    EXPECT_EQ(model.file, "models/q1_ball.glb");
    EXPECT_EQ(model.label, "");
    EXPECT_EQ(model.quantity, "z [length]");
}

TEST(DrawModels, EveryMeshOfAFigureIsAModelInItsFrame) {
    TriangleMesh shrunk = icosphere(2);
    shrunk.X *= 0.25;
    const auto frame_of = [](const report::DrawnModel& model) { return model.glb.substr(model.glb.find("\"frame\""), 160); };
    for (const Layout layout : {Layout::six_views, Layout::one_frame, Layout::multiples}) {
        FigureRequest request =
            turnable({turnable_panel(icosphere(2), "before"), turnable_panel(shrunk, "after"), turnable_panel(cube_mesh(2), "third")});
        request.layout = layout;
        const auto models = models_of({request}).at("before").models;
        ASSERT_EQ(models.size(), 3U);
        EXPECT_EQ(models[1].label, "label of after");
        EXPECT_EQ(frame_of(models[0]) == frame_of(models[1]), layout != Layout::multiples) << "as in the pictures";
    }
}

TEST(DrawModels, TheFirstTwoOfEveryFigureComeBeforeTheThirdOfAny) {
    const auto figure_of = [](const std::string& name, int count, const TriangleMesh& mesh) {
        std::vector<Panel> panels;
        for (int i = 0; i < count; ++i) {
            TriangleMesh state = mesh;
            state.X *= 1 + i;
            panels.push_back(turnable_panel(std::move(state), name + std::to_string(i)));
        }
        return turnable(std::move(panels));
    };
    const auto figures = models_of({figure_of("a", 6, flat_mesh(90)), figure_of("b", 2, flat_mesh(90)), figure_of("c", 3, icosphere(2))});
    EXPECT_EQ(figures.at("a0").models.size(), 2U) << "for all six there is no room";
    EXPECT_EQ(figures.at("b0").models.size(), 2U);
    EXPECT_EQ(figures.at("c0").models.size(), 3U);
}

TEST(DrawModels, AMeshWithOtherValuesHasOneModel) {
    Panel other = turnable_panel(icosphere(2), "again");
    other.values *= 2;
    const auto figures = models_of({turnable({turnable_panel(icosphere(2), "first"), other, turnable_panel(cube_mesh(2), "cube")})});
    ASSERT_EQ(figures.at("first").models.size(), 2U);
    EXPECT_EQ(figures.at("first").models[1].label, "label of cube");
}

TEST(DrawModels, LargeAndBlownUpMeshesHaveNoModel) {
    TriangleMesh blown_up = icosphere(2);
    blown_up.X(0, 0) = std::numeric_limits<double>::infinity();
    const TriangleMesh large = flat_mesh(176);
    ASSERT_GT(large.face_count(), most_model_triangles);
    const auto figures = models_of(
        {turnable({turnable_panel(large, "large")}), turnable({turnable_panel(icosphere(2), "a"), turnable_panel(blown_up, "b")})});
    EXPECT_TRUE(figures.at("large").models.empty());
    ASSERT_EQ(figures.at("a").models.size(), 1U);
    EXPECT_EQ(figures.at("a").models[0].file, "models/a.glb");
}

TEST(DrawModels, AllTogetherStayBelowTheLimitFirstComeFirstServed) {
    std::vector<FigureRequest> requests;
    for (int i = 0; i < 6; ++i) requests.push_back(turnable({turnable_panel(flat_mesh(170), "plane" + std::to_string(i))}));
    requests.push_back(turnable({turnable_panel(icosphere(2), "small")}));
    const auto figures = models_of(requests);
    std::size_t total = 0;
    for (const auto& [id, figure] : figures)
        for (const report::DrawnModel& model : figure.models) total += model.glb.size();
    EXPECT_LE(total, most_model_bytes);
    EXPECT_GT(total, most_model_bytes / 2);
    EXPECT_TRUE(figures.at("plane5").models.empty());
    EXPECT_FALSE(figures.at("plane0").models.empty());
    EXPECT_FALSE(figures.at("small").models.empty()) << "there is still room for it";
}
