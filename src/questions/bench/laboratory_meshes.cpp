#include "questions/bench/laboratory_meshes.h"

#include "questions/core/section_tools.h"

namespace meshfolio {

std::vector<std::shared_ptr<const LibraryMesh>> laboratory_meshes(const MeshLibrary& library, const QuestionSettings& settings,
                                                                  report::Section& section) {
    if (settings.laboratory) return meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns", "armadillo"}, section);
    if (settings.quick) return meshes_for(library, settings, {"cube"}, section);
    return meshes_for(library, settings, {"cube", "plane_ns"}, section);
}

}   // namespace meshfolio
