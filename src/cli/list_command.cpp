#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "color/colormap.h"
#include "color/evenness.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/chapter.h"
#include "questions/core/mesh_roles.h"
#include "run/console.h"

namespace meshfolio::cli {

namespace {

nlohmann::ordered_json everything() {
    nlohmann::ordered_json json;
    const auto add = [&](const char* kind, std::string_view name, const std::string& description) {
        json[kind].push_back({{"name", name}, {"description", description}});
    };
    for (const Chapter* chapter : chapter_list())
        add(chapter->is_question() ? "questions" : "supporting", chapter->id, chapter->title() + ": " + chapter->asked());
    for (const MeshRole& role : mesh_role_list()) {
        const std::string asked(role.asked);
        add("meshes", role.role, (asked.empty() ? "" : asked + ", bundled stand-in ") + std::string(role.bundled));
    }
    for (const render::Colormap& map : render::colormap_list()) {
        const std::string uneven = render::unevenness_of(map);
        add("colormaps", map.name,
            map.kind + ", " + map.description + (uneven.empty() ? "; perceptually uniform" : "; not perceptually uniform: " + uneven));
        json["colormaps"].back()["uniform"] = uneven.empty();
    }
    for (const Sample& sample : sample_list()) add("samples", sample.name, std::string(sample.description));
    return json;
}

std::string list_text(const nlohmann::ordered_json& json) {
    std::string text;
    for (const auto& [kind, entries] : json.items()) {
        text += kind + "\n";
        for (const auto& entry : entries) {
            const auto name = entry["name"].get<std::string>();
            text +=
                "  " + name + std::string(name.size() < 16 ? 16 - name.size() : 1, ' ') + entry["description"].get<std::string>() + "\n";
        }
    }
    return text;
}

}   // namespace

Command list_command(CLI::App& parent) {
    const auto json = std::make_shared<bool>(false);
    CommandOptions app(parent, "list", "Questions, meshes, colour maps, samples");
    app.flag("--json", *json, "for programs");
    app.footer("Example: meshfolio list --json");
    return {app, [json] {
                const auto all = everything();
                print(*json ? all.dump(2) + "\n" : for_terminal(list_text(all)));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
