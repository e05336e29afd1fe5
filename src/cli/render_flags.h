/// @file
/// The options of `render`, and its figures.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/file_group.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::cli {

struct RenderFlags : run::PictureWords {
    RenderFlags() : run::PictureWords{.size = "1024", .field = "none", .bar = "on"} {}
    std::vector<std::string> meshes;
    std::string out, output, names = "sign", values, glb;
    bool plain = false, terminal = false;
};

/// Keeps the files that are read from being replaced.
void keep_inputs(output::FileGroup& files, const RenderFlags& options);

/// Writes one figure of the meshes, or shows it in the terminal.
ExitCode run_figure(const RenderFlags& options);

}   // namespace meshfolio::cli
