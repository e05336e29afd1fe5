/// @file
/// The options of `render`, and its figures.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/file_group.h"
#include "run/arguments.h"
#include "run/one_mesh/mesh_pictures.h"

namespace meshfolio::cli {

struct RenderFlags {
    std::vector<std::string> meshes;
    std::string out, output, names = "sign", size = "1024", views, field = "none", values, colormap, range, isolines, glb, title,
                             background, width, dpi, columns, fit, bar = "on";
    run::SightFlags sight;
    bool edges = false, plain = false, terminal = false;
};

/// Returns the colour of --background, white by default. @throws UsageError
render::Rgba background_of(const RenderFlags& options);

/// Returns the choices of --colormap and --range, and warns of a map that is not perceptually uniform. @throws UsageError, InputError
run::ColorChoice color_choice(const RenderFlags& options);

/// Keeps the files that are read from being replaced.
void keep_inputs(output::FileGroup& files, const RenderFlags& options);

/// Writes one figure of the meshes, or shows it in the terminal.
ExitCode run_figure(const RenderFlags& options);

}   // namespace meshfolio::cli
