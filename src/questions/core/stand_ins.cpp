#include "questions/core/stand_ins.h"

#include "questions/core/mesh_roles.h"

namespace meshfolio {

namespace {

// Limits and edges of the originals as this program measures them; a test does so again where the originals are there.
constexpr std::array<StandIn, 4> stand_ins{{
    {"bunny", "bunny.off", "armadillo", 1.93003e-7, 4.66109e-3, 3485, 6966},
    {"cow", "cow.off", "armadillo", 1.46899e-6, 2.25444e-2, 2762, 5520},
    {"cube", "cube.obj", "cube8", 0.246914, 1.138071, 8, 12},
    {"bumpy_cube", "bumpy.off", "bumpy_cube", 1.87721e-2, 0.397408, 1250, 2496},
}};

}   // namespace

std::span<const StandIn> stand_in_list() { return stand_ins; }

std::string ReportMesh::called() const { return original || own ? mesh->name : mesh->name + " in place of " + std::string(asked); }

report::Input ReportMesh::input() const {
    report::Input input = mesh->input;
    if (entry == nullptr || own) return input;
    input.role = entry->name;
    input.asked = entry->file;
    input.stand_in = !original;
    return input;
}

ReportMesh report_mesh(const MeshLibrary& library, std::string_view name) {
    ReportMesh found;
    const auto it = std::ranges::find(stand_ins, name, &StandIn::name);
    if (it != stand_ins.end()) found.entry = &*it;
    found.own = library.has_own_meshes();
    if (found.entry && !found.own) found.mesh = library.in_data(found.entry->file);
    found.original = found.mesh != nullptr;
    if (!found.mesh) found.mesh = library.role(std::string(found.entry ? found.entry->role : name));
    if (!found.entry) found.original = !found.own && !found.mesh->input.stand_in;
    const auto role = std::ranges::find(mesh_role_list(), name, &MeshRole::role);
    found.asked = found.entry ? found.entry->file : role->asked.empty() ? role->bundled : role->asked;
    return found;
}

}   // namespace meshfolio
