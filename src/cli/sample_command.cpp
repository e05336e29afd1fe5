#include <memory>

#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "run/arguments.h"
#include "run/console.h"

namespace meshfolio::cli {

Command sample_command(CLI::App& parent) {
    struct Options {
        std::string name, output;
        std::string subdivide = "0";
        bool list = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "sample", "A bundled procedural mesh");
    app.text("NAME", options->name, "see --list");
    app.text("-o,--output FILE", options->output, formats_written);
    app.text("--subdivide", options->subdivide, "extra 1-to-4 subdivisions, 0 to " + std::to_string(most_subdivisions));
    app.flag("--list", options->list, "print names and descriptions");
    app.footer("Example: meshfolio sample creature -o creature.ply --subdivide 1");
    return {app, [options] {
                if (options->list) {
                    std::string text;
                    for (const Sample& sample : sample_list()) {
                        const std::string name(sample.name);
                        text += name + std::string(18 - name.size(), ' ') + std::string(sample.description) + "\n";
                    }
                    print(text);
                    return ExitCode::ok;
                }
                if (options->name.empty() || options->output.empty())
                    throw UsageError("sample needs NAME and -o FILE", "give both, or --list to see the names");
                const int subdivide = static_cast<int>(integer_between("--subdivide", options->subdivide, 0, most_subdivisions));
                check_output("-o", options->output, mesh_or_standard_output());
                write_mesh_to(options->output, make_sample(options->name, subdivide));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
