#include "output/draw/draw_models.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/file_bytes.h"
#include "output/draw/write_glb.h"
#include "output/publish/folder_system.h"

namespace meshfolio::output {

namespace {

namespace fs = std::filesystem;

/// The first panel, and the second beside it where it has the same triangles: before and after, one estimate and another.
std::span<const Panel> turned_panels(const FigureRequest& request) {
    const std::vector<Panel>& panels = request.panels;
    const bool pair = panels.size() > 1 && panels[1].mesh && panels[0].mesh->face_count() == panels[1].mesh->face_count();
    return {panels.data(), pair ? 2U : 1U};
}

bool can_be_turned(std::span<const Panel> panels) {
    return std::all_of(panels.begin(), panels.end(),
                       [](const Panel& panel) { return panel.mesh->face_count() <= most_model_triangles && can_be_a_model(*panel.mesh); });
}

/// Frames one panel, as its pictures do, or all panels.
Ball frame_of(const FigureRequest& request, std::span<const Panel> panels) {
    if (request.frame_panel >= 0) {
        const TriangleMesh& mesh = *request.panels[static_cast<std::size_t>(request.frame_panel)].mesh;
        return ball_around(can_be_a_model(mesh) ? mesh : *panels[0].mesh);
    }
    Ball frame = ball_around(*panels[0].mesh);
    for (const Panel& panel : panels) {
        const Ball ball = ball_around(*panel.mesh);
        frame.radius = std::max(frame.radius, (ball.centre - frame.centre).norm() + ball.radius);
    }
    return frame;
}

std::vector<report::DrawnModel> models_of(const FigureRequest& request) {
    if (!request.turnable || !request.panels[0].mesh) return {};
    const std::span<const Panel> panels = turned_panels(request);
    if (!can_be_turned(panels)) return {};
    const Ball frame = frame_of(request, panels);
    std::vector<report::DrawnModel> models;
    for (const Panel& panel : panels) {
        const ColorRange* range = panel.values.size() > 0 ? request.range_of(panel) : nullptr;
        report::DrawnModel model{panels.size() > 1 ? panel.label : "", "models/" + panel.name + ".glb", "", ""};
        model.glb = write_glb(*panel.mesh, panel.values, range != nullptr ? std::optional(*range) : std::nullopt, frame);
        if (range != nullptr) model.quantity = range->quantity + (range->unit.empty() ? "" : " [" + range->unit + "]");
        models.push_back(std::move(model));
    }
    return models;
}

}   // namespace

std::map<std::string, std::vector<report::DrawnModel>> write_models(std::span<const FigureRequest> requests, const fs::path& folder) {
    std::map<std::string, std::vector<report::DrawnModel>> written;
    std::size_t total = 0;
    for (const FigureRequest& request : requests) {
        std::vector<report::DrawnModel> models = models_of(request);
        const std::size_t bytes = std::accumulate(models.begin(), models.end(), std::size_t{0},
                                                  [](std::size_t sum, const report::DrawnModel& model) { return sum + model.glb.size(); });
        if (models.empty() || total + bytes > most_model_bytes) continue;
        total += bytes;
        make_folder(folder / "models");
        for (const report::DrawnModel& model : models) write_file(folder / model.file, model.glb);
        written[request.id] = std::move(models);
    }
    return written;
}

}   // namespace meshfolio::output
