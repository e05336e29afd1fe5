#include "output/draw/draw_models.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/file_bytes.h"
#include "output/draw/framing.h"
#include "output/draw/write_glb.h"
#include "output/publish/folder_system.h"

namespace meshfolio::output {

namespace {

namespace fs = std::filesystem;
using Models = std::vector<report::DrawnModel>;

/// Returns the ball that frames a panel as in its pictures: around its own mesh (multiples), the mesh of `frame_panel`, or all meshes.
Ball frame_of(const FigureRequest& request, const Panel& framed, const std::vector<Panel>& panels) {
    const Ball own = ball_around(*framed.mesh);
    if (request.layout == Layout::multiples) return own;
    if (request.frame_panel >= 0) {
        const TriangleMesh& mesh = *request.panels[static_cast<std::size_t>(request.frame_panel)].mesh;
        return can_be_a_model(mesh) ? ball_around(mesh) : own;
    }
    Ball frame = ball_around(*panels[0].mesh);
    for (const Panel& panel : panels) {
        const Ball ball = ball_around(*panel.mesh);
        frame.radius = std::max(frame.radius, (ball.centre - frame.centre).norm() + ball.radius);
    }
    return frame;
}

Models models_of(const FigureRequest& request) {
    if (!request.turnable) return {};
    std::vector<Panel> panels;
    std::vector<render::View> views;
    for (std::size_t p = 0; p < request.panels.size(); ++p) {
        const Panel& panel = request.panels[p];
        const auto is_same = [&](const Panel& other) { return panel.mesh->X == other.mesh->X && panel.mesh->F == other.mesh->F; };
        if (!panel.mesh || panel.mesh->face_count() > most_model_triangles || !can_be_a_model(*panel.mesh)) continue;
        if (std::ranges::any_of(panels, is_same)) continue;   // each mesh once, with its first values
        panels.push_back(panel);
        views.push_back(hero_of(request, p));
    }
    Models models;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Panel& panel = panels[i];
        const ColorRange* range = panel.values.size() > 0 ? request.range_of(panel) : nullptr;
        report::DrawnModel model{panel.label, "models/" + panel.name + ".glb", "", ""};
        Ball frame = frame_of(request, panel, panels);
        frame.view = views[i];
        frame.zoom = request.sight.zoom;
        model.glb = write_glb(*panel.mesh, panel.values, range != nullptr ? std::optional(*range) : std::nullopt, frame);
        if (range != nullptr) model.quantity = range->quantity + (range->unit.empty() ? "" : " [" + range->unit + "]");
        models.push_back(std::move(model));
    }
    return models;
}

}   // namespace

std::map<std::string, Models> write_models(std::span<const FigureRequest> requests, const fs::path& folder) {
    constexpr std::size_t pair = 2;   // before and after
    std::map<std::string, Models> written;
    std::vector<Models> further;
    std::size_t total = 0;
    const auto add = [&](const std::string& id, Models models) {
        const auto sum = [](std::size_t bytes, const report::DrawnModel& model) { return bytes + model.glb.size(); };
        const std::size_t bytes = std::accumulate(models.begin(), models.end(), std::size_t{0}, sum);
        if (models.empty() || total + bytes > most_model_bytes) return;
        total += bytes;
        std::ranges::move(models, std::back_inserter(written[id]));
    };
    for (const FigureRequest& request : requests) {
        Models models = models_of(request);
        const auto rest = models.begin() + static_cast<std::ptrdiff_t>(std::min(pair, models.size()));
        further.emplace_back(std::make_move_iterator(rest), std::make_move_iterator(models.end()));
        models.erase(rest, models.end());
        add(request.id, std::move(models));
    }
    for (std::size_t f = 0; f < requests.size(); ++f)
        if (written.contains(requests[f].id)) add(requests[f].id, std::move(further[f]));
    for (auto& [id, models] : written) {
        make_folder(folder / "models");
        if (models.size() == 1) models[0].label.clear();
        for (const report::DrawnModel& model : models) write_file(folder / model.file, model.glb);
    }
    return written;
}

}   // namespace meshfolio::output
