#include <memory>

#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/vertex_noise.h"
#include "run/arguments.h"
#include "run/console.h"

namespace meshfolio::cli {

Command noise_command(CLI::App& parent) {
    struct Options {
        std::string mesh, output, sigma, unit = "raw", seed = "1";
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "noise", "Seeded Gaussian noise on every vertex");
    app.required("MESH", options->mesh, formats_read);
    app.required("-o,--output FILE", options->output, formats_written);
    app.required("--sigma", options->sigma, "standard deviation of each coordinate");
    app.choice("--unit", options->unit, noise_units,
               "of sigma: raw (model units), bbox (per axis, its extent), diagonal (of the bounding box), h (mean edge)");
    app.text("--seed", options->seed, "the same seed gives the same noise");
    app.footer(std::string(attributes_are_kept) + "Example: meshfolio noise bunny.off -o noisy.ply --sigma 0.01 --unit bbox --seed 7");
    return {app, [options] {
                const double sigma = number_not_negative("--sigma", options->sigma);
                if (sigma > largest_coordinate) throw UsageError("--sigma " + options->sigma + " is beyond 1e100", "take a smaller one");
                const std::uint64_t seed = seed_of(options->seed);
                check_output("-o", options->output, mesh_or_standard_output());
                const PreparedMesh prepared = load_mesh(options->mesh, Checks::all, Keep::attributes);
                const Vector3 deviation = sigma * noise_unit(prepared.mesh, options->unit);
                write_mesh_to(options->output, moved_to(prepared.mesh, with_gaussian_noise(prepared.mesh.X, deviation, seed)),
                              prepared.attributes);
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
